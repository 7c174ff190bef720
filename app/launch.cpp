// vindu launch: one command lights a wall. Its processes run on this machine, children of this
// one, unless the wall file names the master's host.
#include "app/launch.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/tracker_events.h"
#include "cluster/launch/words.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/resources.h"

namespace vindu::app {
namespace {

struct LaunchCommand {
  std::string model;
  std::string wall_file;
  std::vector<std::string> master_options, tile_options;  // as they were given
  std::vector<std::string> targets;
  int tiles_per_process = 1;
  bool headless = false;
  bool json = false;
  HostOptions hosts;
};

bool has_display() {
  const char* const x = std::getenv("DISPLAY");
  const char* const wayland = std::getenv("WAYLAND_DISPLAY");
  return (x && *x) || (wayland && *wayland);
}

/// A name that no other launch has.
std::string new_session() {
  return fmt::format("{:x}", std::chrono::system_clock::now().time_since_epoch().count());
}

std::vector<std::string> master_arguments(const LaunchCommand& command) {
  std::vector<std::string> arguments = command.master_options;
  for (const std::string& target : command.targets)
    arguments.insert(arguments.end(), {"--target", target});
  if (command.json) arguments.emplace_back("--json");
  arguments.insert(arguments.end(), {"--session", new_session()});
  return arguments;
}

LaunchRequest request_of(const LaunchCommand& command) {
  LaunchRequest request{
      .program = std::filesystem::read_symlink("/proc/self/exe"),
      .wall_file = command.wall_file.empty() ? find_asset("walls/tromso.toml") : command.wall_file,
      .master_arguments = master_arguments(command),
      .tile_arguments = command.tile_options};
  if (!command.model.empty()) request.master_arguments.push_back(command.model);
  if (command.headless) request.tile_arguments.emplace_back("--headless");
  return request;
}

HostRequest host_request_of(const LaunchCommand& command) {
  if (command.tiles_per_process != 1)
    throw Error({"the tiles of a host share one process", "--tiles-per-process",
                 "leave it out where the wall file names the master's host"});
  return {.model = std::filesystem::path(command.model).filename(),
          .master_arguments = master_arguments(command),
          .tile_arguments = command.tile_options,
          .headless = command.headless};
}

/// What would run on this machine, a line each.
int print_plans(const LaunchCommand& command, const Site& site) {
  for (const ProcessPlan& plan :
       local_wall(request_of(command), site.wall, command.tiles_per_process))
    fmt::print("{}\n", shell_words(plan.words));
  return 0;
}

int launch(LaunchCommand command) {
  const Site site = load_site(command.wall_file);
  if (has_hosts(site))
    return launch_on_hosts(host_request_of(command), site, command.wall_file, command.hosts);
  if (command.hosts.engine != kEngineOfHosts)
    throw Error({"the wall is on this machine alone: its wall file names no master in [cluster]",
                 "--engine", "leave it out, or name the master's host there"});
  if (!command.headless && !has_display()) {
    log_info("launch", "there is no display here: the tiles draw without one (--headless)");
    command.headless = true;
  }
  if (command.hosts.dry_run) return print_plans(command, site);
  return launch_here(request_of(command), site, command.tiles_per_process);
}

/// An option that is handed on as it was given.
CLI::Option* hand_on(CLI::App& app, const std::string& name, std::vector<std::string>& words,
                     const std::string& help) {
  return app.add_option_function<std::string>(
      name,
      [name, &words](const std::string& value) {
        words.insert(words.end(), {name, value});
      },
      help);
}

void add_handed_on(CLI::App& app, LaunchCommand& command) {
  hand_on(app, "--place", command.master_options, "Of the model; as of vindu master")
      ->check(CLI::IsMember({"fit", "life-size", "as-is"}));
  hand_on(app, "--clip", command.master_options, "Of the model; as of vindu master")
      ->type_name("NAME|N");
  hand_on(app, "--mode", command.master_options,
          "track: the eye is tracked; loop: it follows a path; touch: it follows a hand")
      ->check(CLI::IsMember({"track", "loop", "touch"}));
  hand_on(app, "--pattern", command.master_options, "A test picture; see vindu pattern --help")
      ->check(CLI::IsMember(pattern_names()));
  add_targets(app, command.targets);
  hand_on(app, "--path", command.master_options, "Camera path of the mode loop")->type_name("FILE");
  hand_on(app, "--seconds", command.master_options, "Length (default: until Ctrl-C)")
      ->check(between(0.05, 1e8));
  hand_on(app, "--seed", command.master_options,
          "Of the emulated cameras and the person before them")
      ->check(between(0, 1e18));
  app.add_option_function<std::string>(
         "--shown",
         [&command](const std::string& folder) {
           command.tile_options.insert(command.tile_options.end(), {"--shown", folder + "/"});
         },
         "Each tile writes into this folder which frames it showed; as of vindu tile")
      ->type_name("DIR");
  hand_on(app, "--scale", command.tile_options, "Of the tiles' pictures, 1: their own pixels")
      ->check(between(0.01, 1.0));
  hand_on(app, "--device", command.tile_options, "Which EGL device draws without a display")
      ->check(between(0, 1000));
}

}  // namespace

void add_launch(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<LaunchCommand>();
  CLI::App* app = parent.add_subcommand("launch", "Lights a wall: the master and all tiles");
  app->add_option("MODEL", command->model,
                  "Any model that Assimp reads (default: the wall file's, or the show)")
      ->check(not_empty());
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_option("--tiles-per-process", command->tiles_per_process,
                  "How many tiles share a process of this machine (default: 1)")
      ->check(CLI::Range(1, 1024));
  app->add_flag("--headless", command->headless, "Tiles draw without a display");
  app->add_flag("--json", command->json, "The master's figures as JSON");
  app->add_flag("--dry-run", command->hosts.dry_run, "Only say what would be done");
  add_engine(*app, command->hosts.engine);
  add_handed_on(*app, *command);
  app->footer(
      "\nThe processes are children of this one, unless the wall file's [cluster] names the\n"
      "master: then they are started on its hosts, which keep them running, and this one ends.\n"
      "\nExamples:\n"
      "  vindu launch --headless --scale 0.1 --seconds 10\n"
      "  vindu launch model.glb --wall wall.toml\n");
  app->callback([command, &chosen] { chosen = [command] { return launch(*command); }; });
}

}  // namespace vindu::app
