// The faults that a wall has to live with: what they are called, and in which order a seed deals
// them.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace vindu::testing {

enum class Fault {
  killed,
  hung,
  crashed,
  cable_pulled,
  loss_1,
  loss_5,
  jitter,
  disk_full,
  master_killed,
  all_killed,
};
constexpr int kFaults = 10;

constexpr std::string_view name_of(Fault fault) {
  constexpr std::string_view names[] = {
      "a tile is killed",          "a tile hangs for 2 s",       "a tile's driver crashes",
      "a cable is pulled for 2 s", "1 % of packets lost, 5 s",   "5 % of packets lost, 5 s",
      "20 ms jitter, 5 s",         "a tile's disk is full, 3 s", "the master is killed",
      "all tiles are killed",
  };
  return names[static_cast<int>(fault)];
}

/// Every kind once, in an order of the seed, then again in another one, and so on.
class FaultDealer {
 public:
  /// Those whose name has `only` in it, which must be one at least.
  FaultDealer(std::uint64_t seed, const std::string& only);

  Fault next();
  bool dealt_all() const { return dealt_ >= kinds_.size(); }
  /// 0 to count - 1.
  std::size_t pick(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

 private:
  std::mt19937_64 random_;
  std::vector<Fault> kinds_, left_;
  std::size_t dealt_ = 0;
};

}  // namespace vindu::testing
