#include "tracker/wiimote/session.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr Patience kStarting{milliseconds(250), 4};
constexpr Patience kRestarting{milliseconds(100), 4};  // it answered a moment ago
constexpr Patience kDeaf{milliseconds(50), 1, true};
constexpr Patience kChecking{milliseconds(100), 3};

// The stream has stopped. Not sooner: each request for it makes the device send a report at once,
// which is in the way where the radio is busy.
constexpr Duration kStopped = kGap + milliseconds(1);
// A status report stopped it. The kernel then chooses its own report, within a millisecond or two;
// asking at once loses that race in one case of six.
constexpr Duration kAfterStatus = milliseconds(5);
constexpr Duration kAskAgain = milliseconds(15);
constexpr Duration kUnanswered = milliseconds(40);  // asking once did not help: nor would a check
constexpr Duration kRestart = milliseconds(600);    // asking did not help: start the camera again
constexpr Duration kFirstCheck = milliseconds(60), kCheckAgain = std::chrono::seconds(2);
// The answers take the place of four data reports.
constexpr Duration kCheckEvery = std::chrono::seconds(10);
constexpr Duration kRest = std::chrono::seconds(1);
constexpr int kManyStarts = 4;

int calibration_value(std::uint8_t high, int low_bits) { return high << 2 | (low_bits & 3); }

// Bytes 0 to 3: zero x, y, z and their low bits; 4 to 7: the same at 1 g; 9: the sum of the others
// plus 0x55 (WiiBrew, EEPROM).
std::optional<AccelerationCalibration> calibration_from(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kCalibrationSize) return std::nullopt;
  const int sum = std::accumulate(bytes.begin(), bytes.begin() + 9, 0x55);
  if ((sum & 0xff) != bytes[9]) return std::nullopt;
  AccelerationCalibration calibration;
  for (int axis = 0; axis < 3; ++axis) {
    const int shift = 4 - 2 * axis;
    calibration.zero[axis] = calibration_value(bytes[axis], bytes[3] >> shift);
    calibration.one_g[axis] = calibration_value(bytes[4 + axis], bytes[7] >> shift);
    if (calibration.zero[axis] == calibration.one_g[axis]) return std::nullopt;
  }
  return calibration;
}

}  // namespace

std::array<double, 3> acceleration_g(const std::array<int, 3>& raw,
                                     const AccelerationCalibration& calibration) {
  std::array<double, 3> g{};
  for (int axis = 0; axis < 3; ++axis)
    g[axis] = static_cast<double>(raw[axis] - calibration.zero[axis]) /
              (calibration.one_g[axis] - calibration.zero[axis]);
  return g;
}

WiimoteSession::WiimoteSession(const WiimoteSettings& settings) : settings_(settings) {}

WiimoteHealth WiimoteSession::health() const {
  WiimoteHealth health = health_;
  health.gaps = gaps_.counts();
  health.repeated = exchange_.repeated();
  return health;
}

void WiimoteSession::reconnected(Time now) {
  exchange_.abandon();
  begun_ = deaf_ = camera_lost_ = false;
  fruitless_starts_ = 0;
  silent_since_.reset();
  first_half_.reset();
  rumble_changed_ = rumble_;
  gaps_.suspect(GapCause::absent, now);
}

void WiimoteSession::begin(Phase phase, Time now) {
  phase_ = phase;
  if (phase == Phase::greeting) exchange_.begin(greeting_steps(settings_), kStarting);
  if (phase == Phase::checking) exchange_.begin(check_steps(settings_), kChecking);
  if (phase == Phase::starting) {
    ++health_.starts;
    exchange_.begin(camera_steps(settings_), deaf_          ? kDeaf
                                             : camera_lost_ ? kRestarting
                                                            : kStarting);
  }
  if (phase == Phase::streaming) {
    gaps_.expect(now);
    next_request_ = std::max(next_request_, now);
    restart_at_ = now + kRestart;
    next_check_ = now + kFirstCheck;
  }
  if (phase == Phase::resting) rest_until_ = now + kRest;
}

