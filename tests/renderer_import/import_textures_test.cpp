// Where the picture is that a model means: models name textures by the author's disk, in another
// case, with backslashes.
#include "renderer/import_textures.h"

#include <gtest/gtest.h>

#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using test::TemporaryFolder;

struct Case {
  const char* file;  ///< below the model's folder
  const char* name;  ///< as the model writes it
};

class FoundTexture : public ::testing::TestWithParam<Case> {};

TEST_P(FoundTexture, IsTheFileThatWasMeant) {
  const TemporaryFolder folder;
  const std::string file = folder.write(GetParam().file, "picture");
  folder.write("model/scene.obj", "model");

  const auto found = find_texture_file(folder.path("model"), GetParam().name);

  ASSERT_TRUE(found);
  EXPECT_TRUE(std::filesystem::equivalent(*found, file)) << *found;
}

INSTANTIATE_TEST_SUITE_P(Names, FoundTexture,
                         ::testing::Values(Case{"model/wood.png", "wood.png"},
                                           Case{"model/wood.png", "WOOD.PNG"},
                                           Case{"model/Wood.PNG", "wood.png"},
                                           Case{"model/wood.png", "./wood.png"},
                                           Case{"model/tex/wood.png", "tex\\wood.png"},
                                           Case{"model/Tex/Wood.png", "tex/wood.png"},
                                           Case{"model/wood.png", "C:\\Users\\Author\\wood.png"},
                                           Case{"model/wood.png", "/home/author/wood.png"},
                                           Case{"model/textures/wood.png", "D:/maps/wood.png"},
                                           Case{"textures/wood.png", "wood.png"},
                                           Case{"textures/wood.png", "../textures/wood.png"},
                                           Case{"model/my wood.png", "my%20wood.png"},
                                           Case{"model/100%.png", "100%.png"},
                                           Case{"model/wood.png", "file:///C:/maps/wood.png"},
                                           Case{"model/tex/wood.png", "//tex/wood.png"},
                                           Case{"model/wood.png", "\"wood.png\" \"wood.gif\""},
                                           Case{"model/wood.png", "  wood.png\r"}));

TEST(FindTextureFile, ExactCaseWinsOverAnother) {
  const TemporaryFolder folder;
  folder.write("wood.png", "small");
  folder.write("WOOD.png", "large");

  EXPECT_EQ(find_texture_file(folder.path(""), "WOOD.png")->filename(), "WOOD.png");
  EXPECT_EQ(find_texture_file(folder.path(""), "wood.png")->filename(), "wood.png");
}

TEST(FindTextureFile, FindsNothingWhereNothingIs) {
  const TemporaryFolder folder;
  folder.write("textures/wood.png", "picture");

  for (const char* name : {"stone.png", "", ".", "..", "/", "textures", "\\", "//", "%", "\"\""})
    EXPECT_FALSE(find_texture_file(folder.path(""), name)) << name;
}

}  // namespace
}  // namespace vindu
