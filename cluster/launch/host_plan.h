// The wall over hosts: which host has which tiles, and the texts that make systemd or Slurm run
// them there. A host keeps its files in ~/.vindu: bin/vindu, share/vindu, wall.toml, scene/.
#pragma once

#include <string>
#include <vector>

#include "core/site.h"

namespace vindu {

struct HostPlan {
  std::string host;
  std::vector<std::string> tiles{};
  bool master = false;
};

/// Each host once. Throws Error for a name that ssh or clush would take for something else.
std::vector<HostPlan> host_plans(const Site& site);

std::vector<std::string> names_of(const std::vector<HostPlan>& hosts);

/// What the hosts are to run. Arguments are those of vindu master and vindu tile besides --wall and
/// tiles.
struct HostRequest {
  std::string model{};  ///< a file's name in ~/.vindu/scene; empty: the wall file's, or the show
  std::vector<std::string> master_arguments{};
  std::vector<std::string> tile_arguments{};
  bool headless = false;
  /// SHA-256, 64 hexadecimal digits, of the program and the wall file that the hosts should have.
  std::string program_sha256{};
  std::string wall_sha256{};
};

constexpr const char* kTileUnit = "vindu-tile.service";
constexpr const char* kMasterUnit = "vindu-master.service";

/// The same on all hosts: which tiles are a host's own is in a drop-in of its own, as $TILES.
std::string tile_unit(const HostRequest& request);
std::string master_unit(const HostRequest& request);

/// A POSIX shell script, the same for all hosts: each finds itself by its own name (`uname -n`).
/// It checks the host, writes its units, and starts them; it says how that went as on_hosts()
/// (hosts.h) reads it.
std::string start_script(const std::vector<HostPlan>& hosts, const HostRequest& request);
/// vindu doctor on each host, on the display of its screen where somebody is logged in there; fails
/// where its files are not those of the request.
std::string doctor_script(const std::vector<HostPlan>& hosts, const HostRequest& request);
std::string stop_script();
/// Of what was launched on the host, whether it runs or not.
std::string restart_script();
std::string log_script(int lines);
/// The paths of what vindu tile kept of a frame (app/captures.h), a line for each of the host's
/// tiles: of `folder`/`prefix`TILE.png, where each of them was found within so many seconds.
std::string kept_script(const std::vector<HostPlan>& hosts, const std::string& folder,
                        const std::string& prefix, int seconds);

/// For sbatch --wrap: one step over all hosts, each starting again what dies.
std::string slurm_script(const std::vector<HostPlan>& hosts, const HostRequest& request);

}  // namespace vindu
