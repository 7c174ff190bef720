// One connection to a Wiimote, without any input or output of its own: reports and times go in,
// samples and output reports come out. It starts the camera, each step waiting for its answer; then
// it watches the stream, and brings it back when something stops it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracker/wiimote/acceleration.h"
#include "tracker/wiimote/drought.h"
#include "tracker/wiimote/exchange.h"
#include "tracker/wiimote/gaps.h"
#include "tracker/wiimote/halves.h"
#include "tracker/wiimote/report.h"

namespace vindu {

/// Its batteries last for hours at best: the device says so, or the level is where it would.
bool nearly_empty(const StatusReport& status);

/// Everything else that is known of a connection.
struct WiimoteHealth {
  std::uint64_t samples = 0;
  std::uint64_t refused = 0;   ///< reports that nobody can read
  std::uint64_t lone = 0;      ///< halves of the full format's samples without the other half
  std::uint64_t starts = 0;    ///< times that the camera was started
  std::uint64_t repeated = 0;  ///< commands that had to be sent again
  GapCounts gaps{};            ///< with the one that is open
  Duration open_gap{};         ///< how long no sample of the wanted format has come
  std::optional<StatusReport> status;                  ///< the last one
  std::optional<AccelerationCalibration> calibration;  ///< from the unit's memory, if that is whole
  std::string trouble;  ///< what is wrong now, and what helps; empty when nothing is
};

/// One data report. It has no slots when the device was told to send others.
struct WiimoteSample {
  std::uint64_t sequence = 0;  ///< counts the samples of this connection
  Time arrival{};
  DataReport data;
};

/// Times never go back.
class WiimoteSession {
 public:
  explicit WiimoteSession(const WiimoteSettings& settings);

  /// A report has come. Any data report is a sample, whatever else goes on.
  std::optional<WiimoteSample> take(std::span<const std::uint8_t> bytes, Time arrival);

  /// What must be written now. To be called after take() and when deadline() is reached, until it
  /// is empty.
  std::optional<OutputReport> next_output(Time now);
  Time deadline() const;

  /// The camera was started, as far as the device says; from then on the stream is watched.
  bool started() const { return watching(); }
  /// As of the last time that this was told of.
  WiimoteHealth health() const;
  /// The last gap that ended; each is told once.
  std::optional<Gap> take_gap() { return gaps_.take_closed(); }
  /// When the device said anything, the last time.
  Time last_report() const { return last_report_; }

  /// The device is not connected now. To be called once at least, before reconnected().
  void away(Time now);
  /// It is opened anew: everything begins again but the counts.
  void reconnected(Time now);

  void rumble(bool on);

 private:
  enum class Phase { greeting, starting, streaming, checking, late_greeting };

  bool watching() const { return phase_ >= Phase::streaming; }
  std::string trouble() const;
  void begin(Phase phase, Time now);
  std::vector<Step> steps_of_check(Time now) const;
  void go_on(Time next_check);
  void after_exchange(Progress progress, Time now);
  void exchange_finished(Time now);
  void exchange_deserted(Time now);
  void check_refused(Time now);
  void start_again(Time now);
  void take_foreign(const Acknowledgement& answer, Time arrival);
  void ask_soon(Time at);
  void take_status(const StatusReport& status, Time arrival);
  void keep_calibration(const MemoryReport& memory);
  WiimoteSample take_data(const DataReport& data, Time arrival);
  void take_expected(const DataReport& data, Time arrival);
  void take_unexpected(const DataReport& data, Time arrival);
  std::optional<OutputReport> watch(Time now);
  std::optional<OutputReport> mend_leds(Time now);
  std::optional<OutputReport> choose_output(Time now);

  WiimoteSettings settings_;
  Duration period_;
  Phase phase_ = Phase::greeting;
  bool begun_ = false;
  bool greeted_ = false;  // or tried again in vain
  Exchange exchange_;
  HalfJoiner halves_;
  GapCounter gaps_;
  Drought drought_;
  Time now_{};
  Time next_request_{};  // of the stream, unless it comes by itself
  Time asked_{};         // for it, the last time
  Time restart_at_{};    // unless it comes before
  Time next_check_{};
  Time last_report_{};
  Time last_expected_{};  // sample
  Time last_status_{};
  Time last_foreign_{};               // answer to somebody else's command to the camera
  std::optional<Time> silent_since_;  // the camera's bytes say nothing
  bool shows_dots_ = false;           // the last data report did
  bool camera_lost_ = false;
  bool unreadable_ = false;  // its registers are refused whatever is done
  bool deaf_ = false;        // the device let the last commands go unanswered
  int fruitless_starts_ = 0;
  std::optional<Time> leds_wrong_;  // and may be set after this
  Time last_leds_ = Time::min();    // set again
  bool rumble_ = false;
  bool rumble_changed_ = false;
  std::string refusal_;  // what is wrong with the camera
  WiimoteHealth health_;
};

}  // namespace vindu
