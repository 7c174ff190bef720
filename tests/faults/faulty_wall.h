// A wall of real processes, each host with its own network, whose parts can be killed, stopped, cut
// off and started again; what dies is started again as systemd would do it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "tests/faults/host.h"
#include "tests/faults/lossy_switch.h"
#include "tests/wall/children.h"
#include "tests/wall/whole_frames.h"

namespace vindu::testing {

struct FaultyWallOptions {
  int columns = 7;
  int rows = 4;
  double scale = 0.1;
  double rate_hz = 60;
  std::string model;       ///< empty: the show
  std::string folder;      ///< for all that the run writes; is there
  std::uint64_t seed = 1;  ///< of the switch
  std::string program;     ///< vindu
};

class FaultyWall {
 public:
  /// Starts the master and all tiles. become_master_of_namespaces() must have succeeded.
  explicit FaultyWall(FaultyWallOptions options);
  ~FaultyWall();
  FaultyWall(const FaultyWall&) = delete;
  FaultyWall& operator=(const FaultyWall&) = delete;

  static constexpr std::size_t kMaster = 0;  ///< tiles are 1 to tiles()
  std::size_t tiles() const { return members_.size() - 1; }
  const std::string& name(std::size_t member) const { return members_[member]->host.name(); }

  void send(std::size_t member, int signal) { members_[member]->process->send(signal); }
  void plug(std::size_t member, bool in);
  void fill_disk(std::size_t member, bool full) { members_[member]->host.fill_disk(full); }
  void set_network(const Cable& cable) { switch_->set_all(cable); }

  /// Starts again what has ended, 0.2 s after it was seen to have. To be called often.
  void supervise(Time now);

  /// Takes in what tiles have written since.
  const std::vector<WholeFrame>& whole_frames();

  /// Swaps by the tile's processes, one after the other.
  std::vector<std::vector<Swap>> swaps(std::size_t tile);
  std::string master_log() const;

  /// What a member's process holds now.
  struct Holdings {
    double memory_mib = 0;  ///< its own, in RAM
    std::size_t files = 0;  ///< open
  };
  Holdings holdings(std::size_t member) const;

  /// Ends all by signals; what did not end well, a sentence each.
  std::vector<std::string> stop();
  /// Processes on the hosts' networks.
  std::size_t left_over() const;

 private:
  struct Member {
    Member(std::string name, int number, const std::string& folder) : host(name, number, folder) {}
    Host host;
    std::optional<Child> process;
    std::vector<SwapReader> shown;  // of each process that there was
    std::vector<std::size_t> counted;
    Time ended{};
  };

  void start(std::size_t index);

  FaultyWallOptions options_;
  std::string wall_file_;
  std::vector<std::unique_ptr<Member>> members_;
  std::unique_ptr<LossySwitch> switch_;
  WholeFrames whole_;
};

}  // namespace vindu::testing
