// The frame lock on loopback: tile processes that play their drawing by a sleep, held together by
// Vindu's own master and tiles, and in turn by a barrier of raw UDP datagrams, which is the floor.
// Prints the skew of the swaps, what the barrier costs, start-up and CPU time, with their ratios.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "bench/command.h"
#include "bench/frame_lock/launch.h"
#include "bench/frame_lock/plot.h"
#include "bench/frame_lock/run.h"
#include "bench/quantile.h"
#include "core/error.h"

namespace vindu {
namespace {

struct Options {
  std::vector<int> tiles = {28};
  std::vector<double> draw_ms = {8, 12};
  int rounds = 2;  // of each lock in turn, so that the machine's moods meet both
  RunLength length;
  std::uint64_t seed = 1;
  std::string plot;
  bool launch = true;
};

LockPlan plan_of(const Options& options, int tiles) {
  static int runs = 0;
  LockPlan plan{.parent = getpid(),
                .tiles = tiles,
                .least_draw_ms = options.draw_ms.front(),
                .most_draw_ms = options.draw_ms.back(),
                .seed = options.seed};
  fmt::format_to_n(plan.wall, sizeof plan.wall - 1, "lock-bench-{}-{}", getpid(), runs);
  plan.port = static_cast<std::uint16_t>(20000 + (getpid() + runs++) % 10000);
  return plan;
}

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {quantile(values, 0.5), quantile(values, 0.99), quantile(values, 1)};
}

LockSpreads spreads_of(const LockFigures& figures) {
  return {spread_of(figures.skew_us), spread_of(figures.cost_us)};
}

void print_result(int tiles, const char* name, const LockResult& result) {
  const auto [skew, cost] = spreads_of(result.figures);
  fmt::print("{:>5} {:<6}{:>8.0f}{:>8.0f}{:>8.0f} {:>8.0f}{:>8.0f}{:>8.0f}{:>9.0f}{:>9.1f}{:>9.1f}",
             tiles, name, skew.p50, skew.p99, skew.max, cost.p50, cost.p99, cost.max,
             quantile(result.start_ms, 0.5), 100 * quantile(result.master_cores, 0.5),
             100 * quantile(result.tiles_cores, 0.5));
  fmt::print("{:>7}/{}{:>9}\n", result.figures.skew_us.size(), result.figures.frames,
             result.evictions);
}

void print_ratio(const LockResult& bus, const LockResult& udp) {
  const auto of = [](double ours, double floor) {
    return floor > 0 ? fmt::format("{:.1f}", ours / floor) : std::string("-");
  };
  const auto [skew, cost] = spreads_of(bus.figures);
  const auto [udp_skew, udp_cost] = spreads_of(udp.figures);
  const auto middle = [&](const std::vector<double>& ours, const std::vector<double>& floor) {
    return of(quantile(ours, 0.5), quantile(floor, 0.5));
  };
  fmt::print("{:>5} {:<6}{:>8}{:>8}{:>8} {:>8}{:>8}{:>8}{:>9}{:>9}{:>9}\n", "", "ratio",
             of(skew.p50, udp_skew.p50), of(skew.p99, udp_skew.p99), of(skew.max, udp_skew.max),
             of(cost.p50, udp_cost.p50), of(cost.p99, udp_cost.p99), of(cost.max, udp_cost.max),
             middle(bus.start_ms, udp.start_ms), middle(bus.master_cores, udp.master_cores),
             middle(bus.tiles_cores, udp.tiles_cores));
}

std::string machine() {
  double load = 0;
  getloadavg(&load, 1);
  return fmt::format("{} cores, load {:.1f} before", std::thread::hardware_concurrency(), load);
}

void print_launch() {
  const auto took_s = launch_s(VINDU_PROGRAM);
  fmt::print("vindu launch --headless --scale 0.1, 28 tiles: the first whole frame {}\n",
             took_s ? fmt::format("after {:.1f} s", *took_s) : "did not come within a minute");
}

/// Whether every swap was right.
bool run(const Options& options) {
  const std::string words = fmt::format(
      "{}; a tile draws for {:g} to {:g} ms; 60 Hz, {} x {} frames of each", machine(),
      options.draw_ms.front(), options.draw_ms.back(), options.rounds, options.length.frames);
  fmt::print("{}\n{:12}{:^24} {:^24}{:>9}{:^18}\n", words, "", "skew of the swaps, us",
             "last ready to last, us", "start-up", "CPU, %");
  fmt::print("{:>5} {:<6}{:>8}{:>8}{:>8} {:>8}{:>8}{:>8}{:>9}{:>9}{:>9}{:>11}{:>9}\n", "tiles",
             "lock", "p50", "p99", "max", "p50", "p99", "max", "ms", "master", "tiles", "whole",
             "evicted");
  std::vector<PlotPoint> points;
  std::uint64_t wrong = 0;
  for (const int tiles : options.tiles) {
    LockResult bus, udp;
    for (int round = 0; round < options.rounds; ++round) {
      udp.add(run_lock(kUdpLock, plan_of(options, tiles), options.length));
      bus.add(run_lock(kBusLock, plan_of(options, tiles), options.length));
    }
    print_result(tiles, kUdpLock.name, udp);
    print_result(tiles, kBusLock.name, bus);
    print_ratio(bus, udp);
    std::fflush(stdout);
    points.push_back({tiles, spreads_of(bus.figures), spreads_of(udp.figures)});
    wrong += bus.wrong + udp.wrong;
  }
  if (!options.plot.empty()) write_png(lock_plot(points, words), options.plot);
  if (options.launch) print_launch();
  if (wrong > 0) fmt::print("WRONG: {} swaps out of order or before all tiles were ready\n", wrong);
  return wrong == 0;
}

int main_of(int argc, char** argv) {
  Options options;
  std::string kind;
  int tile = 0, sheet_file = -1;
  CLI::App app(
      "Skew of the swaps, cost of the barrier and start-up of a wall on loopback, beside a "
      "raw UDP barrier. Exit code 1: a tile swapped to what it should not have.");
  app.add_option("--tiles", options.tiles, "Numbers of tiles, 1 to 64 (default: 28)")
      ->delimiter(',')
      ->check(CLI::Range(1, kMostTiles));
  app.add_option("--draw-ms", options.draw_ms, "Shortest and longest drawing (default: 8,12)")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(CLI::Range(0.0, 1000.0));
  app.add_option("--rounds", options.rounds, "Runs of each lock in turn (default: 2)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--frames", options.length.frames, "That count in each run (default: 120)")
      ->check(CLI::Range(1, 10000));
  app.add_option("--seed", options.seed, "Of the drawings' lengths");
  app.add_option("--plot", options.plot, "Writes the figures as a picture")->type_name("PNG");
  app.add_flag("!--no-launch", options.launch, "Leaves out vindu launch");
  CLI::App* const as_tile = app.add_subcommand("tile")->group("");
  as_tile->add_option("kind", kind);
  as_tile->add_option("tile", tile);
  as_tile->add_option("sheet", sheet_file);
  return run_command(app, argc, argv, [&] {
    if (as_tile->parsed()) {
      play_tile(kind, tile, sheet_file);
      return 1;
    }
    std::ranges::sort(options.tiles);
    std::ranges::sort(options.draw_ms);
    return run(options) ? 0 : 1;
  });
}

}  // namespace
}  // namespace vindu

int main(int argc, char** argv) { return vindu::main_of(argc, argv); }
