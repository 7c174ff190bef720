// vindu doctor: looks at a machine, and at a wall from it, and says what stands in the way of a
// picture, and what to do about it.
#include "app/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/commands.h"
#include "app/common.h"
#include "app/launch.h"
#include "cluster/launch/node_set.h"
#include "core/error.h"

namespace vindu::app {
namespace {

struct DoctorCommand {
  std::string wall_file;
  bool json = false;
  bool hosts = false;
};

void print(const Finding& finding, bool json) {
  if (json)
    fmt::print(R"({{"part": {}, "health": {}, "what": {}, "remedy": {}}})"
               "\n",
               json_text(finding.part), json_text(std::string(name_of(finding.health))),
               json_text(finding.what), json_text(finding.remedy));
  else
    fmt::print("{:<6}{:<10}{}{}{}\n", name_of(finding.health), finding.part, finding.what,
               finding.remedy.empty() ? "" : "; ", finding.remedy);
  std::fflush(stdout);  // the next part may take a while
}

/// Prints each part as soon as it is known.
class Report {
 public:
  explicit Report(bool json) : json_(json) {}

  void add(const Findings& findings) {
    for (const Finding& finding : findings) {
      print(finding, json_);
      if (finding.health == Health::bad) ++bad_;
    }
  }
  int bad() const { return bad_; }

 private:
  bool json_;
  int bad_ = 0;
};

void examine_wall(const DoctorCommand& command, Report& report) {
  try {
    const Site site = load_site(command.wall_file);
    if (!command.wall_file.empty()) {
      report.add(examine_role(site));
      report.add(examine_cameras_of(site));
    }
    report.add(examine_network(site));
    report.add(examine_programs(site));
  } catch (const Error& error) {
    report.add({{"wall", Health::bad, error.what()}});
  }
}

int doctor(const DoctorCommand& command) {
  Report report(command.json);
  report.add(examine_files());
  report.add(examine_graphics());
  report.add(examine_cameras());
  examine_wall(command, report);
  if (!command.json)
    fmt::print("{}\n", report.bad() == 0
                           ? "Nothing stands in the way."
                           : fmt::format("To be seen to: {}, marked BAD.", report.bad()));
  return report.bad() == 0 ? 0 : 1;
}

/// What is not good, by those who said so; equal lines once, in the order in which they came.
std::string folded(const std::vector<HostReport>& reports) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  for (const HostReport& report : reports)
    for (const std::string& line : report.lines) {
      if (!line.starts_with(name_of(Health::bad)) && !line.starts_with(name_of(Health::note)))
        continue;
      auto found = std::ranges::find(said, line, [](const auto& each) { return each.first; });
      if (found == said.end()) found = said.insert(said.end(), {line, {}});
      found->second.push_back(report.host);
    }
  // What must be seen to, first.
  std::ranges::stable_sort(
      said, {}, [](const auto& each) { return !each.first.starts_with(name_of(Health::bad)); });
  std::string text;
  for (const auto& [line, hosts] : said) text += fmt::format("{}: {}\n", fold_names(hosts), line);
  return text;
}

bool has_bad(const HostReport& report) {
  return std::ranges::any_of(
      report.lines, [](const std::string& line) { return line.starts_with(name_of(Health::bad)); });
}

/// Each host is asked by its own program.
int doctor_on_hosts(const std::string& wall_file) {
  const Site site = load_site_with_hosts(wall_file);
  const auto plans = host_plans(site);
  const HostRequest request{
      .program_sha256 = sha256_of(std::filesystem::read_symlink("/proc/self/exe")),
      .wall_sha256 = sha256_of(wall_file)};
  const auto reports = on_hosts(names_of(plans), doctor_script(plans, request));
  std::fputs(failures_of(reports).c_str(), stderr);
  fmt::print("{}", folded(reports));
  const auto well = std::ranges::count_if(
      reports, [](const HostReport& each) { return !each.failure && !has_bad(each); });
  fmt::print("Nothing stands in the way on {} of {} hosts.\n", well, reports.size());
  return well == static_cast<std::ptrdiff_t>(reports.size()) ? 0 : 1;
}

}  // namespace

void add_doctor(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<DoctorCommand>();
  CLI::App* app = parent.add_subcommand(
      "doctor", "What this machine has and lacks, for Vindu and for a wall; with remedies");
  app->add_option("--wall", command->wall_file,
                  "Also this machine's part in a wall: tiles, cameras, network, keys, hosts")
      ->type_name("FILE");
  app->add_flag("--json", command->json, "A line of JSON for each finding");
  app->add_flag("--hosts", command->hosts,
                "Of a wall over hosts: ask all of them, after vindu deploy; equal findings once")
      ->needs("--wall")
      ->excludes("--json");
  app->footer(
      "\ngood: works. note: is not here or not at its best; only what needs it will miss it.\n"
      "BAD: to be seen to before this machine does its part. With a display, a small window opens\n"
      "for a moment.\n"
      "\nExit code: 0 when nothing is BAD, else 1.\n"
      "\nExamples:\n"
      "  vindu doctor\n"
      "  vindu doctor --wall wall.toml\n"
      "  vindu doctor --wall wall.toml --hosts\n");
  app->callback([command, &chosen] {
    chosen = [command] {
      return command->hosts ? doctor_on_hosts(command->wall_file) : doctor(*command);
    };
  });
}

}  // namespace vindu::app
