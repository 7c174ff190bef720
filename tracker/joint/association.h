// What one report of one camera does to the heads that are tracked: which dot is which LED, by the
// filter's own expectation, and the correction by each dot that fits. No sorting, no equal counts;
// any dot may be false and any LED missing.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/site.h"
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

constexpr std::size_t kMaxLeds = 16;

/// A head, and whether it is tracked now.
struct HeadTrack {
  std::optional<HeadState> state;
  Time seen{};  ///< when the last dot of it was captured
  std::array<Time, kMaxCameras> seen_by{};
  std::array<Time, kMaxLeds> led_seen{};
  double surprise = 0;  ///< running mean of its dots' squared residuals in sigmas, less 2: as usual
};

struct AssociationOptions {
  double gate = 13.8;       ///< squared Mahalanobis distance: 99.9 % of two degrees of freedom
  double farthest_px = 20;  ///< from where it is expected, however uncertain that is
  /// A dot corrects nothing while another pairing of as many dots is that close to the best one, in
  /// the same measure: one in a hundred of such choices would be wrong, and stay so.
  double clear_by = 9;
  /// So many LEDs tell of one camera where a head is: four, by one pose alone; three, by one of a
  /// few, where there is no other camera.
  std::ptrdiff_t leds_that_place = 4;
  /// Of what nobody has seen for so long, the motion dies out with this time constant: of all, when
  /// less than two cameras saw the head, or of one fewer LEDs; of its turning, when less than two
  /// LEDs were seen.
  Duration coasts_after = std::chrono::milliseconds(80);
  Duration damping = std::chrono::milliseconds(150);
  /// Unseen for longer, or known no better than so, a head is lost.
  Duration lost_after = std::chrono::milliseconds(250);
  double lost_at_m = 0.20;
  /// Factor on the sigma of dots while what is seen does not place a head, or is two LEDs:
  /// what rounding and the LEDs' places leave wrong does not average out, and more hangs on it.
  double weak = 3;
  /// In place of the noise of motion where it is not placed: a head may walk along the ray of the
  /// only camera that sees it.
  double alone_m2_s5 = 3;
  /// A head that surprises though it is well seen is accelerating: what noise is added for each
  /// unit of surprise beyond the usual, squared.
  double usual_surprise = 1.5;
  double most_surprise = 3.5;
  double move_by_surprise_m2_s5 = 6, turn_by_surprise_rad2_s5 = 24;
  double lost_at_rad = radians(100);
  std::optional<MotionNoise> fixed_noise = {};  ///< in place of that which goes with the motion
  bool turns = true;                            ///< false: the rotation is given, not estimated
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

/// A dot that may be an LED's, and where all cameras together expect that; raw pixels.
struct MisfitDot {
  Vec2 expected_px;
  Vec2 residual_px;  ///< from there
};

struct Association {
  std::vector<AcceptedDot> accepted = {};
  std::vector<MisfitDot> aside = {};      ///< a little too far off to be accepted
  std::array<bool, kMaxDots> disputed{};  ///< dots that may as well be another LED's: none's
  bool widened = false;                   ///< nothing fitted until the head was doubted
};

/// Moves all heads on to the time of capture and corrects them by the dots.
Association associate(const TimedDots& seen, const CameraModel& camera,
                      std::span<const std::vector<Vec3>> leds_of_heads, std::span<HeadTrack> heads,
                      const AssociationOptions& options = {});

}  // namespace vindu
