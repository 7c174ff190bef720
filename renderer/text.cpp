#include "renderer/text.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/error.h"
#include "renderer/resources.h"

namespace vindu {
namespace {

struct Font {
  explicit Font(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    if (bytes.empty() || !stbtt_InitFont(&info, data, 0))
      throw Error(
          {"cannot be read as a font", file, "install the Debian package fonts-dejavu-core"});
  }
  std::vector<char> bytes;
  stbtt_fontinfo info{};
};

const stbtt_fontinfo& font(bool bold) {
  static const Font plain_font(find_font("DejaVuSans.ttf"));
  static const Font bold_font(find_font("DejaVuSans-Bold.ttf"));
  return bold ? bold_font.info : plain_font.info;
}

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

/// Decodes one UTF-8 character and advances; each malformed byte becomes U+FFFD.
int next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80       ? 1
                             : first >> 5 == 6  ? 2
                             : first >> 4 == 14 ? 3
                             : first >> 3 == 30 ? 4
                                                : 0;
  if (length == 0 || length > text.size() ||
      !std::ranges::all_of(text.substr(1, length - 1), continues)) {
    text.remove_prefix(1);
    return 0xfffd;
  }
  int character = length == 1 ? first : first & (0xff >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) character = character << 6 | (text[i] & 0x3f);
  text.remove_prefix(length);
  return character;
}

void blend(Rgba8& pixel, const Rgba8& colour, unsigned cover) {
  for (int part = 0; part < 3; ++part)
    pixel[part] =
        static_cast<std::uint8_t>((pixel[part] * (255 - cover) + colour[part] * cover + 127) / 255);
}

void draw_glyph(Image& image, int x, int y, const stbtt_fontinfo& info, int glyph, float scale,
                const Rgba8& colour) {
  int width = 0, height = 0, left = 0, top = 0;
  unsigned char* cover =
      stbtt_GetGlyphBitmap(&info, scale, scale, glyph, &width, &height, &left, &top);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const int px = x + left + column, py = y + top + row;
      if (px >= 0 && py >= 0 && px < image.width_px && py < image.height_px)
        blend(image.at(px, py), colour, cover[row * width + column]);
    }
  stbtt_FreeBitmap(cover, nullptr);
}

/// Walks the characters; `draw` gets glyph and place. Returns the width.
template <class Draw>
int walk(std::string_view text, const stbtt_fontinfo& info, float scale, Draw draw) {
  double x = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&info, next_character(text));
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&info, glyph, &advance, &bearing);
    draw(glyph, static_cast<int>(std::lround(x)));
    x += static_cast<double>(advance) * scale;
  }
  return static_cast<int>(std::ceil(x));
}

}  // namespace

int text_width_px(std::string_view text, const TextStyle& style) {
  const stbtt_fontinfo& info = font(style.bold);
  return walk(text, info, stbtt_ScaleForPixelHeight(&info, static_cast<float>(style.height_px)),
              [](int, int) {});
}

void draw_text(Image& image, int x, int y, std::string_view text, const TextStyle& style) {
  const stbtt_fontinfo& info = font(style.bold);
  const float scale = stbtt_ScaleForPixelHeight(&info, static_cast<float>(style.height_px));
  int ascent = 0, descent = 0, gap = 0;
  stbtt_GetFontVMetrics(&info, &ascent, &descent, &gap);
  const int baseline = y + static_cast<int>(std::lround(static_cast<double>(ascent) * scale));
  walk(text, info, scale, [&](int glyph, int dx) {
    draw_glyph(image, x + dx, baseline, info, glyph, scale, style.colour);
  });
}

}  // namespace vindu
