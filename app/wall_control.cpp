// vindu show, clip, mode, goto, pattern, blank, overlay, stop: asked of the master of a running
// wall, which says whether it did.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/launch.h"
#include "app/wall_console.h"
#include "cluster/console.h"
#include "cluster/dds.h"
#include "cluster/launch/local_wall.h"
#include "core/error.h"

namespace vindu::app {
namespace {

struct ControlCommand {
  std::string wall_file;
  std::string argument;
  std::string clip;
  std::string engine = "systemd";
  double timeout_s = 5;
};

int ask(const ControlCommand& command, Verb verb, const std::string& argument) {
  const Site site = load_site(command.wall_file);
  DdsTransport transport(network_of(site, Role::console));
  const AnswerMessage answer =
      ask_wall(transport, this_console(site), {verb, argument, command.clip},
               from_seconds(command.timeout_s));
  expect_done(answer);
  if (!answer.text.empty()) fmt::print("{}\n", answer.text);
  return 0;
}

CLI::Option* add_common(CLI::App& app, ControlCommand& command) {
  app.add_option("--wall", command.wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  return app.add_option("--timeout", command.timeout_s, "Seconds to wait for the answer")
      ->check(between(0.1, 3600.0))
      ->capture_default_str();
}

}  // namespace

void add_show(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  command->timeout_s = 120;  // the master reads it first, then the tiles
  CLI::App* app = parent.add_subcommand("show", "Shows another model on a running wall");
  app->add_option("MODEL", command->argument,
                  "Any model that Assimp reads, at this path on all hosts")
      ->required()
      ->check(not_empty());
  add_clip(*app, command->clip);
  add_common(*app, *command);
  app->footer(
      "\nExamples:\n"
      "  vindu show model.glb\n"
      "  vindu show beast.x --clip Walk --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] {
      return ask(*command, Verb::show, std::filesystem::absolute(command->argument));
    };
  });
}

void add_clip_command(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand(
      "clip", "Plays another animation of the model on a running wall, from its beginning");
  app->add_option("CLIP", command->argument,
                  "Its name or number, as vindu pack lists them, or rest: none")
      ->required()
      ->check(not_empty());
  add_common(*app, *command);
  app->footer("\nExamples:\n  vindu clip Walk\n  vindu clip 2 --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] { return ask(*command, Verb::clip, command->argument); };
  });
}

void add_mode(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand("mode", "How the eye moves on a running wall");
  app->add_option("MODE", command->argument,
                  "track: the eye is tracked; touch: it follows a hand (vindu touch);\n"
                  "loop: it follows a path")
      ->required()
      ->check(CLI::IsMember({"track", "touch", "loop"}));
  add_common(*app, *command);
  app->footer("\nExamples:\n  vindu mode loop\n  vindu mode track --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] { return ask(*command, Verb::mode, command->argument); };
  });
}

void add_goto(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  auto point = std::make_shared<std::optional<Vec3>>();
  CLI::App* app =
      parent.add_subcommand("goto", "Moves the scene of a running wall: a point to its middle");
  add_vec3(*app, "POINT", *point, "Of the scene, in its own units")->required();
  add_common(*app, *command);
  app->footer("\nExamples:\n  vindu goto 0,1.5,-2\n  vindu goto -- -1,0,0\n");
  app->callback([command, point, &chosen] {
    chosen = [command, point] {
      const Vec3& p = **point;
      return ask(*command, Verb::go_to, fmt::format("{},{},{}", p.x(), p.y(), p.z()));
    };
  });
}

void add_pattern(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand("pattern", "A test picture on a running wall");
  app->add_option("PATTERN", command->argument, "Which one; see below")
      ->required()
      ->check(CLI::IsMember(pattern_names()));
  add_common(*app, *command);
  app->footer(
      "\n"
      "  none     the model again\n"
      "  grid     metres of the wall over all tiles, circles, the outermost pixels of each tile\n"
      "  names    each tile's name, host, pixels and mount; which way is up, which corner is "
      "lower left\n"
      "  seams    lines over all seams: where a tile is off by a pixel, they break\n"
      "  ramps    levels of grey, red, green and blue, near black and near white\n"
      "  counter  the model, and over it each frame's number, as vindu tile --shown reads it\n"
      "  bar      bars that cross the whole wall in 4 s, and the number: tearing, late tiles\n"
      "  eye      the wall, each tile's frustum and the eye, from above and from the side\n"
      "\nAlso: vindu render --pattern grid, and --pattern of master, launch, view, simulate.\n"
      "\nExamples:\n"
      "  vindu pattern grid\n"
      "  vindu pattern none --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] { return ask(*command, Verb::pattern, command->argument); };
  });
}

void add_blank(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand(
      "blank", "A running wall goes dark, all tiles in one frame; what it showed goes on behind");
  app->add_option("SWITCH", command->argument, "on or off")
      ->required()
      ->check(CLI::IsMember({"on", "off"}));
  add_common(*app, *command);
  app->footer("\nExamples:\n  vindu blank on\n  vindu blank off --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] { return ask(*command, Verb::blank, command->argument); };
  });
}

void add_overlay(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand(
      "overlay", "Figures over a running wall: each tile's in its corner, the wall's on one");
  app->add_option("SWITCH", command->argument, "on or off")
      ->required()
      ->check(CLI::IsMember({"on", "off"}));
  add_common(*app, *command);
  app->footer("\nExamples:\n  vindu overlay on\n  vindu overlay off --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] { return ask(*command, Verb::overlay, command->argument); };
  });
}

void add_stop(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<ControlCommand>();
  CLI::App* app = parent.add_subcommand("stop", "Ends a running wall");
  add_common(*app, *command)
      ->description("Seconds to wait for the answer; then ten more until it has ended");
  add_engine(*app, command->engine);
  app->footer("\nExamples:\n  vindu stop\n  vindu stop --wall wall.toml\n");
  app->callback([command, &chosen] {
    chosen = [command] {
      const Site site = load_site(command->wall_file);
      if (has_hosts(site)) return stop_on_hosts(site, command->engine);
      DdsTransport transport(network_of(site, Role::console));
      stop_wall(transport, this_console(site), from_seconds(command->timeout_s));
      if (!wait_until_ended(site.cluster, std::chrono::seconds(10)))
        throw Error({"has not ended within ten seconds", site.cluster.name,
                     "end its launcher: pkill -f 'vindu launch'"});
      return 0;
    };
  });
}

}  // namespace vindu::app
