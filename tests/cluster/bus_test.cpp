// The bus, over both transports alike: in one process; over DDS within one process; and over DDS
// with a domain for each participant, which speak by sockets on loopback.
#include "cluster/bus.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <map>
#include <thread>

#include "cluster/dds.h"
#include "cluster/in_process.h"
#include "core/error.h"
#include "tests/cluster/waiting.h"

namespace vindu {
namespace {

using testing::await;
using testing::await_change;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::in_ms;
using ::testing::IsEmpty;
using testing::send_until_heard;

enum class Kind { in_process, dds, dds_by_sockets };

/// Apart from whatever else is tested on this machine.
std::string private_name(const std::string& wall) { return wall + std::to_string(getpid()); }

class BusTest : public ::testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Bus> join(const std::string& name, Topics publishes, Topics subscribes,
                            int strength = 1) {
    return join_as({.role = Role::tile, .name = name, .host = "host", .version = "0.1"}, publishes,
                   subscribes, strength);
  }
  std::unique_ptr<Bus> join_as(const Participant& self, Topics publishes, Topics subscribes,
                               int strength = 1) {
    return transport().join({self, publishes, subscribes, strength});
  }

  std::string wall_ = "wall";

 private:
  Transport& transport() {
    std::unique_ptr<Transport>& shared = shared_[wall_];
    if (GetParam() == Kind::in_process) {
      if (!shared) shared = std::make_unique<InProcessTransport>();
      return *shared;
    }
    const DdsSettings settings{.name = private_name(wall_)};
    if (GetParam() == Kind::dds_by_sockets)
      return *own_.emplace_back(std::make_unique<DdsTransport>(settings));
    if (!shared) shared = std::make_unique<DdsTransport>(settings);
    return *shared;
  }

