// Linux' driver hid-wiimote, which shares a Wiimote with whoever reads its hidraw node: what it
// writes when it finds one, at every status report, every four seconds to look for a Motion Plus,
// and when somebody opens or closes its event nodes or reads the battery. Follows
// drivers/hid/hid-wiimote-core.c and hid-wiimote-modules.c of Linux 6.1.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "core/random.h"

namespace vindu {

struct KernelOptions {
  bool motion_plus_inside = false;  ///< product 0330: there is nothing to look for
  /// From what it reacts to until its worker writes.
  Duration reaction_shortest = std::chrono::microseconds(50);
  Duration reaction_longest = std::chrono::milliseconds(2);
  Duration battery_read_every{};  ///< by a desktop's power daemon; zero: never
  std::uint64_t seed = 1;
};

/// One output report that the kernel writes, id first.
struct KernelWrite {
  Time at{};
  std::vector<std::uint8_t> bytes;
};

/// Without a clock of its own: bound to one thread, and times never go back from call to call.
class HidWiimoteKernel {
 public:
  /// It finds the device at once.
  HidWiimoteKernel(const KernelOptions& options, Time found);

  /// An input report has arrived; it sees every one.
  void input(std::span<const std::uint8_t> report, Time at);

  /// The next thing that it writes no later than `until`; call it until it is empty.
  std::optional<KernelWrite> next(Time until);
  Time next_event() const;

  /// Somebody reads /sys/class/power_supply/wiimote_battery_*/capacity, as upower does.
  void read_battery(Time at);
  /// Somebody opens or closes the event node of the infrared camera, or of the accelerometer.
  void open_camera_node(Time at);
  void close_camera_node(Time at);
  void open_accelerometer_node(Time at);
  void close_accelerometer_node(Time at);

 private:
  enum class Then { nothing, start_timer, camera_on };
  // One report, and what must answer it before the next is written.
  struct Step {
    std::vector<std::uint8_t> bytes;  // empty: only `then`
    std::uint8_t answer = 0;          // input report: 0x20, 0x21, 0x22 or none
    std::size_t skip_on_error = 0;    // so many of the steps that follow
    Then then = Then::nothing;
  };
  struct Wait {
    Step step;
    Time deadline{};
  };
  using Steps = std::vector<Step>;

  void schedule(const Steps& steps, Time at);
  void go_on(Time at);
  void answered(bool well, Time at);
  void write(std::vector<std::uint8_t> bytes, Time at);
  void write_mode(Time at);
  void check(Time at);
  Steps detect_extensions() const;

  KernelOptions options_;
  Random random_;
  std::deque<KernelWrite> writes_;
  std::deque<Step> steps_;
  std::optional<Wait> wait_;
  Time timer_ = Time::max();
  Time battery_timer_ = Time::max();
  bool plugged_ = false;  // an extension, as the last status report said
  bool camera_ = false;
  bool accelerometer_ = false;
};

}  // namespace vindu
