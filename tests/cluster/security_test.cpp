// A wall with keys, over real sockets: who has one takes part as his role may, who has none neither
// reads nor writes. Strangers are real DDS participants of the same wall's name, with the keys that
// a stranger can have.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "cluster/dds.h"
#include "cluster/keys/authority.h"
#include "core/error.h"
#include "core/random.h"
#include "tests/cluster/random_messages.h"
#include "tests/cluster/waiting.h"
#include "tests/wall/children.h"

namespace vindu {
namespace {

using std::chrono::system_clock;
using testing::await_change;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::in_ms;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::send_until_heard;
using ::testing::ThrowsMessage;

const KeyOwner kMaster{Role::master}, kTracker{Role::tracker}, kConsole{Role::console};
KeyOwner tile_of(const std::string& host) { return {Role::tile, host}; }

Validity for_days(int days) {
  const auto now = system_clock::now();
  return {now - std::chrono::days(1), now + std::chrono::days(days)};
}

class Security : public ::testing::Test {
 protected:
  struct Member {
    std::unique_ptr<DdsTransport> transport;
    std::unique_ptr<Bus> bus{};
    Bus* operator->() const { return bus.get(); }
    Bus& operator*() const { return *bus; }
  };

  Security() : authority_(folder_ / "keys") {
    for (const KeyOwner& owner : {kMaster, kTracker, kConsole, tile_of("left"), tile_of("right")})
      authority_.issue(owner, for_days(100));
  }
  ~Security() override { std::filesystem::remove_all(folder_); }

  static std::filesystem::path new_folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "vindu_security_XXXXXX";
    return mkdtemp(pattern.data());
  }
  std::string keys() const { return folder_ / "keys"; }
  Credentials key_of(const KeyOwner& owner) const { return read_credentials(keys(), owner); }

  Member join(Role role, const std::string& name, Topics publishes, Topics subscribes,
              std::optional<Credentials> credentials) const {
    DdsSettings settings{.name = wall_, .domain = domain_};
    settings.credentials = std::move(credentials);
    Member member{std::make_unique<DdsTransport>(settings)};
    member.bus = member.transport->join({{role, name, "here", "0.1"}, publishes, subscribes});
    return member;
  }
  /// Everything that its role may do, with a key of its own.
  Member join(const KeyOwner& owner) const {
    const TopicRights rights = rights_of(owner.role);
    Topics reads = rights.reads;
    if (reads.has(Topic::tile_status)) reads.add(Topic::presence);
    return join(owner.role, owner.host.empty() ? std::string(name_of(owner.role)) : owner.host,
                rights.writes, reads, key_of(owner));
  }

