// How long the dots are away after a disturbance, in the emulators' own time: a status report, the
// kernel choosing its report after one, the kernel's users opening and closing the camera, on each
// kind of link. 500 disturbances each, at random moments of the stream. The reference is the same
// link left alone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "tracker/wiimote/emulator_bus.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr int kDisturbances = 500;

SensorView one_dot(Time) {
  SensorView view;
  view.spots = {{.x_px = 300, .y_px = 200, .brightness = 0.1}};
  return view;
}

enum class Disturbance { none, status, battery, camera_opened, camera_closed, camera_flapped };

/// A driver on an emulated Wiimote; time goes as fast as it can.
class Stream {
 public:
  Stream(const LinkOptions& link, bool kernel)
      : device_(bus_.add({.info = {},
                          .firmware = {},
                          .link = link,
                          .kernel = kernel ? std::optional(KernelOptions{}) : std::nullopt},
                         one_dot)),
        reader_(bus_.open(bus_.path(0)), 0) {
    longest_gap(milliseconds(3000));
  }

  /// The longest time without the dot up to then, and the one that is still open.
  double longest_gap(Duration length) {
    Duration longest{};
    for (const Time end = clock_.now() + length; clock_.now() < end;) {
      clock_.sleep_until(clock_.now() + std::chrono::microseconds(500));
      while (const auto observation = reader_.next(clock_.now())) {
        if (observation->dots.empty()) continue;
        longest = std::max(longest, observation->arrival - last_);
        last_ = observation->arrival;
      }
    }
    return vindu::milliseconds(std::max(longest, clock_.now() - last_));
  }

  /// As soon as it was opened.
  void flap() {
    longest_gap(from_seconds(random_.uniform(0.09, 0.14)));
    device_.close_camera_node();
  }

  double disturb(Disturbance what) {
    longest_gap(from_seconds(random_.uniform(1.0, 1.02)));
    if (what == Disturbance::camera_closed) device_.open_camera_node(), longest_gap(kWatch);
    if (what == Disturbance::status) device_.send_status();
    if (what == Disturbance::battery) device_.read_battery();
    if (what == Disturbance::camera_opened) device_.open_camera_node();
    if (what == Disturbance::camera_closed) device_.close_camera_node();
    if (what == Disturbance::camera_flapped) device_.open_camera_node(), flap();
    const double gap_ms = longest_gap(kWatch);
    if (what == Disturbance::camera_opened) device_.close_camera_node(), longest_gap(kWatch);
    return gap_ms;
  }

 private:
  static constexpr Duration kWatch = milliseconds(1000);
  ManualClock clock_;
  EmulatedHidBus bus_{clock_};
  EmulatedDevice& device_;
  WiimoteReader reader_;
  Random random_{3};
  Time last_{};
};

void gaps(benchmark::State& state, const LinkOptions& link, Disturbance what) {
  std::vector<double> gaps_ms;
  for (auto _ : state) {
    Stream stream(link, what != Disturbance::none && what != Disturbance::status);
    for (int i = 0; i < kDisturbances; ++i) gaps_ms.push_back(stream.disturb(what));
  }
  std::ranges::sort(gaps_ms);
  state.counters["mean_ms"] =
      std::accumulate(gaps_ms.begin(), gaps_ms.end(), 0.0) / static_cast<double>(gaps_ms.size());
  state.counters["p95_ms"] = gaps_ms[gaps_ms.size() * 95 / 100];
  state.counters["longest_ms"] = gaps_ms.back();
}

#define GAPS(what)                                                                              \
  BENCHMARK_CAPTURE(gaps, good_##what, LinkOptions{}, Disturbance::what)->Iterations(1);        \
  BENCHMARK_CAPTURE(gaps, busy_##what, two_on_one_adapter(), Disturbance::what)->Iterations(1); \
  BENCHMARK_CAPTURE(gaps, bad_##what, bad_link(), Disturbance::what)->Iterations(1)
GAPS(none);
GAPS(status);
GAPS(battery);
GAPS(camera_opened);
GAPS(camera_closed);
GAPS(camera_flapped);

}  // namespace
}  // namespace vindu
