// The driver's session and the firmware of an emulated Wiimote that shares no code with it, over a
// link with a delay, in time that the test moves.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <initializer_list>
#include <vector>

#include "tracker/wiimote/emulator.h"
#include "tracker/wiimote/session.h"

namespace vindu::testing {

inline SensorView dot_in_the_middle() {
  SensorView view;
  view.spots = {{.x_px = 511, .y_px = 383, .brightness = 0.1}};
  return view;
}

inline Time at(Duration since_start) { return Time{} + std::chrono::seconds(1) + since_start; }

/// A session and a device, a link's delay to either side between them.
class Connection {
 public:
  explicit Connection(const WiimoteSettings& settings = {}, EmulatorOptions options = {},
                      Duration delay = std::chrono::milliseconds(3))
      : session(settings),
        device(started(std::move(options)), [this](Time) { return view; }),
        delay_(delay) {}

  /// Lets time pass.
  void run_until(Time end) {
    while (now < end) {
      now += std::chrono::milliseconds(1);
      if (const auto happens = each_millisecond) happens();
      while (const auto report = device.next(now)) send(report->span());
      while (!to_host_.empty() && to_host_.front().second <= now) hand_over();
      while (const auto output = session.next_output(now)) write(output->span());
      while (!to_device_.empty() && to_device_.front().second <= now) obey();
    }
  }
  void run(Duration length) { run_until(now + length); }

  /// What somebody else on this machine writes.
  void write(std::span<const std::uint8_t> bytes) {
    to_device_.push_back({{bytes.begin(), bytes.end()}, now + delay_});
  }
  void write(std::initializer_list<std::uint8_t> bytes) {
    write(std::span(bytes.begin(), bytes.size()));
  }
  /// What a device sends that is not as the emulated one.
  void send(std::span<const std::uint8_t> bytes) {
    to_host_.push_back({{bytes.begin(), bytes.end()}, now + delay_});
  }

  const GapCount& gaps(GapCause cause) const {
    return health_.gaps[static_cast<std::size_t>(cause)];
  }
  /// Lets a second pass, then asserts that dots come and forgets them.
  void stream() {
    view = dot_in_the_middle();
    run(std::chrono::seconds(1));
    ASSERT_TRUE(session.started());
    ASSERT_EQ(all_gaps(), 0u);
    samples.clear();
  }
  /// Whether the last sample shows it.
  bool shows_the_dot() const {
    return !samples.empty() && samples.back().data.slots &&
           dots_of(*samples.back().data.slots).size() == 1;
  }
  std::uint64_t all_gaps() {
    health_ = session.health();
    std::uint64_t count = 0;
    for (const GapCount& each : health_.gaps) count += each.gaps;
    return count;
  }

  Time now = at({});
  SensorView view;
  WiimoteSession session;
  WiimoteEmulator device;
  std::vector<WiimoteSample> samples;
  std::function<void()> each_millisecond;
  std::function<bool(std::span<const std::uint8_t>)> lose_input, lose_output;
  std::function<void(std::vector<std::uint8_t>&)> spoil_input;

 private:
  static EmulatorOptions started(EmulatorOptions options) {
    options.start = at({});
    return options;
  }
  void hand_over() {
    std::vector<std::uint8_t> report = to_host_.front().first;
    to_host_.pop_front();
    if (lose_input && lose_input(report)) return;
    if (spoil_input) spoil_input(report);
    if (const auto sample = session.take(report, now)) samples.push_back(*sample);
  }
  void obey() {
    const auto bytes = to_device_.front().first;
    to_device_.pop_front();
    if (!lose_output || !lose_output(bytes)) device.output(bytes, now);
  }

  Duration delay_;
  std::deque<std::pair<std::vector<std::uint8_t>, Time>> to_host_, to_device_;
  WiimoteHealth health_;
};

}  // namespace vindu::testing
