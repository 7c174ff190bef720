// vindu deploy, restart, logs: for a wall over hosts, what is done on each of them over ssh.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/launch.h"
#include "cluster/launch/words.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/resources.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

struct HostsCommand {
  std::string wall_file;
  std::string model;
  std::vector<std::string> hosts;
  int lines = 50;
  bool dry_run = false;
};

Site site_with_hosts(const HostsCommand& command) {
  Site site = load_site(command.wall_file);
  if (!has_hosts(site))
    throw Error({"names no master in its [cluster]: the wall is on this machine alone",
                 command.wall_file.empty() ? "the default wall file" : command.wall_file,
                 "name the master's host there"});
  return site;
}

/// A folder of links, laid out as the hosts are to have it; removed at the end.
class Stage {
 public:
  Stage() {
    std::string pattern = (fs::temp_directory_path() / "vindu_deploy_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw Error({"cannot be made", pattern, "free some space"});
    folder_ = pattern;
  }
  ~Stage() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  void add(const fs::path& from, const fs::path& to) {
    if (!fs::exists(from)) throw Error({"is not there", from.string(), "name what is"});
    fs::create_directories((folder_ / to).parent_path());
    fs::create_symlink(fs::canonical(from), folder_ / to);
  }
  /// MANIFEST: the SHA-256 of every file.
  void seal() {
    const ProgramResult sums =
        run_program({"sh", "-c", R"(cd "$1" && find -L . -type f -print0 | sort -z |
                        xargs -0 sha256sum -- > "$1.sums" && mv "$1.sums" MANIFEST)",
                     "sh", folder_.string()});
    if (sums.exit_code != 0)
      throw Error({sums.err.empty() ? "cannot be read" : sums.err.front(), folder_.string(), ""});
  }
  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_;
};

/// These hold their textures; of others the folder comes along.
bool is_whole(const fs::path& model) {
  const std::string kind = model.extension();
  return kind == ".glb" || kind == ".ply" || kind == ".stl";
}

void add_model(Stage& stage, const fs::path& model, const fs::path& to) {
  if (is_whole(model)) return stage.add(model, to);
  log_info("deploy", "the folder of " + model.string() + " comes along: its textures may be there");
  for (const auto& entry : fs::directory_iterator(fs::absolute(model).parent_path()))
    stage.add(entry.path(), to.parent_path() / entry.path().filename());
}

void fill(Stage& stage, const HostsCommand& command, const Site& site) {
  const fs::path wall = command.wall_file, folder = fs::absolute(wall).parent_path();
  stage.add("/proc/self/exe", "bin/vindu");
  for (const std::string part : {"assets", "shaders"})
    stage.add(fs::path(find_asset("walls")).parent_path().parent_path() / part,
              "share/vindu/" + part);
  stage.add(wall, "wall.toml");
  if (fs::exists(folder / "calibration")) stage.add(folder / "calibration", "calibration");
  if (!command.model.empty())
    add_model(stage, command.model, "scene" / fs::path(command.model).filename());
  if (site.scene.model.empty()) return;
  const fs::path model = fs::absolute(site.scene.model), to = model.lexically_relative(folder);
  if (to.empty() || *to.begin() == "..")
    log_warning("deploy", model.string() + " lies outside of the wall file's folder: " +
                              "put it at this path on every host");
  else if (!fs::exists(fs::path(stage.folder()) / to))
    add_model(stage, model, to);
}

/// After the copy: every file is what it is here.
std::string check_script(const std::string& manifest_sha256) {
  return "fail() { printf '@fail\\t%s\\t%s\\t%s\\n' \"$1\" \"$2\" \"$3\"; exit 1; }\n"
         "cd \"$HOME/.vindu\" || fail check 'there is no ~/.vindu' ''\n"
         "printf '%s  MANIFEST\\n' " +
         shell_word(manifest_sha256) +
         " | sha256sum --check --status || fail check 'its list of files is another one' "
         "'deploy again'\n"
         "sha256sum --check --quiet MANIFEST >&2 || fail check 'a file is not what it is here' "
         "'see its disk, deploy again'\n"
         "echo @done\n";
}

