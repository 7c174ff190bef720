// vindu keys: makes, lists and revokes the certificates and signed permissions of a wall. deploy
// brings each host its own.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "cluster/keys/authority.h"
#include "cluster/launch/host_plan.h"
#include "core/error.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

struct KeysCommand {
  std::string wall_file;
  std::string folder;
  std::vector<std::string> owners;
  std::vector<std::string> revoked;
  int days = 730;
  bool renew = false;
  bool list = false;
};

/// Everybody who takes part in the wall.
std::vector<KeyOwner> owners_of(const Site& site) {
  std::vector<KeyOwner> owners{{Role::master}, {Role::tracker}, {Role::console}};
  for (const HostPlan& plan : host_plans(site))
    if (!plan.tiles.empty()) owners.push_back({Role::tile, plan.host});
  return owners;
}

/// By "master", "hosts/tile-3-0" or, shorter, a host's name. Throws Error for a name that the wall
/// does not have.
std::vector<KeyOwner> named(const std::vector<KeyOwner>& all,
                            const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<KeyOwner> chosen;
  for (const std::string& name : names) {
    const auto fits = [&name](const KeyOwner& owner) {
      return name_of(owner) == name || (!owner.host.empty() && owner.host == name);
    };
    const auto found = std::ranges::find_if(all, fits);
    if (found == all.end())
      throw Error({"the wall has no " + name, "--key",
                   "name a host of a tile, or master, tracker, "
                   "console; vindu keys --list has them all"});
    chosen.push_back(*found);
  }
  return chosen;
}

std::string folder_for(const KeysCommand& command, const Site& site) {
  if (!command.folder.empty()) return command.folder;
  if (!site.cluster.keys.empty()) return site.cluster.keys;
  return (fs::absolute(command.wall_file).parent_path() / "keys").string();
}

std::string day_of(system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(system_clock::to_time_t(time)));
}

void print_key(const KeyInfo& key, const std::string& done) {
  const bool dated = key.until != system_clock::time_point();
  fmt::print("  {:<24}{:<12}{}{}\n", name_of(key.owner), dated ? day_of(key.until) : "-", done,
             key.state == KeyState::unusable ? ": " + key.why : "");
}

/// What is left to do, in the order of doing.
void print_next(const KeysCommand& command, const Site& site, const std::string& folder) {
  const fs::path wall = fs::absolute(command.wall_file).parent_path();
  if (site.cluster.keys.empty())
    fmt::print("next: in {}, under [cluster]: keys = \"{}\"\n", command.wall_file,
               fs::absolute(folder)
                   .lexically_normal()
                   .lexically_relative(wall.lexically_normal())
                   .string());
  if (site.cluster.master.empty())
    fmt::print("next: start the wall again\n");
  else
    fmt::print("next: vindu deploy --wall {0}; vindu restart --wall {0}\n", command.wall_file);
}

int list(const std::string& folder, const std::vector<KeyOwner>& owners) {
  bool good = true;
  fmt::print("{}\n  {:<24}{}\n", folder, "KEY", "UNTIL");
  for (const KeyOwner& owner : owners) {
    const KeyInfo key = inspect_key(folder, owner);
    print_key(key, std::string(name_of(key.state)));
    good = good && key.state == KeyState::good;
  }
  return good ? 0 : 1;
}

void expect_folder(const std::string& folder) {
  if (!fs::exists(fs::path(folder) / "identity_ca.pem"))
    throw Error({"holds no keys", folder, "make them: vindu keys --wall FILE"});
}

int revoke(const std::string& folder, const std::vector<KeyOwner>& owners) {
  expect_folder(folder);
  Authority authority(folder);
  for (const KeyOwner& owner : owners)
    fmt::print("{}: {} certificates revoked\n", name_of(owner), authority.revoke(owner));
  return 0;
}

/// Those that are missing or, with --renew, all that were named. Nothing that works is overwritten
/// unasked.
void make(const KeysCommand& command, const std::string& folder,
          const std::vector<KeyOwner>& owners) {
  Authority authority(folder);
  const auto now = system_clock::now();
  const Validity validity{now - std::chrono::days(1), now + std::chrono::days(command.days)};
  fmt::print("{}{}\n  {:<24}{}\n", folder, authority.is_new() ? ": a new authority" : "", "KEY",
             "UNTIL");
  for (const KeyOwner& owner : owners) {
    const KeyState before = inspect_key(folder, owner).state;
    const bool makes = command.renew || before == KeyState::missing;
    if (makes) authority.issue(owner, validity);
    const KeyInfo key = inspect_key(folder, owner);
    print_key(key, !makes                        ? "kept, " + std::string(name_of(key.state))
                   : before == KeyState::missing ? "made"
                                                 : "made again");
  }
}

int keys(const KeysCommand& command) {
  const Site site = load_uncalibrated_site(command.wall_file);
  const std::vector<KeyOwner> all = owners_of(site);
  const std::string folder = folder_for(command, site);
  if (command.list) {
    expect_folder(folder);
    return list(folder, named(all, command.owners));
  }
  if (!command.revoked.empty())
    revoke(folder, named(all, command.revoked));
  else
    make(command, folder, named(all, command.owners));
  print_next(command, site, folder);
  return 0;
}

}  // namespace

void add_keys(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<KeysCommand>();
  CLI::App* app = parent.add_subcommand(
      "keys", "Makes the keys of a wall: then nobody without one reads or writes on its network");
  app->add_option("--wall", command->wall_file, "Wall file")->required()->type_name("FILE");
  app->add_option("--out", command->folder,
                  "Folder (default: the wall file's [cluster] keys, or keys beside it)")
      ->type_name("DIR");
  app->add_option("--key", command->owners,
                  "Only this one: a tile's host, master, tracker or console; more than once")
      ->type_name("NAME");
  app->add_option("--days", command->days, "How long they count")
      ->check(CLI::Range(1, 7000))
      ->capture_default_str();
  const auto renew =
      app->add_flag("--renew", command->renew, "Make those again that there are already");
  const auto listed = app->add_flag("--list", command->list, "Only say what there is");
  app->add_option("--revoke", command->revoked,
                  "All certificates that this one ever had count no more; more than once")
      ->type_name("NAME")
      ->excludes(renew)
      ->excludes(listed);
  app->footer(
      "\nThe folder's ca/ signs for the wall: it stays on this machine, and deploy never brings "
      "it.\n"
      "Exit code of --list: 0 when every key counts for another month.\n"
      "\nExamples:\n"
      "  vindu keys --wall wall.toml\n"
      "  vindu keys --wall wall.toml --list\n"
      "  vindu keys --wall wall.toml --revoke tile-3-0\n"
      "  vindu keys --wall wall.toml --renew --key tile-3-0 --days 365\n");
  app->callback([command, &chosen] { chosen = [command] { return keys(*command); }; });
}

}  // namespace vindu::app
