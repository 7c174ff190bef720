// wall.toml: whatever stands in it, reading gives a site or an Error, never a crash. Seeded, small
// and fast; libFuzzer's place is the fuzz label.
#include <fstream>
#include <random>
#include <sstream>

#include "core/site.h"
#include "tests/core/files.h"

namespace vindu {
namespace {

std::string thesis_file() {
  std::ifstream file(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// True when it was read, false when it was an Error; any other exception escapes.
bool reads(const std::string& text) { return testing::complaint_about(text, read_site).empty(); }

/// One mutation: a byte changed, a piece cut out, or a piece doubled.
void mutate(std::string& text, std::mt19937& random) {
  if (text.empty()) return;
  const auto below = [&](std::size_t count) { return random() % count; };
  const std::size_t at = below(text.size()), length = below(20);
  switch (below(3)) {
    case 0:
      text[at] = static_cast<char>(below(256));
      break;
    case 1:
      text.erase(at, length);
      break;
    default:
      text.insert(below(text.size()), text.substr(at, length));
  }
}

TEST(SiteFuzz, RandomBytesNeverCrash) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string text(random() % 200, ' ');
    for (char& byte : text) byte = static_cast<char>(random());
    reads(text);
  }
}

TEST(SiteFuzz, MutatedFilesNeverCrash) {
  std::mt19937 random(8);
  const std::string good = thesis_file();
  ASSERT_TRUE(reads(good));
  int read = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (unsigned count = 1 + random() % 4; count > 0; --count) mutate(text, random);
    read += reads(text) ? 1 : 0;
  }
  EXPECT_GT(read, 0);  // the mutations are small enough to reach past the syntax
  EXPECT_LT(read, 2000);
}

TEST(SiteFuzz, ValuesOfWrongKindsNeverCrash) {
  std::mt19937 random(9);
  const char* const values[] = {"1",
                                "-1",
                                "1e300",
                                "nan",
                                "true",
                                "\"text\"",
                                "[]",
                                "{}",
                                "[[1, 2, 3]]",
                                "1979-05-27",
                                "[1, \"two\", {}]",
                                "[nan]",
                                "inf",
                                "\"\\u0000\""};
  const char* const fields[] = {"columns",     "rows",        "width_m",    "tile_width_px",
                                "curve_deg",   "hosts",       "mirror",     "rotate_deg",
                                "tile",        "head.leds_m", "head.eye_m", "viewer.default_eye_m",
                                "scene.place", "camera"};
  for (int i = 0; i < 1000; ++i) {
    std::string text;
    for (const char* field : fields)
      if (random() % 3 != 0)
        text += std::string(random() % 2 ? "wall." : "") + field + " = " +
                values[random() % std::size(values)] + "\n";
    reads(text);
  }
}

}  // namespace
}  // namespace vindu
