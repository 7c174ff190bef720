// One connection to a Wiimote, without any input or output of its own: reports and times go in,
// samples and output reports come out. It starts the camera, each step waiting for its answer; then
// it watches the stream, and brings it back when something stops it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "tracker/wiimote/exchange.h"
#include "tracker/wiimote/gaps.h"
#include "tracker/wiimote/report.h"

namespace vindu {

/// 0 g and 1 g of x, y, z in raw counts, of one unit.
struct AccelerationCalibration {
  std::array<int, 3> zero{};
  std::array<int, 3> one_g{};

  bool operator==(const AccelerationCalibration&) const = default;
};

/// In g; the axes are the Wiimote's: x left, y back, z up (WiiBrew).
std::array<double, 3> acceleration_g(const std::array<int, 3>& raw,
                                     const AccelerationCalibration& calibration);

/// Everything else that is known of a connection.
struct WiimoteHealth {
  std::uint64_t samples = 0;
  std::uint64_t refused = 0;   ///< reports that nobody can read, and halves without the other half
  std::uint64_t starts = 0;    ///< times that the camera was started
  std::uint64_t repeated = 0;  ///< commands that had to be sent again
  GapCounts gaps{};
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

  /// The camera was started, as far as the device says.
  bool started() const { return watching(); }
  WiimoteHealth health() const;

  /// The device was away and is back: everything begins again but the counts.
  void reconnected(Time now);

  void rumble(bool on);

 private:
  enum class Phase { greeting, starting, streaming, checking, resting };

  bool watching() const { return phase_ == Phase::streaming || phase_ == Phase::checking; }
  void begin(Phase phase, Time now);
  void after_exchange(Progress progress, Time now);
  void exchange_failed(Time now);
  void exchange_deserted(Time now);
  void take_foreign_command(Time arrival);
  void ask_soon(Time at);
  void check_soon(Time now);
  void take_status(const StatusReport& status, Time arrival);
  void keep_calibration(const Report& report);
  std::optional<WiimoteSample> take_data(const DataReport& data, Time arrival);
  std::optional<WiimoteSample> take_half(const HalfReport& half, Time arrival);
  std::optional<OutputReport> watch(Time now);
  std::optional<OutputReport> choose_output(Time now);

  WiimoteSettings settings_;
  Phase phase_ = Phase::greeting;
  bool begun_ = false;
  Exchange exchange_;
  GapCounter gaps_;
  Time next_request_{};  // of the stream, unless it comes by itself
  Time asked_{};         // for it, the last time
  Time restart_at_{};    // unless it comes before
  Time next_check_{};
  Time rest_until_{};
  Time last_report_{};
  Time last_foreign_{};               // answer to somebody else
  std::optional<Time> silent_since_;  // the camera's bytes say nothing
  bool camera_lost_ = false;
  bool deaf_ = false;  // the device let the last commands go unanswered
  int fruitless_starts_ = 0;
  std::optional<HalfReport> first_half_;
  bool rumble_ = false;
  bool rumble_changed_ = false;
  WiimoteHealth health_;
};

}  // namespace vindu