  std::filesystem::path folder_ = new_folder();
  std::string wall_ = "security" + std::to_string(getpid());
  int domain_ = 20 + getpid() % 60;  // ports of its own: some of these tests flood them
  Authority authority_;
};

TEST_F(Security, EveryTopicArrivesWhereARoleMayReadIt) {
  const Member members[] = {join(kMaster), join(kTracker), join(kConsole), join(tile_of("left")),
                            join(tile_of("right"))};
  const Role roles[] = {Role::master, Role::tracker, Role::console, Role::tile, Role::tile};
  Random random(1);
  int pairs = 0;
  for (int from = 0; from < 4; ++from)
    for (int to = 0; to < 5; ++to)
      for (int i = 0; i < kTopics; ++i) {
        const auto topic = static_cast<Topic>(i);
        if (from == to || !rights_of(roles[from]).writes.has(topic) ||
            !rights_of(roles[to]).reads.has(topic))
          continue;
        const Message message = testing::random_message(random, topic);
        do {
          members[from]->publish(message);
          members[to]->wait({topic}, in_ms(20));
        } while (members[to]->take(topic).empty());
        ++pairs;
      }
  EXPECT_GE(pairs, 30);
}

/// Shows frames to the tile, and takes in what it heard, until it heard so many.
void show_frames(Bus& master, Bus& tile, int count, std::vector<FrameMessage>& heard) {
  for (std::uint64_t number = 1; count > 0; ++number) {
    master.publish(FrameMessage{.epoch = 1, .newest = {.number = number}});
    tile.wait({Topic::frame}, in_ms(10));
    for (FrameMessage& frame : tile.take<FrameMessage>()) {
      if (frame.epoch == 1) --count;
      heard.push_back(std::move(frame));
    }
  }
}

bool any_of_epoch(const std::vector<FrameMessage>& frames, std::uint64_t epoch) {
  return std::ranges::any_of(frames, [&](const auto& frame) { return frame.epoch == epoch; });
}

/// What a wall of master, console and one tile made of somebody who joined it as a master.
struct Reception {
  bool wrote = false;                ///< the tile heard his frames
  bool read = false;                 ///< he heard the tile's status, or commands
  std::vector<std::string> present;  ///< whom the console saw
};

class Stranger : public Security {
 protected:
  Reception receive(const std::optional<Credentials>& credentials) {
    const Member master = join(kMaster), tile = join(tile_of("left")), console = join(kConsole);
    const Topics hears = {Topic::ready, Topic::tile_status, Topic::command};
    const Member stranger =
        join(Role::master, "stranger", {Topic::frame, Topic::scene}, hears, credentials);
    Reception reception;
    std::vector<FrameMessage> frames;
    for (int i = 0; i < 100; ++i) {
      stranger->publish(FrameMessage{.epoch = 666, .newest = {.number = 1}});
      tile->publish(StatusMessage{.tile = "left", .incarnation = 1});
      console->publish(CommandMessage{.sender = "console", .request = 1, .argument = "secret"});
      show_frames(*master, *tile, 1, frames);
      for (const Topic topic : {Topic::tile_status, Topic::command})
        reception.read = reception.read || !stranger->take(topic).empty();
      for (const Presence& presence : console->take<Presence>())
        reception.present.push_back(presence.who.name);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    reception.wrote = any_of_epoch(frames, 666);
    return reception;
  }
  std::string late_says() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "late.log").rdbuf();
    return text.str();
  }
  void expect_nobody(const std::optional<Credentials>& credentials) {
    const Reception reception = receive(credentials);
    EXPECT_FALSE(reception.wrote);
    EXPECT_FALSE(reception.read);
    EXPECT_THAT(reception.present, Contains("left"));
    EXPECT_THAT(reception.present, Not(Contains("stranger")));
  }
};

TEST_F(Stranger, IsAMasterWithAMastersKey) {
  const Reception reception = receive(key_of(kMaster));

  EXPECT_TRUE(reception.wrote);
  EXPECT_TRUE(reception.read);
  EXPECT_THAT(reception.present, Contains("stranger"));
}

TEST_F(Stranger, IsNobodyWithoutAKey) { expect_nobody(std::nullopt); }

TEST_F(Stranger, IsNobodyWithAKeyOfAnotherAuthority) {
  Authority other(folder_ / "other");
  other.issue(kMaster, for_days(100));
  expect_nobody(read_credentials(folder_ / "other", kMaster));
}

TEST_F(Stranger, IsNobodyWithPermissionsOfAnotherAuthority) {
  Authority other(folder_ / "other");
  other.issue(kMaster, for_days(100));
  const Credentials forged = read_credentials(folder_ / "other", kMaster);
  Credentials stolen = key_of(kMaster);
  stolen.permissions_ca = forged.permissions_ca;
  stolen.governance = forged.governance;
  stolen.permissions = forged.permissions;
  expect_nobody(stolen);
}

/// He keeps his own, old list of revoked certificates.
TEST_F(Stranger, IsNobodyWithARevokedKey) {
  const Credentials stolen = key_of(kMaster);
  authority_.issue(kMaster, for_days(100));
  authority_.revoke(kMaster);
  authority_.issue(kMaster, for_days(100));
  expect_nobody(stolen);
}

