// What one report of one camera does to the heads that are tracked: which dot is which LED, by the
// filter's own expectation, and the correction by each dot that fits. No sorting, no equal counts;
// any dot may be false and any LED missing.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tracker/joint/head_filter.h"
#include "tracker/observation.h"

namespace vindu {

/// The dots of one report, ready for the filter.
struct TimedDots {
  int camera = 0;
  Time captured{};
  double time_sigma_s = 0;
  double dot_sigma_px = 0.6;
  double distrust = 1;  ///< factor on that sigma for what fits all the same
  DotList dots;
  std::array<bool, kMaxDots> masked{};  ///< a known reflection, unless it is where an LED must be
};

/// A head, and whether it is tracked now.
struct HeadTrack {
  std::optional<HeadState> state;
  Time seen{};  ///< when the last dot of it was captured
};

struct AssociationOptions {
  double gate = 13.8;  ///< squared Mahalanobis distance: 99.9 % of two degrees of freedom
  /// Unseen for longer, a head slows down with this time constant; then it is lost.
  Duration coasts_after = std::chrono::milliseconds(60);
  Duration damping = std::chrono::milliseconds(100);
  Duration lost_after = std::chrono::milliseconds(250);
  bool turns = true;  ///< false: the rotation is given, not estimated
  bool may_widen =
      true;  ///< dots that stand aside all alike make the head doubtful, not the camera
};

struct AcceptedDot {
  std::size_t dot = 0;
  int head = 0;
  int led = 0;
  Vec2 residual_px = Vec2::Zero();  ///< from where it was expected
  Vec2 raw_px_s = Vec2::Zero();     ///< how fast it was expected to move
  double square_sigmas = 0;         ///< of the residual; about 2 when all is well
};

struct Association {
  std::vector<AcceptedDot> accepted;
  int expected = 0;      ///< LEDs of tracked heads that are before this camera and in its picture
  bool widened = false;  ///< nothing fitted until the head was doubted
};

/// Moves all heads on to the time of capture and corrects them by the dots.
Association associate(const TimedDots& seen, const CameraModel& camera,
                      std::span<const std::vector<Vec3>> leds_of_heads, std::span<HeadTrack> heads,
                      const AssociationOptions& options = {});

}  // namespace vindu
