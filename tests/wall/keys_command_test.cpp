// A wall with keys as its admin makes it: vindu keys, deploy, and real processes that are heard by
// who has a key and by nobody else.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/app/process.h"
#include "tests/wall/children.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

class KeysCommand : public AppTest {
 protected:
  std::string wall(const std::string& file, const std::string& cluster) const {
    return write(file,
                 "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 2\nheight_m = 1\n"
                 "tile_width_px = 1024\ntile_height_px = 768\n[cluster]\nname = \"keys-" +
                     std::to_string(getpid()) + "\"\n" + cluster);
  }
  ProcessResult keys(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"keys", "--wall", wall_file_});
    return vindu::testing::vindu(more);
  }
  Child start(std::vector<std::string> words, const std::string& log) const {
    words.insert(words.begin(), VINDU_PROGRAM);
    words.insert(words.end(), {"--wall", wall_file_});
    return Child(words, path(log));
  }
  void await_log(const std::string& log, const std::string& text) const {
    while (bytes_of(path(log)).find(text) == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  std::string wall_file_ = wall("wall.toml", "keys = \"keys\"\n");
};

TEST_F(KeysCommand, MakesAWallThatIsHeardByNobodyWithoutAKey) {
  const std::string open_wall = wall("open.toml", "");
  ASSERT_EQ(keys().exit_code, 0);
  const Child master = start({"master", small_model(), "--mode", "loop"}, "master.log");
  const Child left = start({"tile", "tile-0-0", "--headless", "--scale", "0.1"}, "left.log");
  const Child right = start({"tile", "tile-1-0", "--headless", "--scale", "0.1"}, "right.log");
  await_log("master.log", "tile-0-0: admitted");
  await_log("master.log", "tile-1-0: admitted");

  const ProcessResult stranger = testing::vindu({"status", "--wall", open_wall});
  const ProcessResult console = testing::vindu({"status", "--wall", wall_file_});

  EXPECT_EQ(stranger.exit_code, 1);
  EXPECT_THAT(stranger.out, AllOf(HasSubstr("missing"), Not(HasSubstr("in the frame lock"))));
  EXPECT_THAT(stranger.err, HasSubstr("a wall with keys is heard with them alone"));
  EXPECT_THAT(console.out, AllOf(HasSubstr("master on"), HasSubstr("of 2 tiles")));
  EXPECT_EQ(testing::vindu({"stop", "--wall", open_wall, "--timeout", "1"}).exit_code, 1);
  EXPECT_EQ(testing::vindu({"stop", "--wall", wall_file_, "--timeout", "60"}).exit_code, 0);
}

TEST_F(KeysCommand, MakesThemForEveryoneOnceAndSaysWhatIsNext) {
  const ProcessResult first = keys();
  const std::string before = bytes_of(path("keys/hosts/tile-0-0/private.pem"));
  const ProcessResult second = keys();

  EXPECT_THAT(first.out, AllOf(HasSubstr("a new authority"), HasSubstr("hosts/tile-1-0"),
                               HasSubstr("made"), HasSubstr("next: ")));
  EXPECT_THAT(second.out, AllOf(HasSubstr("kept, good"), Not(HasSubstr("made"))));
  EXPECT_EQ(bytes_of(path("keys/hosts/tile-0-0/private.pem")), before);
  EXPECT_EQ(keys({"--list"}).exit_code, 0);
}

TEST_F(KeysCommand, RenewsOneThatIsNamed) {
  keys();
  const std::string master = bytes_of(path("keys/master/private.pem"));
  const std::string tile = bytes_of(path("keys/hosts/tile-0-0/private.pem"));

  const ProcessResult result = keys({"--renew", "--key", "tile-0-0", "--days", "20"});

  EXPECT_THAT(result.out, HasSubstr("made again"));
  EXPECT_EQ(bytes_of(path("keys/master/private.pem")), master);
  EXPECT_NE(bytes_of(path("keys/hosts/tile-0-0/private.pem")), tile);
  const ProcessResult list = keys({"--list"});
  EXPECT_EQ(list.exit_code, 1);
  EXPECT_THAT(list.out, HasSubstr("ends soon"));
}

TEST_F(KeysCommand, RevokesOneWhoThenCannotStart) {
  keys();
  EXPECT_THAT(keys({"--revoke", "tile-0-0"}).out, HasSubstr("1 certificates revoked"));
  EXPECT_THAT(keys({"--list"}).out, HasSubstr("revoked"));

  const ProcessResult tile =
      testing::vindu({"tile", "tile-0-0", "--headless", "--wall", wall_file_});

  EXPECT_EQ(tile.exit_code, 1);
  EXPECT_THAT(tile.err, AllOf(HasSubstr("tile-0-0/certificate.pem: does not count: certificate "
                                        "revoked"),
                              HasSubstr("vindu keys --renew --key hosts/tile-0-0")));
}

TEST_F(KeysCommand, RefusesNamesThatTheWallDoesNotHave) {
  const ProcessResult result = keys({"--key", "../../etc"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("the wall has no ../../etc"));
  EXPECT_EQ(keys({"--days", "0"}).exit_code, 2);
}

TEST_F(KeysCommand, AreAskedForWhereTheWallFileNamesThem) {
  const ProcessResult result = testing::vindu({"status", "--wall", wall_file_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("identity_ca.pem: cannot be read"), HasSubstr("vindu keys")));
}

class Deploy : public KeysCommand {
 protected:
  Deploy() {
    wall("wall.toml", "master = \"head\"\nkeys = \"keys\"\n");
    keys();
  }
  ProcessResult deploy(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"deploy", "--dry-run", "--wall", wall_file_});
    return testing::vindu(more);
  }
};

