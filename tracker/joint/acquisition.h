// Finding a head without knowing where it was: which dot of which camera is which LED, and the pose
// that follows. Nothing is sorted; candidates come from geometry, are completed with all dots of
// all cameras, and compete. What a symmetric layout leaves open, the prior decides: heads are
// upright and, by and large, face the wall.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tracker/joint/pose_fit.h"

namespace vindu {

/// The dots of one camera that may be LEDs; at most 16.
struct CameraView {
  int camera = 0;
  std::vector<Vec2> dots_px;  ///< raw
  double sigma_px = 0.6;      ///< of each dot, with what the head may have moved since the others'
};

struct AcquisitionOptions {
  Vec3 facing_sigma_rad = kFacingSigma_rad;
  double false_dot_cost = 16;   ///< of a dot that is no LED, in sigmas squared
  double missing_led_cost = 3;  ///< of an LED that a camera should see and does not
  double least_margin = 12;     ///< by which the best beats a rival that is elsewhere
  double largest_rms_px = 2.5;
  std::size_t least_dots = 3;
  TrackingLevel least_level = TrackingLevel::hybrid;  ///< that the dots alone must reach
  std::optional<Rigid3> believed = {};                ///< where it is tracked: competes as it is
  std::size_t candidates_kept = 16;                   ///< of each pair of cameras, to be fitted
  bool from_one = true;                               ///< where these do not do, of one camera
};

/// So many do not agree on a pose by chance.
constexpr std::ptrdiff_t kManyDots = 6;

struct FoundHead {
  PoseFit fit;  ///< without the prior, where the dots alone fix the pose
  TrackingLevel level = TrackingLevel::lost;
  std::vector<std::vector<int>> led_of_dot;  ///< for each view, for each dot: its LED or -1
  double cost = 0;                           ///< the lower the better
  double margin = 0;                         ///< over the best rival; infinite without one
  bool believed = false;                     ///< what was tracked: there is nothing better

  std::ptrdiff_t dots() const;
  /// Whether a view has dots of it, and how many do.
  bool seen_in(std::size_t view) const;
  std::ptrdiff_t cameras() const;
  /// Whether they are as far off as noise is.
  bool fits_closely() const;
};

/// A look for a head that may be spread over time, in steps: rough poses are made, for two cameras
/// at a time, and considered one after the other.
class HeadSearch {
 public:
  /// The cameras must outlive it.
  HeadSearch(std::span<const CameraModel> cameras, std::vector<CameraView> views,
             std::vector<Vec3> leds_in_head, const AcquisitionOptions& options = {});
  ~HeadSearch();
  HeadSearch(HeadSearch&&) noexcept;
  HeadSearch& operator=(HeadSearch&&) noexcept;

  /// How many there are at most.
  std::size_t steps() const;

  /// Goes so many steps on. True when there are no others.
  bool advance(std::size_t most);

  /// In the end. Empty when there is no candidate, or two are too close to choose.
  std::optional<FoundHead> winner() const;

  /// In the end. Whether another pose is better than what was believed, by the margin, though a
  /// third one may be nearly as good.
  bool believed_is_beaten() const;

  /// The best so far, however close another one comes.
  std::optional<Rigid3> leading() const;

  const std::vector<CameraView>& views() const;

 private:
  class Contest;
  std::unique_ptr<Contest> contest_;
};

/// The whole of it at once.
std::optional<FoundHead> find_head(std::span<const CameraModel> cameras,
                                   std::span<const CameraView> views,
                                   std::span<const Vec3> leds_in_head,
                                   const AcquisitionOptions& options = {});

}  // namespace vindu
