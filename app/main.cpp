// vindu: one program for master, tiles, tracker, simulator and tools. Reads the command line and
// runs one sub-command; the only place where errors become exit codes: 0 done, 1 failed, 2 called
// wrong.
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/commands.h"
#include "core/error.h"
#include "core/log.h"

namespace {

/// Without a sub-command vindu shows its main job on this machine alone.
constexpr const char* kDefaultCommand = "simulate";

/// OpenGL on a CPU allocates the lists of every frame anew. glibc would give them back to the
/// kernel each time; to fetch them again is a quarter of a frame (docs/benchmarks.md).
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
}

void add_commands(CLI::App& app, vindu::app::Action& chosen) {
  vindu::app::add_simulate(app, chosen);
  vindu::app::add_master(app, chosen);
  vindu::app::add_tile(app, chosen);
  vindu::app::add_view(app, chosen);
  vindu::app::add_render(app, chosen);
  vindu::app::add_check(app, chosen);
  vindu::app::add_doctor(app, chosen);
  vindu::app::add_wiimote(app, chosen);
  vindu::app::add_record(app, chosen);
  vindu::app::add_calibrate(app, chosen);
  vindu::app::add_replay(app, chosen);
  vindu::app::add_track(app, chosen);
  vindu::app::add_plan(app, chosen);
  vindu::app::add_pack(app, chosen);
  vindu::app::add_measure(app, chosen);
  vindu::app::add_launch(app, chosen);
  vindu::app::add_status(app, chosen);
  vindu::app::add_show(app, chosen);
  vindu::app::add_mode(app, chosen);
  vindu::app::add_clip_command(app, chosen);
  vindu::app::add_goto(app, chosen);
  vindu::app::add_events(app, chosen);
  vindu::app::add_touch(app, chosen);
  vindu::app::add_pattern(app, chosen);
  vindu::app::add_blank(app, chosen);
  vindu::app::add_overlay(app, chosen);
  vindu::app::add_capture(app, chosen);
  vindu::app::add_stop(app, chosen);
  vindu::app::add_restart(app, chosen);
  vindu::app::add_logs(app, chosen);
  vindu::app::add_deploy(app, chosen);
  vindu::app::add_keys(app, chosen);
}

/// What to say where the first word is no command; else empty.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return "";
  const std::string near = vindu::nearest_name(word, names);
  return "there is no command " + word + "; " +
         (near.empty() ? "vindu --help lists them" : "did you mean " + near + "?");
}

int run(int argc, char** argv) {
  CLI::App app(
      "Vindu turns a tiled display wall into a window: it shows a 3D model in the perspective of "
      "the\n"
      "person before it, whose head it tracks with infrared cameras.",
      "vindu");
  app.footer(
      "\nWithout a sub-command: vindu simulate, the whole wall on this machine alone.\n"
      "vindu COMMAND --help explains a command and gives examples.");
  app.set_version_flag("--version", VINDU_VERSION);
  bool quiet = false, verbose = false;
  app.add_flag("--quiet", quiet, "Say only what went wrong");
  app.add_flag("--verbose", verbose, "Say more");
  app.require_subcommand(0, 1);
  app.fallthrough();
  vindu::app::Action chosen;
  add_commands(app, chosen);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      std::vector<std::string> words(argv + 1, argv + argc);
      words.emplace_back(kDefaultCommand);
      std::ranges::reverse(words);  // as CLI11 wants a vector
      app.parse(words);
    }
  } catch (const CLI::ParseError& error) {
    if (const std::string word = unknown_command(app, argc, argv); !word.empty()) {
      std::fprintf(stderr, "vindu: %s\n", word.c_str());
      return 2;
    }
    return app.exit(error) == 0 ? 0 : 2;
  }
  vindu::set_log_level(quiet     ? vindu::LogLevel::quiet
                       : verbose ? vindu::LogLevel::verbose
                                 : vindu::LogLevel::normal);
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  try {
    return run(argc, argv);
  } catch (const vindu::Error& error) {
    std::fprintf(stderr, "vindu: %s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vindu: unexpected: %s\n", error.what());
  }
  return 1;
}
