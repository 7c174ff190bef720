// The wall on one machine: which processes it is made of and how they are called.
#pragma once

#include <string>
#include <vector>

#include "cluster/launch/supervisor.h"
#include "core/clock.h"
#include "core/site.h"

namespace vindu {

/// What `vindu launch` was asked for. Options of the master and of the tiles are handed on as they
/// were given.
struct LaunchRequest {
  std::string program;  ///< vindu's own path
  std::string wall_file;
  std::vector<std::string> master_arguments{};
  std::vector<std::string> tile_arguments{};
};

/// "vindu master --wall FILE ..."
std::vector<std::string> master_words(const LaunchRequest& request);

/// "vindu tile TILE... --wall FILE ..."
std::vector<std::string> tile_words(const LaunchRequest& request,
                                    const std::vector<std::string>& tiles);

/// A master, named so, and the tiles, so many in a process.
std::vector<ProcessPlan> local_wall(const LaunchRequest& request, const Wall& wall,
                                    int tiles_per_process);

/// Held while a wall runs on this machine: two of the same name would be one with two masters.
/// The kernel gives it back when its holder dies.
class WallClaim {
 public:
  /// Throws Error where another wall of this name and domain runs here.
  explicit WallClaim(const ClusterConfig& cluster);

 private:
  FileDescriptor socket_;
};

/// Waits until no launched wall of this name and domain runs on this machine, its processes
/// included. False: one still does.
bool wait_until_ended(const ClusterConfig& cluster, Duration patience);

}  // namespace vindu
