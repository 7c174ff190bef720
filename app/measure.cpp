// `vindu measure`: how good this machine's Vindu is, in figures, against named references.
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "app/accuracy_picture.h"
#include "app/accuracy_report.h"
#include "app/commands.h"
#include "app/common.h"

namespace vindu::app {
namespace {

struct MeasureOptions {
  AccuracyOptions accuracy;
  std::string out = "out";
  bool json = false;
};

int run_accuracy(MeasureOptions options) {
  constexpr int kQuickPoses = 100;
  constexpr double kQuick_s = 4;
  AccuracyOptions& study = options.accuracy;
  if (study.quick) study.poses = kQuickPoses, study.length_s = kQuick_s;
  make_folder(options.out);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const Accuracy accuracy = measure_accuracy(study, [&](double share) {
    if (terminal)
      fmt::print(stderr, "\rmeasuring: {:3.0f} %{}", 100 * share, share >= 1 ? "\n" : "");
  });
  const std::string picture = options.out + "/accuracy.png";
  write_png(accuracy_picture(accuracy, study), picture);
  if (options.json) {
    fmt::print("{}", accuracy_json(accuracy, study, picture));
    return 0;
  }
  fmt::print("{}\n{}\n", accuracy_tables(accuracy, study), picture);
  return 0;
}

void add_accuracy(CLI::App& measure, Action& chosen) {
  auto options = std::make_shared<MeasureOptions>();
  AccuracyOptions& study = options->accuracy;
  CLI::App* app = measure.add_subcommand(
      "accuracy", "Error of the eye on emulated Wiimotes, beside the bound and the thesis' method");
  CLI::Option* poses = app->add_option("--poses", study.poses, "Of each row of single frames")
                           ->check(CLI::Range(10, 1000000))
                           ->capture_default_str();
  CLI::Option* length = app->add_option("--seconds", study.length_s,
                                        "Of each row that moves; its walker takes short ways at\n"
                                        "first, as slowly at any speed, hence 5 at the least")
                            ->check(between(5.0, 3600.0))
                            ->capture_default_str();
  app->add_option("--seed", study.seed, "Of poses, motions, noise and links")
      ->capture_default_str();
  app->add_flag("--quick", study.quick, "Few rows, in some seconds")->excludes(poses, length);
  app->add_option("--out", options->out, "Folder of the plot, accuracy.png")
      ->type_name("DIR")
      ->capture_default_str();
  app->add_flag("--json", options->json, "Figures as JSON");
  app->footer(
      "\nExamples:\n"
      "  vindu measure accuracy\n"
      "  vindu measure accuracy --poses 5000 --seconds 60 --out figures\n"
      "  vindu measure accuracy --quick --json\n");
  app->callback([options, &chosen] { chosen = [options] { return run_accuracy(*options); }; });
}

}  // namespace

void add_measure(CLI::App& parent, Action& chosen) {
  CLI::App* app = parent.add_subcommand("measure", "How good it is, in figures");
  app->require_subcommand(1);
  add_accuracy(*app, chosen);
  app->footer("\nExamples:\n  vindu measure accuracy\n  vindu measure accuracy --quick --json\n");
}

}  // namespace vindu::app
