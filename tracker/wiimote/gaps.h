// Counts the holes in a stream of dots, and why each was there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/clock.h"

namespace vindu {

/// The later in the list, the more it explains: of several the last counts.
enum class GapCause {
  late,       ///< nothing was seen but delay: the radio link
  silence,    ///< the device said nothing until it was asked again
  mode,       ///< another program or the kernel chose another report
  status,     ///< a status report, asked for or not, reset the device's mode
  extension,  ///< the same, because something was plugged in or out
  camera,     ///< another program or the kernel wrote to the camera, or switched it off
  absent,     ///< it was not connected
  battery,    ///< the same, and the last that it told was that its batteries are nearly empty
};
inline constexpr std::size_t kGapCauses = 8;

constexpr const char* name_of(GapCause cause) {
  constexpr const char* names[] = {"late",      "silence", "mode",   "status",
                                   "extension", "camera",  "absent", "battery"};
  return names[static_cast<int>(cause)];
}

/// Two samples further apart than this have a gap between them, where `period` is that of the
/// device's samples: two Wiimotes on one adapter, with one of 10 ms, send in bursts up to 28 ms
/// apart (thesis table 5.1).
constexpr Duration gap_limit(Duration period) { return 3 * period; }
/// The same where there is a reason to expect one.
constexpr Duration explained_gap_limit(Duration period) { return 3 * period / 2; }

struct GapCount {
  std::uint64_t gaps = 0;
  Duration total{};
  Duration longest{};
};

using GapCounts = std::array<GapCount, kGapCauses>;

/// "2 status (longest 45 ms, in all 80 ms), 1 camera (140 ms)", or "none".
std::string text_of(const GapCounts& counts);

struct Gap {
  GapCause cause = GapCause::late;
  Duration length{};
};

/// "gap of 45 ms: status"
std::string text_of(const Gap& gap);

/// Times never go back.
class GapCounter {
 public:
  /// `period`: from one sample to the next, as the device takes them.
  explicit GapCounter(Duration period) : period_(period) {}

  /// Samples are expected from here on; what is missing counts from the last one, or from here.
  void expect(Time now);
  /// Something happened that explains a gap that is open, or opens soon.
  void suspect(GapCause cause, Time now);
  /// The samples since `then` were none after all.
  void none_since(Time then);
  /// A good sample has come.
  void sample(Time arrival);

  /// How long there has been no sample; zero while none is expected.
  Duration open(Time now) const { return last_ ? now - *last_ : Duration{}; }
  /// With the gap that is open now.
  GapCounts counts(Time now) const;
  /// The last gap that was closed; each is told once.
  std::optional<Gap> take_closed();

 private:
  std::optional<Gap> gap_until(Time now) const;

  Duration period_;
  std::optional<Time> last_;
  std::optional<GapCause> suspected_;
  Time suspected_at_{};
  GapCounts counts_{};
  std::optional<Gap> closed_;
};

}  // namespace vindu
