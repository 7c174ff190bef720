// wall_faults: runs a wall of real processes, a network namespace each, does to it what happens to
// walls, and says how the rest fared. Which frame a tile showed is read from its pixels. Exit code
// 0: no tile ever showed a wrong frame, the wall was whole again after every fault, nothing is
// left.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "tests/faults/faults.h"
#include "tests/faults/faulty_wall.h"

namespace vindu::testing {

FaultDealer::FaultDealer(std::uint64_t seed, const std::string& only) : random_(seed) {
  for (int i = 0; i < kFaults; ++i)
    if (name_of(static_cast<Fault>(i)).find(only) != std::string_view::npos)
      kinds_.push_back(static_cast<Fault>(i));
}

Fault FaultDealer::next() {
  if (left_.empty()) {
    left_ = kinds_;
    std::ranges::shuffle(left_, random_);
  }
  ++dealt_;
  const Fault fault = left_.back();
  left_.pop_back();
  return fault;
}

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kPatience = seconds(120);  // until the wall is whole: slow is not dead

struct Incident {
  Fault fault{};
  std::size_t member = 0;  // 0: all of them, or the master
  Time begun{}, ended{};
  std::optional<Duration> whole_again{};  // after it ended
  std::size_t evictions = 0;
};

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

struct Options {
  FaultyWallOptions wall;
  std::string only;  // faults whose name has this in it
  double fault_s = 600;
  double quiet_s = 5;
};

class FaultRun {
 public:
  explicit FaultRun(const Options& options)
      : wall_(options.wall), dealer_(options.wall.seed, options.only) {}

  /// Until all tiles have shown one frame; empty when they do not.
  std::optional<Duration> start() { return whole_after(begun_); }

  void quiet(Duration length) {
    pass(milliseconds(500));  // what catches up does so
    const Time start = clock_.now();
    pass(length);
    quiet_.push_back({start, clock_.now()});
  }

  /// Each kind at least once.
  void faults(Duration length) {
    const Time end = clock_.now() + length;
    while (length > Duration::zero() && (clock_.now() < end || !dealer_.dealt_all())) {
      incidents_.push_back(suffer(dealer_.next()));
      quiet(seconds(2));
    }
  }

  /// Of the master and of the tile that holds most, a line.
  void say_holdings(const char* when) const;

  std::vector<std::string> stop() { return wall_.stop(); }
  std::size_t left_over() const { return wall_.left_over(); }

  std::vector<std::string> wrong() {
    std::vector<std::vector<Swap>> files;
    for (std::size_t tile = 1; tile <= wall_.tiles(); ++tile)
      std::ranges::move(wall_.swaps(tile), std::back_inserter(files));
    for (const auto& file : files) swaps_ += file.size();
    return wrong_swaps(files);
  }

  void report();
  bool recovered() const {
    return std::ranges::all_of(incidents_,
                               [](const Incident& i) { return i.whole_again.has_value(); });
  }

 private:
  void pass(Duration length) {
    for (const Time end = clock_.now() + length; clock_.now() < end;) {
      std::this_thread::sleep_for(milliseconds(20));
      wall_.supervise(clock_.now());
    }
  }

  std::optional<Duration> whole_after(Time since) {
    while (clock_.now() - since < kPatience) {
      pass(milliseconds(100));
      for (const WholeFrame& frame : wall_.whole_frames())
        if (frame.first > since) return frame.last - since;
    }
    return std::nullopt;
  }

  Incident suffer(Fault fault) {
    Incident incident{.fault = fault, .begun = clock_.now()};
    const std::size_t before = evictions();
    incident.member = begin(fault);
    pass(length_of(fault));
    end(fault, incident.member);
    incident.ended = clock_.now();
    incident.whole_again = whole_after(incident.ended);
    incident.evictions = evictions() - before;
    std::fprintf(
        stderr, "%s\n",
        fmt::format("{} {}: {}", name_of(fault), incident.member ? wall_.name(incident.member) : "",
                    incident.whole_again ? fmt::format("whole again after {:.2f} s",
                                                       vindu::seconds(*incident.whole_again))
                                         : "NOT WHOLE AGAIN")
            .c_str());
    return incident;
  }

  static Duration length_of(Fault fault) {
    switch (fault) {
      case Fault::hung:
      case Fault::cable_pulled:
        return seconds(2);
      case Fault::loss_1:
      case Fault::loss_5:
      case Fault::jitter:
        return seconds(5);
      case Fault::disk_full:
        return seconds(3);
      default:
        return Duration::zero();
    }
  }

