// The program's own files: found in the source tree, where VINDU_DATA says, or missed with a
// remedy.
#include "renderer/resources.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Resources, AreFoundInTheSourceTree) {
  EXPECT_TRUE(fs::is_regular_file(find_shader("scene.frag")));
  EXPECT_TRUE(fs::is_regular_file(find_asset("show/show.glb")));
}

TEST(Resources, ThatAreMissingAreNamedWithARemedy) {
  try {
    find_asset("show/nothing.glb");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("assets/show/nothing.glb"), HasSubstr("install")));
  }
}

// The folder is looked for once in a process, so this asks in a process of its own.
TEST(ResourcesDeathTest, AreTakenFromTheFolderThatTheEnvironmentNames) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const fs::path folder = fs::path(::testing::TempDir()) / "vindu-data";
  fs::create_directories(folder / "shaders");
  fs::create_directories(folder / "assets");
  fs::create_directories(folder / "fonts");
  std::ofstream(folder / "assets/own.toml") << "own\n";
  std::ofstream(folder / "fonts/Own.ttf") << "own\n";
  const auto found = [&] {
    setenv("VINDU_DATA", folder.c_str(), 1);
    const bool right = find_asset("own.toml") == fs::canonical(folder / "assets/own.toml") &&
                       find_font("Own.ttf") == fs::canonical(folder / "fonts/Own.ttf") &&
                       find_font("DejaVuSans.ttf").starts_with("/usr/share/fonts/");
    std::exit(right ? 0 : 1);
  };
  EXPECT_EXIT(found(), ::testing::ExitedWithCode(0), "");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace vindu