TEST_F(Deploy, BringsEachHostItsOwnKeysAlone) {
  const ProcessResult result = deploy();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& line : lines_of(result.out)) {
    EXPECT_THAT(line, Not(HasSubstr("/ca/")));
    for (const auto& [host, own] :
         {std::pair("head", "keys/master/"), std::pair("tile-0-0", "keys/hosts/tile-0-0/"),
          std::pair("tile-1-0", "keys/hosts/tile-1-0/")})
      if (line.starts_with("# " + std::string(host) + ":") && line.ends_with("private.pem")) {
        EXPECT_THAT(line, HasSubstr(own));
      }
  }
  EXPECT_THAT(result.out, AllOf(HasSubstr("# head: keys/master/private.pem"),
                                HasSubstr("# tile-1-0: keys/hosts/tile-1-0/private.pem"),
                                HasSubstr("# tile-1-0: keys/revoked.pem")));
}

TEST_F(Deploy, TellsTheOthersOfARevokedKeyAndBringsItNoMore) {
  keys({"--revoke", "tile-0-0"});

  const ProcessResult result = deploy();

  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("the key hosts/tile-0-0 is revoked: tile-0-0 does not get it"));
  EXPECT_THAT(result.out, AllOf(HasSubstr("# tile-1-0: keys/revoked.pem"),
                                HasSubstr("# tile-1-0: keys/hosts/tile-1-0/private.pem"),
                                Not(HasSubstr("keys/hosts/tile-0-0/"))));
}

TEST_F(Deploy, LeavesTheKeysOutOfAModelsFolder) {
  write("model.obj", "v 0 0 0\n");
  EXPECT_EQ(deploy({path("model.obj")}).exit_code, 0);

  fs::create_directories(path("models/more"));
  fs::create_directory_symlink(path("keys"), path("models/more/textures"));
  write("models/model.obj", "v 0 0 0\n");
  const ProcessResult result = deploy({path("models/model.obj")});

  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("would come along to every host"));
}

TEST_F(Deploy, RefusesKeysOutsideOfTheWallFilesFolder) {
  wall("wall.toml", "master = \"head\"\nkeys = \"../keys\"\n");
  EXPECT_THAT(deploy().err, HasSubstr("is no folder below the wall file's"));
}

}  // namespace
}  // namespace vindu
