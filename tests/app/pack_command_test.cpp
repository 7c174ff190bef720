// vindu pack, and the cache behind every command that loads a model: read once, in a process whose
// end harms nobody.
#include <fstream>

#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class PackCommand : public AppTest {
 protected:
  ProcessResult pack(std::vector<std::string> words) {
    words.insert(words.begin(), "pack");
    return vindu(words, cache_);
  }
  /// The picture of one tile.
  std::string picture_of(const std::string& model) {
    const ProcessResult result = vindu(
        {"render", model, "--tile", "tile-3-1", "--scale", "0.05", "--out", path("out")}, cache_);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    said_ = result.err;
    return bytes_of(path("out/tile-3-1.png"));
  }
  /// A square before the wall, in the colour that the file beside it says.
  std::string square(const std::string& colour) {
    write("a.mtl", "newmtl a\nKd " + colour + "\n");
    return write("a.obj",
                 "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  }

  Environment cache_ = {{"XDG_CACHE_HOME", path("cache")}};
  std::string said_;
};

TEST_F(PackCommand, ReadsAModelOnceForAllCommands) {
  const ProcessResult result = pack({small_model()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("is packed, once"));
  EXPECT_THAT(result.out, HasSubstr("12 triangles"));
  picture_of(small_model());
  EXPECT_THAT(said_, Not(HasSubstr("is packed, once")));
}

TEST_F(PackCommand, ListsTheClips) {
  const ProcessResult result = pack({"/usr/share/assimp/models/X/Testwuson.X"});
  EXPECT_THAT(result.out, HasSubstr("clips: 1 Wuson_Run (0.97 s), 2 Wuson_Walk (3.60 s)"));
  EXPECT_THAT(pack({small_model()}).out, Not(HasSubstr("clips")));
}

TEST_F(PackCommand, SaysTheSameAsJson) {
  const std::string model = "/usr/share/assimp/models/X/Testwuson.X";
  EXPECT_THAT(pack({model, small_model(), "--json"}).out,
              AllOf(HasSubstr("{\"model\": \"" + model + "\", \"file\": \""),
                    HasSubstr(R"("clips": [{"name": "Wuson_Run", "seconds": 0.9)"),
                    HasSubstr(R"("triangles": 12, "textures": 0, "clips": [], )")));
}

TEST_F(PackCommand, ShowsAPackedSceneAsItsModel) {
  const std::string model = square("0.1 0.7 0.2");
  const std::string before = picture_of(model);
  EXPECT_EQ(pack({model, "--out", path("b.vscene")}).exit_code, 0);
  EXPECT_EQ(picture_of(path("b.vscene")), before);
}

TEST_F(PackCommand, NoticesThatAFileBesideTheModelHasChanged) {
  const std::string green = picture_of(square("0.1 0.7 0.2"));
  const std::string red = picture_of(square("0.7 0.1 0.2"));
  EXPECT_THAT(said_, HasSubstr("is packed, once"));
  EXPECT_NE(red, green);
  EXPECT_EQ(picture_of(square("0.1 0.7 0.2")), green);
}

TEST_F(PackCommand, SaysWhyAModelCannotBeReadAndGoesOnWithTheOthers) {
  const std::string broken = write("broken.glb", "glTF, but not more of it than this line says");
  const ProcessResult result = pack({broken, small_model()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(broken + ": "));
  EXPECT_THAT(result.out, HasSubstr("12 triangles"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have no limits
TEST_F(PackCommand, OutlivesAReaderThatIsGivenTooLittleMemory) {
  const ProcessResult result = pack({std::string(VINDU_SOURCE_DIR) + "/assets/show/show.glb",
                                     "--memory-mib", "40", "--out", path("s")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("show.glb: "));
  EXPECT_FALSE(std::filesystem::exists(path("s")));
}
#endif

TEST_F(PackCommand, EndsAReaderThatTakesTooLong) {
  std::ofstream stream(path("large.obj"));
  for (int i = 0; i < 1'500'000; ++i) stream << "v " << i << " 0 1\nv 0 " << i << " 1\nf -1 -2 1\n";
  stream.close();
  const ProcessResult result = pack({path("large.obj"), "--seconds", "1", "--out", path("l")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("takes longer than 1 s"));
}

TEST_F(PackCommand, LoadsAModelWhereNothingCanBeKept) {
  cache_ = {{"XDG_CACHE_HOME", write("file", "no folder")}};
  picture_of(small_model());
  EXPECT_THAT(said_, HasSubstr("cannot be kept packed"));
}

TEST_F(PackCommand, RefusesADamagedPackedScene) {
  const ProcessResult result = vindu({"render", write("a.vscene", "damage"), "--out", path("o")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("is no packed scene"));
}

TEST_F(PackCommand, WrongWordsAreCalledWrong) {
  EXPECT_EQ(pack({}).exit_code, 2);
  EXPECT_EQ(pack({"a.obj", "--seconds", "0"}).exit_code, 2);
  EXPECT_EQ(pack({"a.obj", "b.obj", "--out", "c"}).exit_code, 1);
}

}  // namespace
}  // namespace vindu
