#include "tracker/thesis_hybrid.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

/// What one camera sees of each LED; null: not in its sight.
using RaysOfLeds = std::array<const Ray*, kLmrLeds>;
using Triple = std::array<TriangulatedPoint, kLmrLeds>;

/// Sorted from left to right, two dots may be any two of the LEDs.
std::vector<RaysOfLeds> labellings(std::span<const Ray> rays) {
  if (rays.size() == kLmrLeds) return {{&rays[0], &rays[1], &rays[2]}};
  if (rays.size() != 2) return {};
  return {
      {&rays[0], &rays[1], nullptr}, {&rays[0], nullptr, &rays[1]}, {nullptr, &rays[0], &rays[1]}};
}

/// One labelling of both cameras' dots.
struct Sighting {
  RaysOfLeds first, second;
  std::array<std::optional<TriangulatedPoint>, kLmrLeds> common;
};

/// Empty where the labels cannot be right.
std::optional<Sighting> sighting_of(const RaysOfLeds& first, const RaysOfLeds& second,
                                    double largest_gap_m) {
  Sighting sighting{first, second, {}};
  for (std::size_t led = 0; led < kLmrLeds; ++led) {
    if (!first[led] && !second[led]) return std::nullopt;
    if (!first[led] || !second[led]) continue;
    sighting.common[led] = triangulate(*first[led], *second[led]);
    if (!sighting.common[led] || sighting.common[led]->gap_m > largest_gap_m) return std::nullopt;
  }
  return sighting;
}

/// The places of a LED that one camera sees, around the LED `centre`.
std::vector<TriangulatedPoint> places_on_sphere(const Ray& ray, const Vec3& centre_in_room,
                                                double radius_m) {
  const SphereHits hits = hits_on_sphere(ray, centre_in_room, radius_m);
  const auto at = [&](double along_m) -> TriangulatedPoint {
    return {ray.origin_in_room + along_m * ray.direction_in_room, hits.expanded_m};
  };
  if (hits.near_m == hits.far_m) return {at(hits.near_m)};
  return {at(hits.near_m), at(hits.far_m)};
}

std::vector<Triple> completions(const Sighting& sighting, std::size_t centre,
                                const LmrPoints& lmr_in_head) {
  const Vec3 centre_in_room = sighting.common[centre]->x_in_room;
  std::vector<Triple> all(1);
  for (std::size_t led = 0; led < kLmrLeds; ++led) {
    std::vector<TriangulatedPoint> places;
    if (sighting.common[led])
      places = {*sighting.common[led]};
    else
      places = places_on_sphere(sighting.first[led] ? *sighting.first[led] : *sighting.second[led],
                                centre_in_room, (lmr_in_head[led] - lmr_in_head[centre]).norm());
    std::vector<Triple> longer;
    for (const Triple& begun : all)
      for (const TriangulatedPoint& place : places)
        longer.push_back(begun), longer.back()[led] = place;
    all = std::move(longer);
  }
  return all;
}

bool from_left_to_right(const Triple& points) {
  return points[0].x_in_room.x() < points[1].x_in_room.x() &&
         points[1].x_in_room.x() < points[2].x_in_room.x();
}

double misfit_of(const Triple& points, const LmrPoints& lmr_in_head) {
  double sum_m2 = 0;
  for (std::size_t a = 0; a < kLmrLeds; ++a) {
    const std::size_t b = (a + 1) % kLmrLeds;
    const double distance_m = (points[a].x_in_room - points[b].x_in_room).norm();
    const double error_m = distance_m - (lmr_in_head[a] - lmr_in_head[b]).norm();
    sum_m2 += error_m * error_m + points[a].gap_m * points[a].gap_m;
  }
  return std::sqrt(sum_m2);
}

/// How far the LEDs have moved, root mean square.
double step_m(const Triple& points, const LmrPoints& last_in_room) {
  double sum_m2 = 0;
  for (std::size_t led = 0; led < kLmrLeds; ++led)
    sum_m2 += (points[led].x_in_room - last_in_room[led]).squaredNorm();
  return std::sqrt(sum_m2 / kLmrLeds);
}

}  // namespace

LmrPoints HybridCandidate::lmr_in_room() const {
  return {points[0].x_in_room, points[1].x_in_room, points[2].x_in_room};
}

// With t the way to the point of the ray that is nearest to the centre, and h its distance from
// there, the hits are at t -+ sqrt(radius^2 - h^2).
SphereHits hits_on_sphere(const Ray& ray, const Vec3& centre_in_room, double radius_m) {
  const Vec3 way_m = centre_in_room - ray.origin_in_room;
  const double nearest_m = way_m.dot(ray.direction_in_room);
  const double aside_m = (way_m - nearest_m * ray.direction_in_room).norm();
  if (aside_m >= radius_m) return {nearest_m, nearest_m, aside_m - radius_m};
  const double half_chord_m = std::sqrt(radius_m * radius_m - aside_m * aside_m);
  return {nearest_m - half_chord_m, nearest_m + half_chord_m, 0};
}

std::vector<HybridCandidate> hybrid_candidates(std::span<const Ray> first,
                                               std::span<const Ray> second,
                                               const LmrPoints& lmr_in_head, double largest_gap_m) {
  std::vector<HybridCandidate> candidates;
  if (first.size() == kLmrLeds && second.size() == kLmrLeds) return candidates;
  for (const RaysOfLeds& of_first : labellings(first))
    for (const RaysOfLeds& of_second : labellings(second)) {
      const auto sighting = sighting_of(of_first, of_second, largest_gap_m);
      if (!sighting) continue;
      for (std::size_t centre = 0; centre < kLmrLeds; ++centre) {
        if (!sighting->common[centre]) continue;
        for (const Triple& points : completions(*sighting, centre, lmr_in_head))
          if (from_left_to_right(points))
            candidates.push_back({points, misfit_of(points, lmr_in_head)});
      }
    }
  return candidates;
}

std::optional<HybridCandidate> best_candidate(const std::vector<HybridCandidate>& candidates,
                                              const std::optional<LmrPoints>& last_in_room,
                                              const HybridLimits& limits) {
  const HybridCandidate* best = nullptr;
  double least_m = last_in_room ? limits.step_m : limits.misfit_m;
  for (const HybridCandidate& candidate : candidates) {
    const double cost_m =
        last_in_room ? step_m(candidate.points, *last_in_room) : candidate.misfit_m;
    if (candidate.misfit_m > limits.misfit_m || cost_m > least_m) continue;
    least_m = cost_m;
    best = &candidate;
  }
  if (!best) return std::nullopt;
  return *best;
}

}  // namespace vindu
