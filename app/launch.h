// vindu launch in its two forms: the processes of this machine, and the hosts of a wall.
#pragma once

#include <CLI/CLI.hpp>

#include "cluster/launch/host_plan.h"
#include "cluster/launch/hosts.h"
#include "cluster/launch/local_wall.h"

namespace vindu::app {

/// Until it is stopped. Returns the exit code.
int launch_here(const LaunchRequest& request, const Site& site, int tiles_per_process);

/// Which of the two a wall file means: it runs over hosts when it names the master's.
inline bool has_hosts(const Site& site) { return !site.cluster.master.empty(); }

/// Throws Error for a wall of one machine.
Site load_site_with_hosts(const std::string& wall_file);

constexpr const char* kEngineOfHosts = "systemd";  ///< unless another one is asked for

struct HostOptions {
  std::string engine = kEngineOfHosts;  ///< or "slurm"
  bool dry_run = false;
};
void add_engine(CLI::App& app, std::string& engine);

/// Starts the wall and returns: it is the hosts' own. Empty hashes are filled in.
int launch_on_hosts(HostRequest request, const Site& site, const std::string& wall_file,
                    const HostOptions& options);

/// By the engine that it was started with.
int stop_on_hosts(const Site& site, const std::string& engine);

/// The plans of the hosts with these names, or with tiles of these names; of all for no name.
/// Throws Error for a name that the wall does not have.
std::vector<HostPlan> choose_hosts(const Site& site, const std::vector<std::string>& names);

/// Says who failed; returns the exit code. `done`: "started"
int conclude(const std::vector<HostReport>& reports, const std::string& done);

/// Of a file here, as 64 hexadecimal digits.
std::string sha256_of(const std::string& file);

}  // namespace vindu::app