std::optional<WiimoteSample> WiimoteSession::take(std::span<const std::uint8_t> bytes,
                                                  Time arrival) {
  last_report_ = arrival;
  const ParsedReport parsed = parse_report(bytes);
  if (!parsed.report) {
    ++health_.refused;
    return std::nullopt;
  }
  const Report& report = *parsed.report;
  keep_calibration(report);
  const Progress progress = exchange_.take(report, arrival);
  if (progress != Progress::none) deaf_ = false;
  after_exchange(progress, arrival);
  if (const auto* foreign = std::get_if<Acknowledgement>(&report);
      foreign && progress == Progress::none)
    take_foreign_command(arrival);
  if (const auto* status = std::get_if<StatusReport>(&report)) take_status(*status, arrival);
  if (const auto* data = std::get_if<DataReport>(&report)) return take_data(*data, arrival);
  if (const auto* half = std::get_if<HalfReport>(&report)) return take_half(*half, arrival);
  return std::nullopt;
}

void WiimoteSession::after_exchange(Progress progress, Time now) {
  if (progress == Progress::failed) return exchange_failed(now);
  if (progress == Progress::deserted) return exchange_deserted(now);
  if (progress != Progress::finished) return;
  if (phase_ == Phase::greeting) return begin(Phase::starting, now);
  if (phase_ == Phase::starting) return begin(Phase::streaming, now);
  phase_ = Phase::streaming;  // the check found all as it should be
  next_check_ = now + kCheckEvery;
  camera_lost_ = false;
  fruitless_starts_ = 0;
  health_.trouble.clear();
}

/// Refused, or not what was written.
void WiimoteSession::exchange_failed(Time now) {
  health_.trouble = exchange_.failure();
  // A unit without whole calibration data still has a camera.
  if (phase_ == Phase::greeting) return begin(Phase::starting, now);
  if (phase_ == Phase::checking) {
    gaps_.suspect(GapCause::camera, now);
    if (silent_since_) gaps_.none_since(*silent_since_);
    camera_lost_ = true;
  }
  if (++fruitless_starts_ < kManyStarts) return begin(Phase::starting, now);
  health_.trouble += "; if that goes on, end other programs that use the Wiimote";
  begin(Phase::resting, now);
}

/// The commands may have been obeyed all the same: go on without answers, and watch what comes.
void WiimoteSession::exchange_deserted(Time now) {
  if (phase_ == Phase::checking) {
    phase_ = Phase::streaming;
    next_check_ = now + kCheckAgain;
    return;
  }
  health_.trouble = exchange_.failure() + "; is it asleep or out of reach? Press a button on it";
  deaf_ = true;
  begin(Phase::starting, now);
}

/// Somebody else was answered: the camera may be as they want it.
void WiimoteSession::take_foreign_command(Time arrival) {
  if (!watching()) return;
  gaps_.suspect(GapCause::camera, arrival);
  last_foreign_ = arrival;
  next_check_ = arrival + kFirstCheck;
}

void WiimoteSession::ask_soon(Time at) {
  next_request_ = std::min(next_request_, std::max(at, asked_ + kAskAgain));
}

void WiimoteSession::check_soon(Time now) {
  next_check_ = std::min(next_check_, now + kFirstCheck);
}

void WiimoteSession::keep_calibration(const Report& report) {
  const auto* memory = std::get_if<MemoryReport>(&report);
  if (!memory || phase_ != Phase::greeting || health_.calibration) return;
  health_.calibration =
      calibration_from(std::span(memory->data).first(static_cast<std::size_t>(memory->size)));
}

