// What a master that is started again knows of what the wall was asked for.
#include "app/asked_file.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace vindu::app {
namespace {

using ::testing::HasSubstr;

class AskedFiles : public ::testing::Test {
 protected:
  AskedFiles() {
    std::string name = ::testing::TempDir() + "asked-XXXXXX";
    folder_ = mkdtemp(name.data());
    setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
  }
  ~AskedFiles() override {
    unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(folder_);
  }
  std::string file() const { return folder_ + "/vindu-0-wall/asked.toml"; }

  std::string folder_;
  ClusterConfig cluster_;
};

const Asked kAsked{.model = "/models/it's \"a\"\nmodel\\.glb",
                   .clip = "Walk",
                   .place = Placement::life_size,
                   .mode = "loop",
                   .pattern = Pattern::seams,
                   .blank = true,
                   .overlay = true,
                   .middle_in_scene = Vec3(0.1, -2e-9, 3e7)};

TEST_F(AskedFiles, GiveTheNextMasterOfTheSameLaunchEverythingOnce) {
  AskedFile(cluster_, "a").keep(kAsked);
  EXPECT_EQ(AskedFile(cluster_, "a").take(), kAsked);
  EXPECT_FALSE(AskedFile(cluster_, "a").take());

  AskedFile(cluster_, "a").keep(Asked{});
  EXPECT_EQ(AskedFile(cluster_, "a").take(), Asked{});
}

TEST_F(AskedFiles, GiveNothingToAnotherLaunchAnotherWallOrAfterAGoodEnd) {
  AskedFile(cluster_, "a").keep(kAsked);
  EXPECT_FALSE(AskedFile({.name = "other"}, "a").take());
  EXPECT_FALSE(AskedFile(cluster_, "").take());
  EXPECT_FALSE(AskedFile(cluster_, "b").take());

  AskedFile(cluster_, "a").keep(kAsked);
  AskedFile(cluster_, "a").remove();
  EXPECT_FALSE(AskedFile(cluster_, "a").take());
}

TEST_F(AskedFiles, WithoutALaunchThereAreNone) {
  AskedFile(cluster_, "").keep(kAsked);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(AskedFiles, ThatCannotBeReadOrWrittenAreAWarning) {
  AskedFile(cluster_, "a").keep(kAsked);
  std::ofstream(file()) << "session = ";
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(AskedFile(cluster_, "a").take());
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("is not known"));

  std::filesystem::remove_all(folder_ + "/vindu-0-wall");
  std::ofstream(folder_ + "/vindu-0-wall") << "no folder";
  AskedFile kept(cluster_, "a");
  ::testing::internal::CaptureStderr();
  kept.keep(kAsked);
  kept.keep(kAsked);
  kept.remove();
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(said.find("would not know"), said.rfind("would not know")) << said;
  EXPECT_THAT(said, HasSubstr("would not know"));
}

TEST(Note, ChangesWhatIsAskedForOrSaysWhatIsAllowed) {
  Asked asked;
  note({.verb = Verb::pattern, .argument = "bar"}, asked);
  note({.verb = Verb::blank, .argument = "on"}, asked);
  note({.verb = Verb::overlay, .argument = "on"}, asked);
  EXPECT_EQ(asked, (Asked{.pattern = Pattern::bar, .blank = true, .overlay = true}));
  note({.verb = Verb::blank, .argument = "off"}, asked);
  EXPECT_FALSE(asked.blank);

  EXPECT_THROW(note({.verb = Verb::blank, .argument = "perhaps"}, asked), Error);
  EXPECT_THROW(note({.verb = Verb::pattern, .argument = "stripes"}, asked), Error);
}

}  // namespace
}  // namespace vindu::app