/// Those that are well so far, and what they are after this step.
std::vector<HostReport> followed(std::vector<HostReport> reports, const std::string& script) {
  std::vector<std::string> good;
  for (const HostReport& report : reports)
    if (!report.failure) good.push_back(report.host);
  for (HostReport& next : on_hosts(good, script))
    for (HostReport& report : reports)
      if (report.host == next.host) report = std::move(next);
  return reports;
}

int deploy(const HostsCommand& command) {
  const Site site = site_with_hosts(command);
  const auto hosts = names_of(choose_hosts(site, command.hosts));
  Stage stage;
  fill(stage, command, site);
  stage.seal();
  const std::string check = check_script(sha256_of(stage.folder() + "/MANIFEST"));
  if (command.dry_run) {
    for (const std::string& host : hosts)
      fmt::print("{}\n", shell_words(rsync_words(host, stage.folder())));
    return 0;
  }
  return conclude(followed(copy_to_hosts(hosts, stage.folder()), check), "have it");
}

int restart(const HostsCommand& command) {
  const auto hosts = choose_hosts(site_with_hosts(command), command.hosts);
  return conclude(on_hosts(names_of(hosts), restart_script()), "restarted");
}

int logs(const HostsCommand& command) {
  const auto hosts = choose_hosts(site_with_hosts(command), command.hosts);
  const auto reports = on_hosts(names_of(hosts), log_script(command.lines));
  for (const HostReport& report : reports)
    for (const std::string& line : report.lines) fmt::print("{}: {}\n", report.host, line);
  std::fputs(failures_of(reports).c_str(), stderr);
  return failures_of(reports).empty() ? 0 : 1;
}

CLI::App* add_common(CLI::App& parent, const std::string& name, const std::string& help,
                     HostsCommand& command) {
  CLI::App* app = parent.add_subcommand(name, help);
  app->add_option("--wall", command.wall_file, "Wall file that names the master's host")
      ->required()
      ->type_name("FILE");
  return app;
}

}  // namespace

void add_deploy(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<HostsCommand>();
  CLI::App* app = add_common(
      parent, "deploy", "Brings this vindu, the wall file and models to a wall's hosts", *command);
  app->add_option("MODEL", command->model, "A model for vindu launch or vindu show");
  app->add_option("--host", command->hosts, "A host or tile (default: all; more than once)");
  app->add_flag("--dry-run", command->dry_run, "Only say what would be done");
  app->footer(
      "\nIt lands in ~/.vindu of each host, and is compared by SHA-256 afterwards.\n"
      "\nExamples:\n"
      "  vindu deploy --wall wall.toml\n"
      "  vindu deploy model.glb --wall wall.toml --host tile-3-0\n");
  app->callback([command, &chosen] { chosen = [command] { return deploy(*command); }; });
}

void add_restart(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<HostsCommand>();
  CLI::App* app = add_common(parent, "restart", "Starts the processes of hosts again", *command);
  app->add_option("HOST", command->hosts, "Hosts or tiles (default: all)");
  app->footer(
      "\nExamples:\n"
      "  vindu restart --wall wall.toml\n"
      "  vindu restart tile-3-0 tile-3-1 --wall wall.toml\n");
  app->callback([command, &chosen] { chosen = [command] { return restart(*command); }; });
}

void add_logs(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<HostsCommand>();
  CLI::App* app = add_common(parent, "logs", "What the processes of hosts have said", *command);
  app->add_option("HOST", command->hosts, "Hosts or tiles (default: all)");
  app->add_option("--lines", command->lines, "Of each host (default: 50)")
      ->check(CLI::Range(1, 100000));
  app->footer(
      "\nExamples:\n"
      "  vindu logs --wall wall.toml --lines 5\n"
      "  vindu logs tile-3-0 --wall wall.toml\n");
  app->callback([command, &chosen] { chosen = [command] { return logs(*command); }; });
}

}  // namespace vindu::app
