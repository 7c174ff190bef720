#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/common.h"
#include "app/launch.h"
#include "cluster/launch/node_set.h"
#include "cluster/launch/words.h"
#include "core/error.h"

namespace vindu::app {
namespace {

std::string job_of(const Site& site) { return "vindu-" + site.cluster.name; }

/// Throws Error where Slurm does not take it.
std::string ask_slurm(const std::vector<std::string>& words) {
  const ProgramResult result = run_program(words);
  if (result.exit_code == 127)
    throw Error({"is not installed here", words.front(),
                 "apt-get install slurm-client, or leave out --engine slurm"});
  if (result.exit_code != 0)
    throw Error({result.err.empty() ? "failed" : result.err.front(), words.front(),
                 "see sinfo and squeue"});
  return result.out.empty() ? "" : result.out.front();
}

std::vector<std::string> sbatch_words(const Site& site, const std::vector<std::string>& hosts) {
  return {"sbatch",
          "--parsable",
          "--job-name",
          job_of(site),
          "--nodelist",
          fmt::format("{}", fmt::join(hosts, ",")),  // Slurm reads no text behind a bracket
          "--nodes",
          std::to_string(hosts.size()),
          "--ntasks-per-node=1",
          "--no-kill",
          "--output",
          job_of(site) + ".log"};
}

int launch_by_slurm(const HostRequest& request, const Site& site) {
  const auto hosts = host_plans(site);
  auto words = sbatch_words(site, names_of(hosts));
  words.insert(words.end(), {"--wrap", slurm_script(hosts, request)});
  fmt::print("job {}: {} hosts; its lines: {}.log\n", ask_slurm(words), hosts.size(), job_of(site));
  return 0;
}

void print_plan(const HostRequest& request, const Site& site, const HostOptions& options) {
  const auto hosts = host_plans(site);
  if (options.engine == "slurm") {
    fmt::print("# {} --wrap SCRIPT, with this script:\n{}",
               shell_words(sbatch_words(site, names_of(hosts))), slurm_script(hosts, request));
    return;
  }
  const std::string script = start_script(hosts, request);
  auto words = clush_words(names_of(hosts), script);
  words.back() = "sh";
  fmt::print("# {}, with this script:\n{}", shell_words(words), script);
}

}  // namespace

Site load_site_with_hosts(const std::string& wall_file) {
  Site site = load_site(wall_file);
  if (!has_hosts(site))
    throw Error(
        {"names no master in its [cluster]: the wall is on this machine alone",
         wall_file.empty() ? "the default wall file" : wall_file,
         "vindu launch, as long as it runs, shows its lines and starts again what dies; end "
         "it by vindu stop. For a wall over hosts name the master's host there"});
  return site;
}

void add_engine(CLI::App& app, std::string& engine) {
  app.add_option("--engine", engine,
                 "Of a wall over hosts: systemd: units of each user's, over ssh and clush;\n"
                 "slurm: one job")
      ->check(CLI::IsMember({"systemd", "slurm"}));
}

std::string sha256_of(const std::string& file) {
  const ProgramResult result = run_program({"sha256sum", "--", file});
  // A name with a backslash or a line's end makes it write "\" first.
  const std::string line = result.out.empty() ? "" : result.out.front();
  std::string digits = line.substr(line.starts_with('\\') ? 1 : 0, 64);
  if (result.exit_code != 0 || digits.size() != 64)
    throw Error({"cannot be read", file, "see that it is there"});
  return digits;
}

int launch_on_hosts(HostRequest request, const Site& site, const std::string& wall_file,
                    const HostOptions& options) {
  request.program_sha256 = sha256_of(std::filesystem::read_symlink("/proc/self/exe"));
  request.wall_sha256 = sha256_of(wall_file);
  if (options.dry_run) {
    print_plan(request, site, options);
    return 0;
  }
  if (options.engine == "slurm") return launch_by_slurm(request, site);
  const auto hosts = host_plans(site);
  return conclude(on_hosts(names_of(hosts), start_script(hosts, request)), "started");
}

int stop_on_hosts(const Site& site, const std::string& engine) {
  if (engine == "slurm") {
    ask_slurm({"scancel", "--name", job_of(site)});
    return 0;
  }
  return conclude(on_hosts(names_of(host_plans(site)), stop_script()), "stopped");
}

std::vector<HostPlan> choose_hosts(const Site& site, const std::vector<std::string>& names) {
  std::vector<HostPlan> chosen, all = host_plans(site);
  if (names.empty()) return all;
  for (const std::string& name : names) {
    const auto found = std::ranges::find_if(all, [&](const HostPlan& plan) {
      return plan.host == name || std::ranges::find(plan.tiles, name) != plan.tiles.end();
    });
    if (found == all.end())
      throw Error(
          {"the wall has no host or tile " + name, "", "it has " + fold_names(names_of(all))});
    const auto same = [&](const HostPlan& plan) { return plan.host == found->host; };
    if (std::ranges::none_of(chosen, same)) chosen.push_back(*found);
  }
  return chosen;
}

int conclude(const std::vector<HostReport>& reports, const std::string& done) {
  std::fputs(failures_of(reports).c_str(), stderr);
  const auto good = std::ranges::count_if(reports, [](const auto& each) { return !each.failure; });
  fmt::print("{} of {} hosts {}\n", good, reports.size(), done);
  return good == static_cast<std::ptrdiff_t>(reports.size()) ? 0 : 1;
}

}  // namespace vindu::app
