// A master in this process and 28 tiles in 28 others, on loopback. Under the thread sanitizer 7: so
// many of its processes would hear each other too slowly ever to have found all.
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include "cluster/dds.h"
#include "core/wall.h"
#include "tests/cluster/waiting.h"

extern char** environ;

namespace vindu {
namespace {

using testing::await_change;
using testing::in_ms;

#ifdef __SANITIZE_THREAD__
constexpr int kRows = 1;
#else
constexpr int kRows = 4;
#endif
constexpr std::size_t kPeers = std::size_t{7} * kRows;

/// A bus_peer that ends with its scope.
class Peer {
 public:
  Peer(std::string tile, std::string wall) : tile_(std::move(tile)) {
    std::string program = VINDU_BUS_PEER;
    std::string role = "tile";
    char* const words[] = {program.data(), role.data(), tile_.data(), wall.data(), nullptr};
    EXPECT_EQ(posix_spawn(&process_, words[0], nullptr, nullptr, words, environ), 0);
  }
  ~Peer() {
    if (process_ > 0) end();
  }
  Peer(Peer&& other) noexcept
      : tile_(std::move(other.tile_)), process_(std::exchange(other.process_, -1)) {}
  Peer& operator=(Peer&&) = delete;

  const std::string& tile() const { return tile_; }
  void send(int signal) { kill(process_, signal); }
  void end() {
    send(SIGKILL);
    waitpid(std::exchange(process_, -1), nullptr, 0);
  }

 private:
  std::string tile_;
  pid_t process_ = -1;
};

class Processes : public ::testing::Test {
 protected:
  Processes() {
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < 7; ++column) peers_.emplace_back(tile_name(column, row), wall_);
    std::set<std::string> missing = names();
    while (!missing.empty()) {
      master_->wait({Topic::presence}, in_ms(1000));
      for (const Presence& presence : master_->take<Presence>())
        if (presence.change == PresenceChange::alive) missing.erase(presence.who.name);
    }
    EXPECT_EQ(ready_tiles(kPeers), names());
  }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const Peer& peer : peers_) names.insert(peer.tile());
    return names;
  }

  /// Shows a new frame until so many tiles have said that they are ready for it.
  std::set<std::string> ready_tiles(std::size_t count) {
    ++number_;
    std::set<std::string> ready;
    while (ready.size() < count) {
      master_->publish(FrameMessage{.epoch = 1, .newest = {.number = number_}});
      master_->wait({Topic::ready}, in_ms(4));
      for (const ReadyMessage& message : master_->take<ReadyMessage>())
        if (message.number == number_) ready.insert(message.tile);
    }
    return ready;
  }

  std::string wall_ = "processes" + std::to_string(getpid());
  DdsTransport transport_{{.name = wall_}};
  std::unique_ptr<Bus> master_ = transport_.join({{Role::master, "master", "here", "0.1"},
                                                  {Topic::frame, Topic::scene},
                                                  {Topic::ready, Topic::presence}});
  std::vector<Peer> peers_;
  std::uint64_t number_ = 0;
};

TEST_F(Processes, OneThatIsKilledIsNamedAndTheOthersGoOn) {
  Peer& victim = peers_[kPeers / 2];

  victim.end();

  EXPECT_EQ(await_change(*master_, PresenceChange::silent, victim.tile()).who.role, Role::tile);
  await_change(*master_, PresenceChange::left, victim.tile());
  std::set<std::string> others = names();
  others.erase(victim.tile());
  EXPECT_EQ(ready_tiles(kPeers - 1), others);
}

TEST_F(Processes, OneThatIsStoppedHoldsNobodyUpAndComesBackByItself) {
  Peer& victim = peers_[3];

  victim.send(SIGSTOP);
  await_change(*master_, PresenceChange::silent, victim.tile());
  std::set<std::string> others = names();
  others.erase(victim.tile());
  for (std::uint64_t frame = 1; frame <= 500; ++frame) {
    master_->publish(SceneMessage{.revision = frame, .path = std::string(1000, 'x')});
    ASSERT_EQ(ready_tiles(kPeers - 1), others);
  }
  victim.send(SIGCONT);

  await_change(*master_, PresenceChange::alive, victim.tile());
  EXPECT_EQ(ready_tiles(kPeers), names());
}

TEST_F(Processes, OneThatIsStartedAgainIsBack) {
  Peer& victim = peers_.front();
  const std::string tile = victim.tile();
  victim.end();
  await_change(*master_, PresenceChange::left, tile);

  peers_.emplace_back(tile, wall_);

  await_change(*master_, PresenceChange::alive, tile);
  EXPECT_EQ(ready_tiles(kPeers).count(tile), 1u);
}

}  // namespace
}  // namespace vindu
