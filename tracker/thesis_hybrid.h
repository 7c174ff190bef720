// The thesis' hybrid tracking (3.2.2): a LED that both cameras see is triangulated, and each other
// one is where its ray, from the one camera that sees it, meets the sphere around that LED whose
// radius is their known distance. Which dot is which, which of two hits it is, and what becomes of
// a ray that misses, the thesis leaves open: docs/decisions/0002.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tracker/triangulation.h"

namespace vindu {

constexpr std::size_t kLmrLeds = 3;
/// Left, middle and right LED, in one frame.
using LmrPoints = std::array<Vec3, kLmrLeds>;

/// Along the ray, from its origin.
struct SphereHits {
  double near_m = 0, far_m = 0;  ///< equal where the ray but touches
  double expanded_m = 0;         ///< what the radius lacked: the sphere is expanded to be touched
};
SphereHits hits_on_sphere(const Ray& ray, const Vec3& centre_in_room, double radius_m);

struct HybridCandidate {
  /// gap_m of a point on a sphere: by how much the sphere was expanded.
  std::array<TriangulatedPoint, 3> points;
  /// Root of the sum of squares of the gaps and of the errors of the three distances; metres.
  double misfit_m = 0;

  LmrPoints lmr_in_room() const;
};

/// All that two or three dots of each camera can be, not three of both: rays from left to right,
/// any one LED left out where there are two, at least one in common, all three in sight of one or
/// the other, and found from left to right along room x. Empty where there is none.
std::vector<HybridCandidate> hybrid_candidates(std::span<const Ray> first,
                                               std::span<const Ray> second,
                                               const LmrPoints& lmr_in_head, double largest_gap_m);

struct HybridLimits {
  double misfit_m = 0;
  double step_m = 0;  ///< root mean square over the LEDs
};
/// Of those within the limits the nearest to where the LEDs were last; where that is not known, the
/// one of least misfit.
std::optional<HybridCandidate> best_candidate(const std::vector<HybridCandidate>& candidates,
                                              const std::optional<LmrPoints>& last_in_room,
                                              const HybridLimits& limits);

}  // namespace vindu