  std::map<std::string, std::unique_ptr<Transport>> shared_;  // by wall
  std::vector<std::unique_ptr<Transport>> own_;
};

std::string name_of_kind(const ::testing::TestParamInfo<Kind>& info) {
  constexpr const char* names[] = {"InProcess", "Dds", "DdsBySockets"};
  return names[static_cast<int>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Over, BusTest,
                         ::testing::Values(Kind::in_process, Kind::dds, Kind::dds_by_sockets),
                         name_of_kind);

FrameMessage frame(std::uint64_t number) { return {.epoch = 1, .newest = {.number = number}}; }
StatusMessage status_of(const std::string& tile) {
  return {.tile = tile, .incarnation = 1, .renderer = "llvmpipe"};
}
PoseMessage pose_of(const std::string& source) { return {.tracker = source}; }

TEST_P(BusTest, CarriesAFrameAsItIs) {
  const auto master = join("master", {Topic::frame}, {});
  const auto tile = join("tile-0-0", {}, {Topic::frame});
  FrameMessage sent = frame(7);
  sent.newest.eye_in_wall = {0.1, 0.2, 0.3};
  sent.present_time = Time(std::chrono::hours(3));

  const FrameMessage heard = send_until_heard(*master, sent, *tile);

  EXPECT_EQ(hash_of(heard.newest), hash_of(sent.newest));
  EXPECT_EQ(heard.epoch, sent.epoch);
  EXPECT_EQ(heard.present_time, sent.present_time);
}

TEST_P(BusTest, GivesALateReaderTheLastSceneAndEveryTilesStatus) {
  const auto master = join("master", {Topic::scene}, {});
  const auto first = join("tile-0-0", {Topic::tile_status}, {});
  const auto second = join("tile-1-0", {Topic::tile_status}, {});
  for (std::uint64_t revision = 1; revision <= 5; ++revision)
    master->publish(SceneMessage{.revision = revision, .path = "a.ply"});
  first->publish(status_of("tile-0-0"));
  second->publish(status_of("tile-1-0"));

  const auto late = join("console", {}, {Topic::scene, Topic::tile_status});

  EXPECT_EQ(await<SceneMessage>(*late).revision, 5u);
  await<StatusMessage>(*late, [seen = std::set<std::string>()](const auto& status) mutable {
    seen.insert(status.tile);
    return seen.size() == 2;
  });
}

TEST_P(BusTest, GivesALateReaderNoOldFrames) {
  const auto master = join("master", {Topic::frame, Topic::scene}, {});
  master->publish(frame(1));
  master->publish(SceneMessage{.revision = 1, .path = "a.ply"});

  const auto late = join("tile-0-0", {}, {Topic::frame, Topic::scene});

  await<SceneMessage>(*late);
  EXPECT_THAT(late->take<FrameMessage>(), IsEmpty());
}

TEST_P(BusTest, KeepsTheNewestFrameOfManyThatNobodyTook) {
  const auto master = join("master", {Topic::frame, Topic::event}, {});
  const auto tile = join("tile-0-0", {}, {Topic::frame, Topic::event});
  send_until_heard(*master, frame(1), *tile);
  send_until_heard(*master, EventMessage{.source = "key"}, *tile);

  for (std::uint64_t number = 2; number <= 100; ++number) master->publish(frame(number));
  master->publish(EventMessage{.source = "done"});
  await<EventMessage>(*tile, [](const auto& event) { return event.source == "done"; });

  std::vector<std::uint64_t> numbers;
  for (const FrameMessage& message : tile->take<FrameMessage>())
    numbers.push_back(message.newest.number);
  EXPECT_THAT(numbers, ElementsAre(100));
}

TEST_P(BusTest, DeliversEveryEventInOrder) {
  const auto device = join("touch", {Topic::event}, {});
  const auto master = join("master", {}, {Topic::event});
  send_until_heard(*device, EventMessage{.source = "table", .id = -1}, *master);

  for (int id = 0; id < 200; ++id) device->publish(EventMessage{.source = "table", .id = id});

  std::vector<int> ids;
  while (ids.empty() || ids.back() != 199) {
    master->wait({Topic::event}, in_ms(1000));
    for (const EventMessage& event : master->take<EventMessage>())
      if (event.id >= 0) ids.push_back(event.id);
  }
  ASSERT_EQ(ids.size(), 200u);
  EXPECT_TRUE(std::ranges::is_sorted(ids));
}

TEST_P(BusTest, KeepsOneOfEachTile) {
  const auto left = join("tile-0-0", {Topic::ready}, {});
  const auto right = join("tile-1-0", {Topic::ready}, {});
  const auto master = join("master", {}, {Topic::ready});
  const auto ready = [](const char* tile, std::uint64_t number) {
    return ReadyMessage{.tile = tile, .incarnation = 1, .epoch = 1, .number = number};
  };
  send_until_heard(*left, ready("tile-0-0", 1), *master);
  send_until_heard(*right, ready("tile-1-0", 1), *master);

  left->publish(ready("tile-0-0", 2));
  right->publish(ready("tile-1-0", 2));

  await<ReadyMessage>(*master, [seen = std::set<std::string>()](const auto& message) mutable {
    if (message.number == 2) seen.insert(message.tile);
    return seen.size() == 2;
  });
}

TEST_P(BusTest, HearsTheStrongerPoseAndTheWeakerOnceThatStops) {
  const auto reserve = join("master", {Topic::pose}, {}, 1);
  const auto tracker = join("tracker", {Topic::pose}, {}, 10);
  const auto reader = join("viewer", {}, {Topic::pose});
  const auto sources_heard = [&](bool tracker_speaks) {
    std::set<std::string> sources;
    for (int i = 0; i < 30; ++i) {
      if (tracker_speaks) tracker->publish(pose_of("tracker"));
      reserve->publish(pose_of("reserve"));
      reader->wait({Topic::pose}, in_ms(5));
      for (const PoseMessage& pose : reader->take<PoseMessage>()) sources.insert(pose.tracker);
    }
    return sources;
  };
  send_until_heard(*reserve, pose_of("reserve"), *reader);
  while (send_until_heard(*tracker, pose_of("tracker"), *reader).tracker != "tracker") {
  }

  EXPECT_THAT(sources_heard(true), ElementsAre("tracker"));
  while (send_until_heard(*reserve, pose_of("reserve"), *reader).tracker != "reserve") {
  }
  EXPECT_THAT(sources_heard(false), ElementsAre("reserve"));
  while (send_until_heard(*tracker, pose_of("tracker"), *reader).tracker != "tracker") {
  }
  EXPECT_THAT(sources_heard(true), ElementsAre("tracker"));
}

TEST_P(BusTest, IsNotHeldUpByAReaderThatNeverTakes) {
  const auto master = join("master", {Topic::scene, Topic::event}, {});
  const auto stalled = join("tile-0-0", {}, {Topic::scene, Topic::event});
  const auto tile = join("tile-1-0", {}, {Topic::scene, Topic::event});
  send_until_heard(*master, EventMessage{.source = "key"}, *stalled);
  send_until_heard(*master, EventMessage{.source = "key"}, *tile);
  const std::string path(1000, 'x');

  for (std::uint64_t revision = 1; revision <= 5000; ++revision) {
    master->publish(SceneMessage{.revision = revision, .path = path});
    master->publish(EventMessage{.source = "key", .text = "again"});
  }

  await<SceneMessage>(*tile, [](const auto& scene) { return scene.revision == 5000; });
}

TEST_P(BusTest, KeepsWallsOfDifferentNamesApart) {
  const auto master = join("master", {Topic::scene}, {});
  const auto tile = join("tile-0-0", {}, {Topic::scene, Topic::presence});
  wall_ = "other";
  const auto stranger = join("stranger", {}, {Topic::scene, Topic::presence});
  master->publish(SceneMessage{.revision = 1, .path = "a.ply"});

  await<SceneMessage>(*tile);
  await_change(*tile, PresenceChange::joined, "master");

  const Time end = in_ms(600);
  while (stranger->wait({Topic::scene, Topic::presence}, end)) {
    ASSERT_THAT(stranger->take<SceneMessage>(), IsEmpty());
    ASSERT_THAT(stranger->take(Topic::presence), IsEmpty());
  }
}

TEST_P(BusTest, TellsBothSidesOfAnotherVersionAndDeliversNothing) {
  const Participant old{.role = Role::master, .name = "master", .host = "a", .version = "0.1"};
  const Participant newer{.role = Role::tile,
                          .name = "tile-0-0",
                          .host = "b",
                          .version = "0.2",
                          .protocol = kProtocolVersion + 1};
  const auto master = join_as(old, {Topic::scene}, {Topic::presence});
  const auto tile = join_as(newer, {}, {Topic::scene, Topic::presence});
  master->publish(SceneMessage{.revision = 1, .path = "a.ply"});

  EXPECT_EQ(await_change(*master, PresenceChange::other_version, "tile-0-0").who, newer);
  EXPECT_EQ(await_change(*tile, PresenceChange::other_version, "master").who, old);
  EXPECT_FALSE(tile->wait({Topic::scene}, in_ms(300)));
}

TEST_P(BusTest, TellsWhoComesFallsSilentSpeaksAgainAndLeaves) {
  const auto master = join("master", {}, {Topic::presence});
  auto tile = join("tile-3-0", {Topic::tile_status}, {});
  const Participant self{.role = Role::tile, .name = "tile-3-0", .host = "host", .version = "0.1"};

  EXPECT_EQ(await_change(*master, PresenceChange::joined, "tile-3-0").who, self);
  tile->publish(status_of("tile-3-0"));
  await_change(*master, PresenceChange::alive, "tile-3-0");
  EXPECT_EQ(await_change(*master, PresenceChange::silent, "tile-3-0").who, self);
  tile->publish(status_of("tile-3-0"));
  await_change(*master, PresenceChange::alive, "tile-3-0");
  tile.reset();
  EXPECT_EQ(await_change(*master, PresenceChange::left, "tile-3-0").who, self);
}

TEST_P(BusTest, NeverHearsItself) {
  const auto one = join("one", {Topic::event}, {Topic::event, Topic::presence});
  const auto other = join("other", {Topic::event}, {Topic::event});
  send_until_heard(*one, EventMessage{.source = "one"}, *other);

  std::vector<EventMessage> heard;
  while (heard.empty()) {
    other->publish(EventMessage{.source = "other"});
    one->wait({Topic::event}, in_ms(20));
    heard = one->take<EventMessage>();
  }

  for (const EventMessage& event : heard) EXPECT_EQ(event.source, "other");
  for (const Presence& presence : one->take<Presence>()) EXPECT_EQ(presence.who.name, "other");
}

TEST_P(BusTest, SendsNothingThatNoReaderWouldTake) {
  const auto tracker = join("tracker", {Topic::pose}, {});
  const auto reader = join("viewer", {}, {Topic::pose});
  PoseMessage bad = pose_of("bad");
  bad.pose.room_from_head.translation.x() = std::numeric_limits<double>::quiet_NaN();
  send_until_heard(*tracker, pose_of("good"), *reader);

  tracker->publish(bad);
  EXPECT_EQ(send_until_heard(*tracker, pose_of("good"), *reader).tracker, "good");
}

TEST_P(BusTest, WaitsForTheTopicsThatItIsAskedForAndNoLongerThanItIsTold) {
  const auto master = join("master", {Topic::frame, Topic::scene}, {});
  const auto tile = join("tile-0-0", {}, {Topic::frame, Topic::scene});
  send_until_heard(*master, frame(1), *tile);
  EXPECT_FALSE(tile->wait({Topic::frame, Topic::scene}, in_ms(-1)));

  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    master->publish(SceneMessage{.revision = 1, .path = "a.ply"});
  });