void WiimoteSession::take_status(const StatusReport& status, Time arrival) {
  const bool plugged = health_.status && health_.status->extension != status.extension;
  health_.status = status;
  if (!watching()) return;
  gaps_.suspect(plugged ? GapCause::extension : GapCause::status, arrival);
  ask_soon(arrival + kAfterStatus);
  if (!status.camera_on) next_check_ = arrival;
}

std::optional<WiimoteSample> WiimoteSession::take_data(const DataReport& data, Time arrival) {
  const bool expected = data.id == data_report_id(settings_.format);
  if (!data.camera_silent) silent_since_.reset();
  if (!expected && watching()) {
    gaps_.suspect(GapCause::mode, arrival);
    ask_soon(arrival);
    // Whoever changes the camera sets a report with dots last; one who has not yet is let be.
    const bool others_at_work = !data.slots && arrival - last_foreign_ < kFirstCheck;
    next_check_ = std::min(next_check_, others_at_work ? last_foreign_ + kFirstCheck : arrival);
  }
  if (expected) {
    if (data.camera_silent && !silent_since_) {  // nobody in view, or switched off?
      silent_since_ = arrival;
      check_soon(arrival);
    }
    const bool off = data.camera_silent && (camera_lost_ || phase_ == Phase::starting);
    if (phase_ != Phase::greeting && !off) gaps_.sample(arrival);
    next_request_ = arrival + kStopped;
    restart_at_ = arrival + kRestart;
  }
  return WiimoteSample{health_.samples++, arrival, data};
}

std::optional<WiimoteSample> WiimoteSession::take_half(const HalfReport& half, Time arrival) {
  const auto first = std::exchange(first_half_, std::nullopt);
  if (half.second && first) return take_data(join(*first, half), arrival);
  if (half.second || first) ++health_.refused;  // the other half is lost
  if (!half.second) first_half_ = half;
  if (settings_.format == IrFormat::full) next_request_ = arrival + kStopped;
  return std::nullopt;
}

void WiimoteSession::rumble(bool on) {
  rumble_changed_ = rumble_changed_ || rumble_ != on;
  rumble_ = on;
}

/// Asks for the stream when it has stopped; starts the camera anew when asking does not help.
std::optional<OutputReport> WiimoteSession::watch(Time now) {
  if (!watching() || now < next_request_) return std::nullopt;
  if (now >= restart_at_) {
    gaps_.suspect(GapCause::silence, now);
    begin(now - last_report_ > kRestart ? Phase::greeting : Phase::starting, now);
    return std::nullopt;
  }
  if (gaps_.open(now) > kUnanswered) {
    exchange_.abandon();
    phase_ = Phase::streaming;
    check_soon(now);
  }
  asked_ = now;
  next_request_ = now + kAskAgain;
  return request_stream(settings_.format);
}

std::optional<OutputReport> WiimoteSession::choose_output(Time now) {
  if (!std::exchange(begun_, true)) begin(Phase::greeting, now);
  if (std::exchange(rumble_changed_, false)) return rumble_only();
  if (phase_ == Phase::resting && now >= rest_until_) begin(Phase::greeting, now);
  if (const auto request = watch(now)) return request;
  if (phase_ == Phase::streaming && now >= next_check_) begin(Phase::checking, now);
  if (const auto command = exchange_.next_output(now)) return command;
  const Progress timeout = exchange_.take_timeout();
  if (timeout == Progress::none) return std::nullopt;
  after_exchange(timeout, now);
  return choose_output(now);
}

std::optional<OutputReport> WiimoteSession::next_output(Time now) {
  std::optional<OutputReport> output = choose_output(now);
  if (output && rumble_) output->bytes[1] |= 1;  // in every report, or it stops
  return output;
}

Time WiimoteSession::deadline() const {
  if (!begun_ || rumble_changed_) return {};
  if (phase_ == Phase::resting) return rest_until_;
  Time next = exchange_.deadline();
  if (watching()) next = std::min(next, next_request_);
  if (phase_ == Phase::streaming) next = std::min(next, next_check_);
  return next;
}

}  // namespace vindu