  /// Returns whom it hits.
  std::size_t begin(Fault fault) {
    const std::size_t tile = 1 + dealer_.pick(wall_.tiles());
    switch (fault) {
      case Fault::killed:
        wall_.send(tile, SIGKILL);
        return tile;
      case Fault::hung:
        wall_.send(tile, SIGSTOP);
        return tile;
      case Fault::crashed:  // on the thread that draws, as in a driver
        wall_.send(tile, SIGSEGV);
        return tile;
      case Fault::cable_pulled:
        wall_.plug(tile, false);
        return tile;
      case Fault::disk_full:
        wall_.fill_disk(tile, true);
        return tile;
      case Fault::loss_1:
        wall_.set_network({.loss = 0.01});
        return 0;
      case Fault::loss_5:
        wall_.set_network({.loss = 0.05});
        return 0;
      case Fault::jitter:
        wall_.set_network({.jitter = milliseconds(20)});
        return 0;
      case Fault::master_killed:
        wall_.send(FaultyWall::kMaster, SIGKILL);
        return 0;
      case Fault::all_killed:
        for (std::size_t i = 1; i <= wall_.tiles(); ++i) wall_.send(i, SIGKILL);
        return 0;
    }
    return 0;
  }

  void end(Fault fault, std::size_t tile) {
    if (fault == Fault::hung) wall_.send(tile, SIGCONT);
    if (fault == Fault::cable_pulled) wall_.plug(tile, true);
    if (fault == Fault::disk_full) wall_.fill_disk(tile, false);
    if (fault == Fault::loss_1 || fault == Fault::loss_5 || fault == Fault::jitter)
      wall_.set_network({});
  }

  std::size_t evictions() const { return count_of("evicted at frame", wall_.master_log()); }

  /// The longest time between two swaps of any tile but one that touches the span.
  Duration longest_wait(std::size_t but, Time from, Time to);
  void say_line(std::string_view what, std::vector<Incident> of);
  void say_skew();