  while (!tile->wait({Topic::scene}, in_ms(1000))) {
  }
  EXPECT_FALSE(tile->wait({Topic::frame}, in_ms(20)));
  EXPECT_THAT(tile->take<FrameMessage>(), IsEmpty());
  EXPECT_EQ(tile->take<SceneMessage>().size(), 1u);
}

TEST_P(BusTest, RefusesANameThatCannotBeSaid) { EXPECT_THROW(join("a b", {}, {}), Error); }

TEST(DdsTransport, OnAnInterfaceThatIsNotThereNamesThoseThatAre) {
  try {
    const DdsTransport transport({.interface = "eth99"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("interface eth99: the network cannot be joined; there are:"));
    EXPECT_THAT(error.what(), HasSubstr("lo"));
  }
}

TEST(DdsTransport, NeedsNoMulticastOnLoopback) {
  const DdsSettings settings{.name = private_name("unicast"), .multicast = false};
  DdsTransport here(settings), there(settings);
  const Participant self{.name = "a", .host = "b", .version = "c"};
  const auto master = here.join({self, {Topic::frame}, {}});
  const auto tile = there.join({self, {}, {Topic::frame}});

  EXPECT_EQ(send_until_heard(*master, frame(1), *tile).newest.number, 1u);
}

TEST(DdsTransport, FollowsTheEnvironment) {
  setenv("CYCLONEDDS_URI",
         "<General><Interfaces><NetworkInterface name=\"eth99\"/></Interfaces></General>", 1);
  EXPECT_THROW(DdsTransport(), Error);
  unsetenv("CYCLONEDDS_URI");
  EXPECT_NO_THROW(DdsTransport({.name = private_name("env")}));
}

}  // namespace
}  // namespace vindu
