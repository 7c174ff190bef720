#include "tracker/wiimote/emulator_kernel.h"

#include <algorithm>

namespace vindu {
namespace {

using ReportBytes = std::vector<std::uint8_t>;

constexpr Duration kAnswerTimeout = std::chrono::seconds(1);
constexpr Duration kMotionPlusPeriod = std::chrono::seconds(4);

ReportBytes write_bytes(std::uint8_t chip, std::uint8_t offset, const ReportBytes& data) {
  ReportBytes bytes(22);
  const std::uint8_t head[] = {0x16, 0x04,   chip,
                               0x00, offset, static_cast<std::uint8_t>(data.size())};
  std::ranges::copy(head, bytes.begin());
  std::ranges::copy(data, bytes.begin() + 6);
  return bytes;
}

ReportBytes read_identity(std::uint8_t chip) { return {0x17, 0x04, chip, 0x00, 0xfa, 0x00, 0x06}; }

}  // namespace

HidWiimoteKernel::HidWiimoteKernel(const KernelOptions& options, Time found)
    : options_(options), random_(options.seed) {
  Steps steps = {{{0x15, 0x00}, 0x20}, {{0x11, 0x10}}};
  const Steps detect = detect_extensions();
  steps.insert(steps.end(), detect.begin(), detect.end());
  steps.push_back({{0x15, 0x00}, 0x20});  // its power supply is registered, and read at once
  schedule(steps, found);
  if (options_.battery_read_every > Duration::zero())
    battery_timer_ = found + options_.battery_read_every;
}

// What it does with both ports: initialise, decrypt, read who is there; the second write only if
// the first was taken.
HidWiimoteKernel::Steps HidWiimoteKernel::detect_extensions() const {
  const Then timer = options_.motion_plus_inside ? Then::nothing : Then::start_timer;
  return {{write_bytes(0xa4, 0xf0, {0x55}), 0x22, 1},
          {write_bytes(0xa4, 0xfb, {0x00}), 0x22},
          {write_bytes(0xa6, 0xf0, {0x55}), 0x22, 1},
          {write_bytes(0xa6, 0xfb, {0x00}), 0x22},
          {read_identity(0xa6), 0x21},
          {read_identity(0xa4), 0x21, 0, timer},
          {{0x15, 0x00}}};
}

void HidWiimoteKernel::check(Time at) {
  schedule({{read_identity(0xa4), 0x21}}, at);
  if (options_.motion_plus_inside) return;
  schedule({{write_bytes(0xa6, 0xf0, {0x55}), 0x22, 1},
            {write_bytes(0xa6, 0xfb, {0x00}), 0x22},
            {read_identity(0xa6), 0x21, 0, Then::start_timer}},
           at);
}

void HidWiimoteKernel::schedule(const Steps& steps, Time at) {
  steps_.insert(steps_.end(), steps.begin(), steps.end());
  go_on(at);
}

void HidWiimoteKernel::go_on(Time at) {
  while (!wait_ && !steps_.empty()) {
    const Step step = std::move(steps_.front());
    steps_.pop_front();
    if (!step.bytes.empty()) write(step.bytes, at);
    if (step.answer != 0) {
      wait_ = Wait{step, at + kAnswerTimeout};
      return;
    }
    if (step.then == Then::camera_on) camera_ = true, write_mode(at);
  }
}

void HidWiimoteKernel::answered(bool well, Time at) {
  const Step step = std::move(wait_->step);
  wait_.reset();
  if (step.then == Then::start_timer) timer_ = at + kMotionPlusPeriod;
  const std::size_t skipped = well ? 0 : std::min(step.skip_on_error, steps_.size());
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(skipped));
  go_on(at);
}

void HidWiimoteKernel::write(ReportBytes bytes, Time at) {
  const Duration reaction = from_seconds(
      random_.uniform(seconds(options_.reaction_shortest), seconds(options_.reaction_longest)));
  const Time not_before = writes_.empty() ? Time::min() : writes_.back().at;
  writes_.push_back({std::max(at + reaction, not_before), std::move(bytes)});
}

// Never continuous; the report that shows what somebody has opened.
void HidWiimoteKernel::write_mode(Time at) {
  const int mode = camera_ ? (accelerometer_ ? 0x37 : 0x36) : (accelerometer_ ? 0x31 : 0x30);
  write({0x12, 0x00, static_cast<std::uint8_t>(mode)}, at);
}

void HidWiimoteKernel::input(std::span<const std::uint8_t> report, Time at) {
  if (report.size() >= 7 && report[0] == 0x20) {
    write_mode(at);
    const bool plugged = (report[3] & 0x02) != 0;
    if (plugged != plugged_) schedule({{read_identity(0xa4), 0x21}}, at);
    if (plugged != plugged_) schedule(detect_extensions(), at);
    plugged_ = plugged;
  }
  if (!wait_ || report.empty() || report[0] != wait_->step.answer) return;
  const bool acknowledged = report[0] == 0x22 && report.size() >= 5;
  if (acknowledged && report[3] != wait_->step.bytes[0]) return;
  const bool failed = (acknowledged && report[4] != 0) ||
                      (report[0] == 0x21 && report.size() >= 4 && (report[3] & 0x0f) != 0);
  answered(!failed, at);
}

Time HidWiimoteKernel::next_event() const {
  Time soonest = std::min(timer_, battery_timer_);
  if (wait_) soonest = std::min(soonest, wait_->deadline);
  if (!writes_.empty()) soonest = std::min(soonest, writes_.front().at);
  return soonest;
}

std::optional<KernelWrite> HidWiimoteKernel::next(Time until) {
  for (Time at = next_event(); at <= until; at = next_event()) {
    if (!writes_.empty() && writes_.front().at == at) {
      KernelWrite first = std::move(writes_.front());
      writes_.pop_front();
      return first;
    }
    if (battery_timer_ == at) {
      battery_timer_ += options_.battery_read_every;
      read_battery(at);
    } else if (timer_ == at) {
      timer_ = Time::max();
      check(at);
    } else {
      answered(false, at);
    }
  }
  return std::nullopt;
}

void HidWiimoteKernel::read_battery(Time at) { schedule({{{0x15, 0x00}, 0x20}}, at); }

// One step at a time, each after the acknowledgement; a failure ends it.
void HidWiimoteKernel::open_camera_node(Time at) {
  if (camera_) return;
  schedule({{{0x13, 0x06}, 0x22, 7},
            {{0x1a, 0x06}, 0x22, 6},
            {write_bytes(0xb0, 0x30, {0x01}), 0x22, 5},
            {write_bytes(0xb0, 0x00, {0x02, 0, 0, 0x71, 0x01, 0, 0xaa, 0, 0x64}), 0x22, 4},
            {write_bytes(0xb0, 0x1a, {0x63, 0x03}), 0x22, 3},
            {write_bytes(0xb0, 0x33, {0x01}), 0x22, 2},
            {write_bytes(0xb0, 0x30, {0x08}), 0x22, 1},
            {{}, 0, 0, Then::camera_on}},
           at);
}

void HidWiimoteKernel::close_camera_node(Time at) {
  if (!camera_) return;
  camera_ = false;
  write({0x13, 0x00}, at);
  write({0x1a, 0x00}, at);
  write_mode(at);
}

void HidWiimoteKernel::open_accelerometer_node(Time at) {
  accelerometer_ = true;
  write_mode(at);
}

void HidWiimoteKernel::close_accelerometer_node(Time at) {
  accelerometer_ = false;
  write_mode(at);
}

}  // namespace vindu