  MonotonicClock clock_;
  Time begun_ = clock_.now();
  FaultyWall wall_;
  FaultDealer dealer_;
  struct Span {
    Time from{}, to{};
  };
  std::vector<Span> quiet_;
  std::vector<Incident> incidents_;
  std::size_t swaps_ = 0;
};

Duration FaultRun::longest_wait(std::size_t but, Time from, Time to) {
  Duration longest{};
  for (std::size_t tile = 1; tile <= wall_.tiles(); ++tile) {
    if (tile == but) continue;
    std::optional<Time> last;
    for (const auto& file : wall_.swaps(tile))
      for (const Swap& swap : file) {
        const Time time{std::chrono::nanoseconds(swap.time_ns)};
        if (last && time > from && *last < to) longest = std::max(longest, time - *last);
        last = time;
      }
  }
  return longest;
}

void FaultRun::say_holdings(const char* when) const {
  const FaultyWall::Holdings master = wall_.holdings(FaultyWall::kMaster);
  FaultyWall::Holdings most;
  for (std::size_t tile = 1; tile <= wall_.tiles(); ++tile) {
    const FaultyWall::Holdings held = wall_.holdings(tile);
    most = {std::max(most.memory_mib, held.memory_mib), std::max(most.files, held.files)};
  }
  fmt::print("  memory and open files {}: master {:.2f} MiB, {}; the largest tile {:.2f} MiB, {}\n",
             when, master.memory_mib, master.files, most.memory_mib, most.files);
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double ms(Duration duration) { return 1e3 * vindu::seconds(duration); }

void FaultRun::say_line(std::string_view what, std::vector<Incident> of) {
  std::vector<double> waits, returns;
  std::size_t evictions = 0;
  for (const Incident& incident : of) {
    waits.push_back(ms(longest_wait(incident.member, incident.begun, incident.ended + seconds(1))));
    returns.push_back(incident.whole_again ? vindu::seconds(*incident.whole_again) : 999);
    evictions += incident.evictions;
  }
  fmt::print("  {:<28}{:>6}{:>11.0f}{:>7.0f} ms{:>9}{:>13.2f}{:>8.2f} s\n", what, of.size(),
             percentile(waits, 0.5), percentile(waits, 1), evictions, percentile(returns, 0.5),
             percentile(returns, 1));
}

void FaultRun::say_skew() {
  std::vector<double> skews, gaps;
  std::optional<Time> before;
  for (const WholeFrame& frame : wall_.whole_frames()) {
    const bool in_quiet = std::ranges::any_of(
        quiet_, [&](const Span& span) { return frame.first > span.from && frame.last < span.to; });
    if (in_quiet) skews.push_back(ms(frame.last - frame.first));
    if (in_quiet && before) gaps.push_back(ms(frame.last - *before));
    before = in_quiet ? std::optional(frame.last) : std::nullopt;
  }
  fmt::print(
      "  {} frames whole and undisturbed: {:.1f} ms apart (p99 {:.1f}), skew of the swaps p50 "
      "{:.2f}, p99 {:.2f}, max {:.2f} ms\n",
      skews.size(), percentile(gaps, 0.5), percentile(gaps, 0.99), percentile(skews, 0.5),
      percentile(skews, 0.99), percentile(skews, 1));
}

void FaultRun::report() {
  fmt::print("\n  {:<28}{:>6}{:>21}{:>9}{:>23}\n  {:<28}{:>6}{:>11}{:>10}{:>9}{:>13}{:>10}\n", "",
             "", "longest wait of the", "", "whole again after", "", "times", "others p50", "max",
             "evicted", "p50", "max");
  for (int kind = 0; kind < kFaults; ++kind) {
    std::vector<Incident> of;
    std::ranges::copy_if(incidents_, std::back_inserter(of), [&](const Incident& incident) {
      return incident.fault == static_cast<Fault>(kind);
    });
    if (!of.empty()) say_line(name_of(static_cast<Fault>(kind)), of);
  }
  say_skew();
}

int run(const Options& options) {
  FaultRun run(options);
  const auto started = run.start();
  if (!started) {
    fmt::print("not all tiles showed a frame within {} s\n", vindu::seconds(kPatience));
    return 1;
  }
  fmt::print("{} x {} tiles, seed {}: the first whole frame after {:.2f} s\n", options.wall.columns,
             options.wall.rows, options.wall.seed, vindu::seconds(*started));
  run.quiet(from_seconds(0.1 * options.quiet_s));
  run.say_holdings("at first");
  std::fflush(stdout);
  run.quiet(from_seconds(0.9 * options.quiet_s));
  run.say_holdings("after the quiet");
  run.faults(from_seconds(options.fault_s));
  const std::vector<std::string> ends = run.stop();
  const std::vector<std::string> wrong = run.wrong();
  run.report();
  for (const auto& list : {ends, wrong})
    for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), 10); ++i)
      fmt::print("  {}\n", list[i]);
  const std::size_t left = run.left_over();
  fmt::print("  wrong frames: {}; ended badly: {}; processes left: {}\n", wrong.size(), ends.size(),
             left);
  return wrong.empty() && ends.empty() && left == 0 && run.recovered() ? 0 : 1;
}

}  // namespace
}  // namespace vindu::testing

int main(int argc, char** argv) {
  using namespace vindu::testing;
  Options options;
  options.wall.program = VINDU_PROGRAM;
  CLI::App app("What happens to walls, done to one of real processes");
  app.add_option("FOLDER", options.wall.folder, "For all that it writes")->required();
  app.add_option("--columns", options.wall.columns, "Of tiles (7)");
  app.add_option("--rows", options.wall.rows, "Of tiles (4)");
  app.add_option("--scale", options.wall.scale, "Of the tiles' pixels (0.1)");
  app.add_option("--rate-hz", options.wall.rate_hz, "Frames a second (60)");
  app.add_option("--model", options.wall.model, "Instead of the show");
  app.add_option("--seed", options.wall.seed, "Of the faults' order and the network's losses");
  app.add_option("--only", options.only, "Faults whose name has this in it: \"tile\", \"jitter\"");
  app.add_option("--faults-s", options.fault_s,
                 "Seconds of faults (600), each kind once at least; 0: none");
  app.add_option("--quiet-s", options.quiet_s, "Seconds without, at the start (5)");
  CLI11_PARSE(app, argc, argv);
  if (!become_master_of_namespaces()) {
    std::puts("no network namespaces here");
    return 77;
  }
  std::filesystem::create_directories(options.wall.folder);
  options.wall.folder = std::filesystem::canonical(options.wall.folder);
  return run(options);
}
