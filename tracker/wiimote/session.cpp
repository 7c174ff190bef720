#include "tracker/wiimote/session.h"

#include <algorithm>
#include <utility>

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr Patience kPatient{};
constexpr Patience kDeaf{milliseconds(50), 1, true};
constexpr Patience kChecking{.tries = 3};

// A status report stopped it. The kernel then chooses its own report, within a millisecond or two;
// asking at once loses that race in one case of six.
constexpr Duration kAfterStatus = milliseconds(5);
constexpr Duration kRestart = milliseconds(600);  // asking did not help: start the camera again
constexpr Duration kFirstCheck = milliseconds(60), kCheckAgain = std::chrono::seconds(2);
// The answers take the place of four data reports.
constexpr Duration kCheckEvery = std::chrono::seconds(10);
constexpr Duration kRest = std::chrono::seconds(1);
constexpr int kManyStarts = 4;
// Another program may want other LEDs: no war about them.
constexpr Duration kLedsEvery = std::chrono::seconds(30);
// The battery's level is worth a short gap while nobody has been in view for a while.
constexpr Duration kStatusEvery = std::chrono::minutes(10);
constexpr Duration kNobody = std::chrono::seconds(5);
constexpr int kNearlyEmpty = 0x20;

// The stream has stopped. Not sooner: each request for it makes the device send a report at once,
// which is in the way where the radio is busy.
constexpr Duration stopped_after(Duration period) { return gap_limit(period) + milliseconds(1); }
constexpr Duration ask_again_after(Duration period) { return 3 * period / 2; }
// Asking once did not help: nor would a check.
constexpr Duration unanswered_after(Duration period) { return 4 * period; }

}  // namespace

bool nearly_empty(const StatusReport& status) {
  return status.battery_low || status.battery < kNearlyEmpty;
}

WiimoteSession::WiimoteSession(const WiimoteSettings& settings)
    : settings_(settings), period_(sample_period(settings.format)), gaps_(period_) {}

std::string WiimoteSession::trouble() const {
  if (!drought_.diagnosis().empty()) return drought_.diagnosis();
  if (!deaf_) return refusal_;
  if (now_ - last_expected_ < kRestart)
    return "it acknowledges nothing (an imitation?) and runs unchecked";
  return "it is connected, but silent: press a button on it";
}

WiimoteHealth WiimoteSession::health() const {
  WiimoteHealth health = health_;
  health.lone = halves_.lone();
  health.repeated = exchange_.repeated();
  health.gaps = gaps_.counts(now_);
  health.open_gap = gaps_.open(now_);
  health.trouble = trouble();
  return health;
}

void WiimoteSession::away(Time now) {
  now_ = std::max(now_, now);
  const bool empty = health_.status && nearly_empty(*health_.status);
  gaps_.suspect(empty ? GapCause::battery : GapCause::absent, now);
}

void WiimoteSession::reconnected(Time now) {
  now_ = std::max(now_, now);
  exchange_.abandon();
  halves_.interrupt();
  begun_ = greeted_ = camera_lost_ = unreadable_ = false;
  fruitless_starts_ = 0;
  silent_since_.reset();
  leds_wrong_.reset();
  rumble_changed_ = rumble_;
}

void WiimoteSession::begin(Phase phase, Time now) {
  phase_ = phase;
  switch (phase) {
    case Phase::greeting:
      return exchange_.begin(greeting_steps(settings_), kPatient);
    case Phase::starting:
      ++health_.starts;
      return exchange_.begin(camera_steps(settings_), deaf_ ? kDeaf : kPatient);
    case Phase::streaming:
      gaps_.expect(now);
      next_request_ = std::max(next_request_, now);
      restart_at_ = now + kRestart;
      return go_on(now + kFirstCheck);
    case Phase::checking:
      return exchange_.begin(steps_of_check(now), kChecking);
    case Phase::late_greeting:
      return exchange_.begin(late_greeting_steps(settings_), kChecking);
  }
}

std::vector<Step> WiimoteSession::steps_of_check(Time now) const {
  std::vector<Step> steps = check_steps(settings_);
  const bool nobody = silent_since_ && now - *silent_since_ > kNobody;
  if (nobody && health_.status && now - last_status_ > kStatusEvery) steps.push_back(status_step());
  return steps;
}

void WiimoteSession::go_on(Time next_check) {
  phase_ = Phase::streaming;
  next_check_ = next_check;
}

