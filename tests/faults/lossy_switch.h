// An Ethernet switch in this process, between hosts whose network cards are file descriptors (TAP
// devices): it loses and delays frames as it is told, by seed, and its cables can be pulled. It is
// what kernels without netem offer for a bad network.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <queue>
#include <random>
#include <thread>
#include <vector>

#include "core/clock.h"

namespace vindu::testing {

/// One port's cable, for frames in both directions.
struct Cable {
  bool plugged = true;
  double loss = 0;    ///< share of the frames that get lost
  Duration delay{};   ///< of every frame
  Duration jitter{};  ///< and up to this much more, evenly drawn: later frames overtake
};

class LossySwitch {
 public:
  /// The cards give and take one whole frame a read or write, and must outlive it.
  LossySwitch(std::vector<int> cards, std::uint64_t seed);
  ~LossySwitch();
  LossySwitch(const LossySwitch&) = delete;
  LossySwitch& operator=(const LossySwitch&) = delete;

  void set(std::size_t port, const Cable& cable);
  void set_all(const Cable& cable);

  std::uint64_t passed() const { return passed_; }
  std::uint64_t lost() const { return lost_; }

 private:
  using Frame = std::vector<std::uint8_t>;
  struct Delayed {
    Time due{};
    std::size_t port = 0;
    Frame frame;
    bool operator>(const Delayed& other) const { return due > other.due; }
  };

  void run();
  void take_from(std::size_t port);
  void forward(std::size_t from, const Frame& frame);
  void pass(std::size_t from, std::size_t to, const Frame& frame);
  void deliver_due();
  int wait_ms() const;
  bool lost_on(const Cable& cable);
  Duration delay_on(const Cable& cable);

  MonotonicClock clock_;
  std::vector<int> cards_;
  std::mutex mutex_;
  std::vector<Cable> cables_;
  std::mt19937_64 random_;
  std::map<std::uint64_t, std::size_t> port_of_;  // by address, as learned from its frames
  std::priority_queue<Delayed, std::vector<Delayed>, std::greater<>> delayed_;
  std::atomic<std::uint64_t> passed_ = 0, lost_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace vindu::testing
