// vindu deploy, restart, logs: for a wall over hosts, what is done on each of them over ssh.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <list>
#include <memory>
#include <set>

#include "app/commands.h"
#include "app/common.h"
#include "app/launch.h"
#include "cluster/keys/key_folder.h"
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

/// A folder of links, laid out as the hosts are to have it; removed at the end.
class LinkFolder {
 public:
  void add(const fs::path& from, const fs::path& to) {
    if (!fs::exists(from)) throw Error({"is not there", from.string(), "name what is"});
    fs::create_directories((folder_ / to).parent_path());
    fs::permissions((folder_ / to).parent_path(), fs::perms::owner_all);
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
  /// Throws Error where the folder would come along somewhere below a link.
  void expect_without(const fs::path& secret) const {
    const ProgramResult found =
        run_program({"find", "-L", folder_.string(), "-samefile", secret.string()});
    if (found.out.empty()) return;
    throw Error({"would come along to every host, with the wall's private keys", secret.string(),
                 "put the model into a folder of its own"});
  }
  const std::string& folder() const { return temporary_.path(); }

 private:
  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

/// These hold their textures; of others the folder comes along.
bool is_whole(const fs::path& model) {
  const std::string kind = model.extension();
  return kind == ".glb" || kind == ".ply" || kind == ".stl";
}

void add_model(LinkFolder& stage, const fs::path& model, const fs::path& to, const fs::path& keys) {
  if (is_whole(model)) return stage.add(model, to);
  log_info("deploy", "the folder of " + model.string() + " comes along: its textures may be there");
  std::error_code no_such_keys;
  for (const auto& entry : fs::directory_iterator(fs::absolute(model).parent_path()))
    if (!fs::equivalent(entry.path(), keys, no_such_keys))
      stage.add(entry.path(), to.parent_path() / entry.path().filename());
}

void fill(LinkFolder& stage, const HostsCommand& command, const Site& site) {
  const fs::path wall = command.wall_file, folder = fs::absolute(wall).parent_path();
  stage.add("/proc/self/exe", "bin/vindu");
  for (const std::string part : {"assets", "shaders"})
    stage.add(fs::path(find_asset("walls")).parent_path().parent_path() / part,
              "share/vindu/" + part);
  stage.add(wall, "wall.toml");
  if (fs::exists(folder / "calibration")) stage.add(folder / "calibration", "calibration");
  if (!command.model.empty())
    add_model(stage, command.model, "scene" / fs::path(command.model).filename(),
              site.cluster.keys);
  if (site.scene.model.empty()) return;
  const fs::path model = fs::absolute(site.scene.model), to = model.lexically_relative(folder);
  if (to.empty() || *to.begin() == "..")
    log_warning("deploy", model.string() + " lies outside of the wall file's folder: " +
                              "put it at this path on every host");
  else if (!fs::exists(fs::path(stage.folder()) / to))
    add_model(stage, model, to, site.cluster.keys);
}

/// Where the wall file has its keys, from its own folder on; the same on a host. Throws Error where
/// that is no folder below it.
fs::path key_folder_on_hosts(const HostsCommand& command, const Site& site) {
  const fs::path wall = fs::absolute(command.wall_file).parent_path().lexically_normal();
  fs::path keys = fs::absolute(site.cluster.keys).lexically_normal().lexically_relative(wall);
  if (keys.empty() || keys == "." || *keys.begin() == "..")
    throw Error({"is no folder below the wall file's", site.cluster.keys,
                 "put the keys beside the wall file: [cluster] keys = \"keys\""});
  return keys;
}

/// What this host takes part as.
std::vector<KeyOwner> owners_at(const HostPlan& plan) {
  std::vector<KeyOwner> owners;
  if (plan.master) owners.push_back({Role::master});
  if (!plan.tiles.empty()) owners.push_back({Role::tile, plan.host});
  return owners;
}

/// A host's own keys, checked, in a folder of links of its own. One whose key does not count any
/// more is left behind with what is public, so that the others hear of it.
void fill_keys(LinkFolder& stage, const HostPlan& plan, const Site& site, const fs::path& to) {
  std::set<std::string> files;
  for (const KeyOwner& owner : owners_at(plan)) {
    const KeyState state = inspect_key(site.cluster.keys, owner).state;
    const bool ended = state == KeyState::revoked || state == KeyState::expired;
    if (ended)
      log_warning("deploy", fmt::format("the key {} is {}: {} does not get it", name_of(owner),
                                        name_of(state), plan.host));
    else
      read_credentials(site.cluster.keys, owner);
    for (const std::string& file : files_of(owner))
      if (!ended || file.find('/') == std::string::npos) files.insert(file);
  }
  for (const std::string& file : files) stage.add(fs::path(site.cluster.keys) / file, to / file);
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
    *std::ranges::find(reports, next.host, &HostReport::host) = std::move(next);
  return reports;
}

/// The command lines, and what is one host's alone.
int print_copies(const std::vector<HostFiles>& hosts, const LinkFolder& common) {
  for (const HostFiles& files : hosts) {
    fmt::print("{}\n", shell_words(rsync_words(files)));
    for (const std::string& folder : files.folders) {
      if (folder == common.folder()) continue;
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory())
          fmt::print("# {}: {}\n", files.host, entry.path().lexically_relative(folder).string());
    }
  }
  return 0;
}

int deploy(const HostsCommand& command) {
  const Site site = load_site_with_hosts(command.wall_file);
  const auto plans = choose_hosts(site, command.hosts);
  LinkFolder stage;
  fill(stage, command, site);
  std::list<LinkFolder> own;
  std::vector<HostFiles> files;
  for (const HostPlan& plan : plans) files.push_back({plan.host, {stage.folder()}});
  if (!site.cluster.keys.empty()) {
    const fs::path to = key_folder_on_hosts(command, site);
    stage.expect_without(site.cluster.keys);
    for (std::size_t i = 0; i < plans.size(); ++i) {
      fill_keys(own.emplace_back(), plans[i], site, to);
      files[i].folders.push_back(own.back().folder());
    }
  }
  stage.seal();
  const std::string check = check_script(sha256_of(stage.folder() + "/MANIFEST"));
  if (command.dry_run) return print_copies(files, stage);
  return conclude(followed(copy_to_hosts(files), check), "have it");
}

int restart(const HostsCommand& command) {
  const auto hosts = choose_hosts(load_site_with_hosts(command.wall_file), command.hosts);
  return conclude(on_hosts(names_of(hosts), restart_script()), "restarted");
}

int logs(const HostsCommand& command) {
  const auto hosts = choose_hosts(load_site_with_hosts(command.wall_file), command.hosts);
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