std::optional<WiimoteSample> WiimoteSession::take(std::span<const std::uint8_t> bytes,
                                                  Time arrival) {
  now_ = std::max(now_, arrival);
  last_report_ = arrival;
  const ParsedReport parsed = parse_report(bytes);
  drought_.take(bytes, parsed);
  if (!parsed.report) {
    ++health_.refused;
    return std::nullopt;
  }
  const Report& report = *parsed.report;
  const Progress progress = exchange_.take(report, arrival);
  if (progress != Progress::none) deaf_ = false;
  after_exchange(progress, arrival);
  if (const auto* memory = std::get_if<MemoryReport>(&report)) keep_calibration(*memory);
  if (const auto* answer = std::get_if<Acknowledgement>(&report);
      answer && progress == Progress::none)
    take_foreign(*answer, arrival);
  if (const auto* status = std::get_if<StatusReport>(&report)) take_status(*status, arrival);
  if (const auto* half = std::get_if<HalfReport>(&report)) {
    const auto joined = halves_.take(*half, arrival);
    if (joined) return take_data(*joined, arrival);
  }
  const auto* data = std::get_if<DataReport>(&report);
  if (!data) return std::nullopt;
  halves_.interrupt();
  return take_data(*data, arrival);
}

void WiimoteSession::after_exchange(Progress progress, Time now) {
  switch (progress) {
    case Progress::none:
    case Progress::step:
      return;
    case Progress::finished:
      return exchange_finished(now);
    case Progress::refused:
      return phase_ == Phase::checking ? check_refused(now) : start_again(now);
    case Progress::unequal:
      return start_again(now);
    case Progress::deserted:
      return exchange_deserted(now);
  }
}

void WiimoteSession::exchange_finished(Time now) {
  if (phase_ == Phase::greeting) {
    greeted_ = true;
    return begin(Phase::starting, now);
  }
  if (phase_ == Phase::starting) return begin(Phase::streaming, now);
  go_on(now + kCheckEvery);
  camera_lost_ = unreadable_ = false;
  fruitless_starts_ = 0;
  refusal_.clear();
  if (!std::exchange(greeted_, true)) begin(Phase::late_greeting, now);
}

/// The commands may have been obeyed all the same: go on without answers, and watch what comes.
void WiimoteSession::exchange_deserted(Time now) {
  deaf_ = true;
  if (watching()) return go_on(now + kCheckAgain);
  begin(Phase::starting, now);
}

/// Its camera is off, or it is an imitation that does not let it be read. A camera that shows dots
/// is on; one that does not is started, as long as that may help.
void WiimoteSession::check_refused(Time now) {
  const int worth_starting = unreadable_ ? 1 : kManyStarts - 1;
  if (!shows_dots_ && fruitless_starts_ < worth_starting) return start_again(now);
  refusal_ = exchange_.failure() + "; it runs unchecked";
  unreadable_ = true;
  camera_lost_ = false;
  fruitless_starts_ = 0;
  go_on(now + kCheckEvery);
}

/// The camera is not as it should be, or cannot be started.
void WiimoteSession::start_again(Time now) {
  refusal_ = exchange_.failure();
  if (phase_ == Phase::checking) {
    gaps_.suspect(GapCause::camera, now);
    if (silent_since_) gaps_.none_since(*silent_since_);
    camera_lost_ = true;
  }
  if (++fruitless_starts_ < kManyStarts) return begin(Phase::starting, now);
  refusal_ += "; if that goes on, end other programs that use the Wiimote";
  fruitless_starts_ = kManyStarts - 2;  // from now on one start, then another rest
  restart_at_ = std::max(restart_at_, now + kRest);
  go_on(now + kRest);
}

/// Somebody else was answered. Where they wrote the answer does not say: the stream shows whether
/// it was the camera. They are let finish.
void WiimoteSession::take_foreign(const Acknowledgement& answer, Time arrival) {
  if (!watching() || answer.error != 0) return;
  const bool power = answer.command == 0x13 || answer.command == 0x1a;
  if (answer.command == 0x12) gaps_.suspect(GapCause::mode, arrival);
  if (!power && answer.command != 0x16) return;
  if (power) gaps_.suspect(GapCause::camera, arrival);
  last_foreign_ = arrival;
  next_check_ = power ? arrival + kFirstCheck : std::max(next_check_, arrival + kFirstCheck);
}

void WiimoteSession::ask_soon(Time at) {
  next_request_ = std::min(next_request_, std::max(at, asked_ + ask_again_after(period_)));
}