/// His clock is half a day late, so that his own DDS finds nothing wrong with his key.
TEST_F(Stranger, IsNobodyWithAKeyThatEndedWhateverHisClockSays) {
  const Member master = join(kMaster), tile = join(tile_of("left")), console = join(kConsole);
  const auto now = system_clock::now();
  std::set<std::string> present;
  for (const int hours_left : {24, -6}) {
    authority_.issue(kMaster, {now - std::chrono::days(30), now + std::chrono::hours(hours_left)});
    tile->take(Topic::frame);  // what the one before said last
    const testing::Child late({VINDU_LATE_PEER, wall_, std::to_string(domain_), keys(), "12"},
                              folder_ / "late.log");
    std::vector<FrameMessage> frames;
    for (int i = 0; i < 300 && !any_of_epoch(frames, 666); ++i) {
      show_frames(*master, *tile, 1, frames);
      for (const Presence& presence : console->take<Presence>()) present.insert(presence.who.name);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_THAT(late_says(), HasSubstr("joined"));
    EXPECT_EQ(any_of_epoch(frames, 666), hours_left > 0);
  }
  EXPECT_THAT(present, Contains("left"));
}

/// To the ports of the wall's participants, what begins as a packet of theirs does.
void flood_ports(int domain, const std::atomic<bool>& enough) {
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  Random random(7);
  while (!enough)
    for (int port = 0; port < 30; ++port) {
      std::string packet("RTPS\x02\x04\x01\x10");
      const int size = static_cast<int>(random.uniform(0, 1000));
      for (int i = 0; i < size; ++i) packet += static_cast<char>(random.uniform(0, 256));
      sockaddr_in to{};
      to.sin_family = AF_INET;
      to.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain + port));
      to.sin_addr.s_addr = htonl(port < 2 ? 0xefff0001 : INADDR_LOOPBACK);  // or 239.255.0.1
      sendto(sender, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
    }
  close(sender);
}

TEST_F(Stranger, WhoFloodsTheWallStopsNothing) {
  const Member master = join(kMaster), tile = join(tile_of("left"));
  const Member stranger =
      join(Role::master, "stranger", {Topic::frame, Topic::scene, Topic::event}, {}, std::nullopt);
  std::atomic<bool> enough = false;
  std::thread flood([&] {
    while (!enough)
      for (std::uint64_t i = 1; i < 1000; ++i) {
        stranger->publish(FrameMessage{.epoch = 666, .newest = {.number = i}});
        stranger->publish(SceneMessage{.revision = i, .path = std::string(900, 'x')});
      }
  });
  std::thread ports([&] { flood_ports(domain_, enough); });
  std::vector<FrameMessage> frames;

  show_frames(*master, *tile, 200, frames);

  enough = true;
  flood.join();
  ports.join();
  EXPECT_FALSE(any_of_epoch(frames, 666));
  EXPECT_THAT(tile->take<SceneMessage>(), IsEmpty());
}

TEST_F(Security, ATileMayNotActAsMasterNorAsConsole) {
  for (const Topic topic : {Topic::frame, Topic::scene, Topic::command, Topic::pose, Topic::answer})
    EXPECT_THAT([&] { join(Role::tile, "left", {topic}, {}, key_of(tile_of("left"))); },
                ThrowsMessage<Error>(HasSubstr("the key of this tile does not allow")));
}

TEST_F(Security, AKeyThatEndedIsRefusedByDdsItself) {
  authority_.issue(kMaster, {system_clock::now() - std::chrono::days(9),
                             system_clock::now() - std::chrono::days(1)});
  EXPECT_THROW(join(Role::master, "master", {}, {}, read_credential_files(keys(), kMaster)), Error);
}

TEST_F(Security, AKeyThatEndsIsHeardNoMore) {
  const Member master = join(kMaster);
  const auto end = system_clock::now() + std::chrono::seconds(8);
  authority_.issue(tile_of("left"), {system_clock::now() - std::chrono::days(1), end});
  const Member tile = join(tile_of("left"));
  send_until_heard(*tile, ReadyMessage{.tile = "left", .incarnation = 1, .epoch = 1, .number = 1},
                   *master);

  await_change(*master, PresenceChange::left, "left");

  // On a machine with too much to do it may have left before, and come back.
  std::this_thread::sleep_until(end + std::chrono::seconds(1));
  master->take(Topic::ready);
  for (int i = 0; i < 20; ++i)
    tile->publish(ReadyMessage{.tile = "left", .incarnation = 1, .epoch = 1, .number = 2});
  master->wait({Topic::ready}, in_ms(300));
  EXPECT_THAT(master->take(Topic::ready), IsEmpty());
}

}  // namespace
}  // namespace vindu
