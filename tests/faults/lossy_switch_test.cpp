// The switch between cards that are sockets: who gets a frame, and what cables do to it.
#include "tests/faults/lossy_switch.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace vindu::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kEverybody = 0xff;

/// Three hosts, whose addresses are 2 (port 0), 4 and 6.
class LossySwitchTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kHosts = 3;

  LossySwitchTest() {
    for (std::size_t i = 0; i < kHosts; ++i) {
      std::array<int, 2> pair{};
      EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, pair.data()), 0);
      hosts_.push_back(pair[0]);
      cards_.push_back(pair[1]);
    }
    switch_ = std::make_unique<LossySwitch>(cards_, 7);
  }
  ~LossySwitchTest() override {
    switch_.reset();
    for (const int fd : hosts_) close(fd);
    for (const int fd : cards_) close(fd);
  }

  static std::uint8_t address(std::size_t host) { return static_cast<std::uint8_t>(2 * host + 2); }
  void send(std::size_t from, std::uint8_t to, std::uint8_t what) {
    Bytes frame(60, 0);
    frame[0] = to == kEverybody ? 1 : 0;
    frame[5] = to;
    frame[11] = address(from);
    frame[14] = what;
    ASSERT_EQ(write(hosts_[from], frame.data(), frame.size()), 60);
  }
  /// The next frame's content, or -1 when none comes for that long.
  int receive(std::size_t host, int wait_ms) {
    pollfd waiting{.fd = hosts_[host], .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, wait_ms) <= 0) return -1;
    Bytes frame(60);
    return read(hosts_[host], frame.data(), frame.size()) == 60 ? frame[14] : -1;
  }
  static constexpr int kLong = 20000, kShort = 30;

  std::vector<int> hosts_, cards_;
  std::unique_ptr<LossySwitch> switch_;
};

TEST_F(LossySwitchTest, BringsAFrameForAllToAllOthers) {
  send(0, kEverybody, 9);
  EXPECT_EQ(receive(1, kLong), 9);
  EXPECT_EQ(receive(2, kLong), 9);
  EXPECT_EQ(receive(0, kShort), -1);
}

TEST_F(LossySwitchTest, BringsAFrameForOneToThatOneOnceItWasHeard) {
  send(1, kEverybody, 1);
  EXPECT_EQ(receive(0, kLong), 1);
  EXPECT_EQ(receive(2, kLong), 1);
  send(0, address(1), 2);
  EXPECT_EQ(receive(1, kLong), 2);
  EXPECT_EQ(receive(2, kShort), -1);
}

TEST_F(LossySwitchTest, BringsNothingThroughACableThatIsPulled) {
  switch_->set(1, {.plugged = false});
  send(0, kEverybody, 1);
  EXPECT_EQ(receive(2, kLong), 1);
  EXPECT_EQ(receive(1, kShort), -1);
  switch_->set(1, {});
  send(0, kEverybody, 2);
  EXPECT_EQ(receive(1, kLong), 2);
}

TEST_F(LossySwitchTest, LosesTheShareThatItIsToldTo) {
  switch_->set(1, {.loss = 0.25});
  constexpr int kFrames = 4000;
  for (int i = 0; i < kFrames; ++i) {
    send(0, kEverybody, 1);
    EXPECT_EQ(receive(2, kLong), 1);
  }
  const double lost = static_cast<double>(switch_->lost()) / kFrames;
  EXPECT_NEAR(lost, 0.25, 4 * std::sqrt(0.25 * 0.75 / kFrames));
  EXPECT_EQ(switch_->passed() + switch_->lost(), 2u * kFrames);
}

TEST_F(LossySwitchTest, LetsLaterFramesOvertakeUnderJitterAndLosesNone) {
  switch_->set_all({.jitter = std::chrono::milliseconds(10)});
  std::vector<int> came;
  for (std::uint8_t i = 0; i < 100; ++i) send(0, kEverybody, i);
  for (int i = 0; i < 100; ++i) came.push_back(receive(1, kLong));
  EXPECT_FALSE(std::ranges::is_sorted(came));
  std::ranges::sort(came);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(came[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace vindu::testing