void WiimoteSession::keep_calibration(const MemoryReport& memory) {
  const bool ours =
      memory.address == kCalibrationAddress || memory.address == kCalibrationCopyAddress;
  if (!ours || health_.calibration) return;
  health_.calibration =
      calibration_from(std::span(memory.data).first(static_cast<std::size_t>(memory.size)));
}

void WiimoteSession::take_status(const StatusReport& status, Time arrival) {
  const bool plugged = health_.status && health_.status->extension != status.extension;
  health_.status = status;
  last_status_ = arrival;
  halves_.interrupt();
  leds_wrong_.reset();
  if (phase_ != Phase::greeting && status.leds != player_leds(settings_.player))
    leds_wrong_ = std::max(arrival, last_leds_ + kLedsEvery);
  if (!watching()) return;
  gaps_.suspect(plugged ? GapCause::extension : GapCause::status, arrival);
  ask_soon(arrival + kAfterStatus);
  if (!status.camera_on) next_check_ = arrival;
}

WiimoteSample WiimoteSession::take_data(const DataReport& data, Time arrival) {
  if (!data.camera_silent) silent_since_.reset();
  shows_dots_ = data.id == data_report_id(settings_.format) && !data.camera_silent;
  if (data.id == data_report_id(settings_.format))
    take_expected(data, arrival);
  else if (watching())
    take_unexpected(data, arrival);
  return {health_.samples++, arrival, data};
}

void WiimoteSession::take_expected(const DataReport& data, Time arrival) {
  drought_.end();
  if (data.camera_silent && !silent_since_) {  // nobody in view, or switched off?
    silent_since_ = arrival;
    next_check_ = std::min(next_check_, arrival + (unreadable_ ? kCheckAgain : kFirstCheck));
  }
  const bool off = data.camera_silent && (camera_lost_ || phase_ == Phase::starting);
  if (phase_ != Phase::greeting && !off) gaps_.sample(arrival);
  last_expected_ = arrival;
  next_request_ = arrival + stopped_after(period_);
  restart_at_ = arrival + kRestart;
}

void WiimoteSession::take_unexpected(const DataReport& data, Time arrival) {
  gaps_.suspect(GapCause::mode, arrival);
  ask_soon(arrival);
  // Whoever changes the camera sets a report with dots last; one who has not yet is let be.
  const bool others_at_work = !data.slots && arrival - last_foreign_ < kFirstCheck;
  next_check_ = std::min(next_check_, others_at_work ? last_foreign_ + kFirstCheck : arrival);
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
    drought_.restart(settings_.format);
    begin(now - last_report_ > kRestart ? Phase::greeting : Phase::starting, now);
    return std::nullopt;
  }
  if (gaps_.open(now) > unanswered_after(period_)) {
    exchange_.abandon();
    go_on(std::min(next_check_, now + kFirstCheck));
  }
  halves_.interrupt();
  asked_ = now;
  next_request_ = now + ask_again_after(period_);
  return request_stream(settings_.format);
}

/// Somebody else has set them; but first the stream must be back.
std::optional<OutputReport> WiimoteSession::mend_leds(Time now) {
  if (phase_ != Phase::streaming || !leds_wrong_ || last_expected_ <= *leds_wrong_)
    return std::nullopt;
  leds_wrong_.reset();
  last_leds_ = now;
  return set_leds(player_leds(settings_.player), rumble_);
}

std::optional<OutputReport> WiimoteSession::choose_output(Time now) {
  if (!std::exchange(begun_, true)) begin(Phase::greeting, now);
  if (std::exchange(rumble_changed_, false)) return rumble_only();
  if (const auto request = watch(now)) return request;
  if (const auto leds = mend_leds(now)) return leds;
  if (phase_ == Phase::streaming && now >= next_check_) begin(Phase::checking, now);
  if (const auto command = exchange_.next_output(now)) return command;
  const Progress timeout = exchange_.take_timeout();
  if (timeout == Progress::none) return std::nullopt;
  after_exchange(timeout, now);
  return choose_output(now);
}

std::optional<OutputReport> WiimoteSession::next_output(Time now) {
  now_ = std::max(now_, now);
  std::optional<OutputReport> output = choose_output(now);
  if (output && rumble_) output->bytes[1] |= 1;  // in every report, or it stops
  return output;
}

Time WiimoteSession::deadline() const {
  if (!begun_ || rumble_changed_) return {};
  Time next = exchange_.deadline();
  if (watching()) next = std::min(next, next_request_);
  if (phase_ == Phase::streaming) next = std::min(next, next_check_);
  return next;
}

}  // namespace vindu
