// vindu doctor: what a machine has and lacks, and what it is for a wall.
#include <unistd.h>

#include "core/site.h"
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::string this_host() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

class DoctorCommand : public AppTest {
 protected:
  /// A wall of one tile with these lines in its [cluster].
  std::string wall_with(const std::string& cluster, const std::string& more = "") {
    return write("wall.toml",
                 "[wall]\ncolumns = 1\nrows = 1\nwidth_m = 1\nheight_m = 0.75\n"
                 "tile_width_px = 64\ntile_height_px = 48\n" +
                     more + "[cluster]\nname = \"doctor\"\n" + cluster);
  }
};

TEST_F(DoctorCommand, SaysWhatAMachineWithoutDisplayOrCardHas) {
  const ProcessResult result = vindu({"doctor"});
  const auto lines = lines_of(result.out);
  EXPECT_THAT(lines,
              Contains(AllOf(StartsWith("good  files"), HasSubstr("shaders and assets in"))));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("note  graphics"), HasSubstr("llvmpipe"),
                                    HasSubstr("drawn by the processor"))));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("note  display"), HasSubstr("DISPLAY"))));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("good  network"), HasSubstr("lo (127.0.0.1)"))));
  EXPECT_THAT(result.out, Not(HasSubstr("BAD")));
  EXPECT_THAT(result.out, EndsWith("Nothing stands in the way.\n"));
  EXPECT_EQ(result.exit_code, 0);
}

TEST_F(DoctorCommand, LooksAtTheDisplay) {
  const VirtualDisplay display;
  ASSERT_THAT(display.name(), Not(IsEmpty()));
  const ProcessResult result = vindu({"doctor"}, display.environment());
  EXPECT_THAT(lines_of(result.out),
              Contains(AllOf(StartsWith("note  graphics"), HasSubstr("with a window: llvmpipe"))));
  EXPECT_THAT(lines_of(result.out), Contains(AllOf(HasSubstr(" display "), HasSubstr("pixels"))));
  EXPECT_EQ(result.exit_code, 0);
}

TEST_F(DoctorCommand, CallsADisplayBadThatIsNotThere) {
  const ProcessResult result = vindu({"doctor"}, {{"DISPLAY", ":4711"}});
  EXPECT_THAT(lines_of(result.out),
              Contains(AllOf(StartsWith("BAD   display"), HasSubstr("4711"))));
  EXPECT_THAT(result.out, EndsWith("To be seen to: 1, marked BAD.\n"));
  EXPECT_EQ(result.exit_code, 1);
}

TEST_F(DoctorCommand, NamesTheInterfacesThatThereAre) {
  const ProcessResult result = vindu({"doctor", "--wall", wall_with("interface = \"nowhere0\"\n")});
  EXPECT_THAT(lines_of(result.out),
              Contains(AllOf(StartsWith("BAD   network   there is no interface nowhere0"),
                             HasSubstr("[cluster] interface; "))));
  EXPECT_EQ(result.exit_code, 1);
}

TEST_F(DoctorCommand, KnowsThePartOfThisMachineInAWallOverHosts) {
  const std::string wall = wall_with("master = \"" + this_host() + "\"\n");
  const ProcessResult result = vindu({"doctor", "--wall", wall});
  EXPECT_THAT(lines_of(result.out),
              Contains(StartsWith("good  wall      " + this_host() + " is the master")));
  // Nobody resolves the tile's host, which the grid calls tile-0-0.
  EXPECT_THAT(lines_of(result.out),
              Contains(AllOf(StartsWith("BAD   network   no address is known of "),
                             HasSubstr("tile-0-0"), HasSubstr("/etc/hosts"))));
  EXPECT_EQ(result.exit_code, 1);
}

TEST_F(DoctorCommand, CallsKeysBadThatAProcessOfThisMachineLacks) {
  const std::string wall = wall_with("keys = \"keys\"\n");
  const ProcessResult without = vindu({"doctor", "--wall", wall});
  EXPECT_THAT(lines_of(without.out),
              AllOf(Contains(StartsWith("note  keys      console: missing")),
                    Contains(StartsWith("BAD   keys      master: missing; ")),
                    Contains(StartsWith("BAD   wall "))));
  EXPECT_EQ(without.exit_code, 1);

  ASSERT_EQ(vindu({"keys", "--wall", wall}).exit_code, 0);
  const ProcessResult with = vindu({"doctor", "--wall", wall});
  EXPECT_THAT(lines_of(with.out), Contains(StartsWith("good  keys      console, master, ")));
  EXPECT_THAT(with.out, Not(HasSubstr("BAD")));
}

TEST_F(DoctorCommand, CallsACameraBadThatTheWallFileNamesAndThatIsNotThere) {
  const std::string wall = wall_with("",
                                     "[[camera]]\nname = \"left\"\nsource = \"video\"\n"
                                     "device = \"/dev/video97\"\nposition_m = [0, 2, 3]\n"
                                     "look_at_m = [0, 1.6, 1]\n");
  const ProcessResult result = vindu({"doctor", "--wall", wall});
  EXPECT_THAT(lines_of(result.out),
              Contains(AllOf(StartsWith("BAD   cameras   left of the wall file: /dev/video97"),
                             HasSubstr("plug it in"))));
}

TEST_F(DoctorCommand, GoesOnAfterAWallFileThatCannotBeRead) {
  const std::string wall = write("wall.toml", "[wall]\ncolumns = 0\n");
  const ProcessResult result = vindu({"doctor", "--wall", wall});
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("good  files"), HasSubstr("BAD   wall"), HasSubstr(wall + ":2")));
  EXPECT_EQ(result.exit_code, 1);
}

TEST_F(DoctorCommand, TakesNoFileForTheFolderOfPackedModels) {
  const ProcessResult result = vindu({"doctor"}, {{"XDG_CACHE_HOME", "/dev/null"}});
  EXPECT_THAT(
      lines_of(result.out),
      Contains(AllOf(StartsWith("note  files     packed models cannot be kept in /dev/null"),
                     HasSubstr("XDG_CACHE_HOME"))));
}

TEST_F(DoctorCommand, PrintsALineOfJsonForEachFinding) {
  const ProcessResult text = vindu({"doctor"}), json = vindu({"doctor", "--json"});
  const auto lines = lines_of(json.out);
  EXPECT_THAT(lines, SizeIs(lines_of(text.out).size() - 1));  // the summary is for people
  EXPECT_THAT(lines, Each(AllOf(StartsWith("{\"part\": \""), HasSubstr("\"health\": \""),
                                HasSubstr("\"what\": \""), EndsWith("\"}"))));
}

}  // namespace
}  // namespace vindu
