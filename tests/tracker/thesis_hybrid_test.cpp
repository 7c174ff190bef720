// The thesis' hybrid tracking from dots without noise and without rounding: rays and spheres, which
// hit is taken, and poses where each camera sees two LEDs, or one of them all three.
#include "tracker/thesis_hybrid.h"

#include <gtest/gtest.h>

#include "tests/tracker/thesis_views.h"
#include "tracker/thesis_method.h"

namespace vindu {
namespace {

using Leds = std::vector<std::size_t>;

constexpr double kGap_m = 0.008;
constexpr HybridLimits kLimits{.misfit_m = 0.020, .step_m = 0.1};

std::vector<Ray> rays_of(const CameraConfig& camera, const Observation& seen) {
  std::vector<Ray> rays;
  for (const Dot& dot : seen.dots)
    rays.push_back(CameraModel(camera).ray_through({dot.x_px, dot.y_px}));
  return rays;
}

LmrPoints lmr_of(const HeadConfig& head, const Rigid3& room_from_head = {}) {
  return {room_from_head * head.leds_in_head[0], room_from_head * head.leds_in_head[1],
          room_from_head * head.leds_in_head[2]};
}

double farthest_m(const LmrPoints& a, const LmrPoints& b) {
  return std::max({(a[0] - b[0]).norm(), (a[1] - b[1]).norm(), (a[2] - b[2]).norm()});
}

std::vector<HybridCandidate> candidates_of(double aside_deg, const Rigid3& room_from_head,
                                           const Leds& first, const Leds& second) {
  const HeadConfig head;
  const auto cameras = cameras_aside(aside_deg);
  const auto rays = [&](int camera, const Leds& leds) {
    return rays_of(cameras[static_cast<std::size_t>(camera)],
                   perfect_view(cameras, camera, head, room_from_head, Time{}, leds));
  };
  return hybrid_candidates(rays(0, first), rays(1, second), lmr_of(head), kGap_m);
}

TEST(SphereHits, are_the_entry_and_the_exit) {
  const SphereHits hits = hits_on_sphere({{1, 2, 3}, Vec3::UnitX()}, {6, 2.3, 3.4}, 1.3);
  EXPECT_NEAR(hits.near_m, 5 - 1.2, 1e-12);
  EXPECT_NEAR(hits.far_m, 5 + 1.2, 1e-12);
  EXPECT_EQ(hits.expanded_m, 0);
}

TEST(SphereHits, of_a_ray_that_misses_are_its_nearest_point_on_the_sphere_expanded_to_there) {
  const SphereHits hits = hits_on_sphere({{1, 2, 3}, Vec3::UnitX()}, {6, 2.3, 3.4}, 0.45);
  EXPECT_NEAR(hits.near_m, 5, 1e-12);
  EXPECT_EQ(hits.near_m, hits.far_m);
  EXPECT_NEAR(hits.expanded_m, 0.05, 1e-12);
}

// As in the thesis' figure 3.5: the head hides each camera the LED of its other side.
TEST(ThesisHybrid, recovers_the_exact_pose_from_two_dots_of_each_camera) {
  const HeadConfig head;
  const auto cameras = cameras_aside(75);
  for (const double yaw_deg : {-10, 0, 10})
    for (const double roll_deg : {-8, 0, 8}) {
      const Rigid3 room_from_head{turned(yaw_deg, 5, roll_deg), {0.05, 1.75, 2.1}};
      ThesisMethod method(cameras, head);
      method.absorb(perfect_view(cameras, 0, head, room_from_head, Time{}, {1, 0}));
      method.absorb(perfect_view(cameras, 1, head, room_from_head, Time{}, {1, 2}));
      const ThesisResult result = method.track(Time{});
      ASSERT_TRUE(result.pose) << yaw_deg << ' ' << roll_deg;
      EXPECT_EQ(result.pose->level, TrackingLevel::hybrid);
      EXPECT_LT((result.pose->room_from_head.translation - room_from_head.translation).norm(),
                1e-6);
      EXPECT_LT(result.pose->room_from_head.rotation.angularDistance(room_from_head.rotation),
                1e-5);
      EXPECT_EQ(result.points.size(), 3u);
    }
}

TEST(ThesisHybrid, finds_the_leds_exactly_whichever_of_them_are_hidden) {
  const HeadConfig head;
  const Rigid3 room_from_head{turned(5, 4, 3), {0.05, 1.75, 2.1}};
  const LmrPoints truth = lmr_of(head, room_from_head);
  const Leds all = {0, 1, 2}, pairs[] = {{0, 1}, {0, 2}, {1, 2}};
  const auto expect_found = [&](const Leds& first, const Leds& second) {
    const auto found =
        best_candidate(candidates_of(18.4, room_from_head, first, second), truth, kLimits);
    ASSERT_TRUE(found);
    EXPECT_LT(farthest_m(found->lmr_in_room(), truth), 1e-6);
    EXPECT_LT(found->misfit_m, 1e-6);
  };
  for (const Leds& pair : pairs) {
    expect_found(all, pair);
    expect_found(pair, all);
    for (const Leds& other : pairs)
      if (other != pair) expect_found(pair, other);
  }
}

TEST(ThesisHybrid, needs_one_led_in_common_and_all_three_in_sight) {
  const Rigid3 room_from_head{Quat::Identity(), {0.05, 1.75, 2.1}};
  const auto best = [&](const Leds& first, const Leds& second) {
    return best_candidate(candidates_of(18.4, room_from_head, first, second),
                          lmr_of(HeadConfig{}, room_from_head), kLimits);
  };
  EXPECT_FALSE(best({0, 1}, {0, 1}));
  EXPECT_FALSE(best({0, 1}, {2}));
  EXPECT_FALSE(best({0, 1, 2}, {1}));
  EXPECT_FALSE(best({}, {0, 1, 2}));
  for (const Leds& second : {Leds{1}, Leds{0, 1, 2}, Leds{0, 1, 1, 2}})
    EXPECT_TRUE(candidates_of(18.4, room_from_head, {0, 1, 2}, second).empty());
}

TEST(ThesisHybrid, takes_the_hits_that_have_the_known_distance_from_each_other) {
  const HeadConfig head;
  const Rigid3 room_from_head{turned(2, 0, 0), {0.05, 1.75, 2.1}};
  const auto candidates = candidates_of(18.4, room_from_head, {0, 1}, {1, 2});
  ASSERT_GE(candidates.size(), 2u);  // the other hits are there
  const auto found = best_candidate(candidates, std::nullopt, kLimits);
  ASSERT_TRUE(found);
  EXPECT_LT(farthest_m(found->lmr_in_room(), lmr_of(head, room_from_head)), 1e-6);
}

HybridCandidate candidate_at(double x_m, double misfit_m) {
  const TriangulatedPoint point{{x_m, 0, 0}, 0};
  return {{point, point, point}, misfit_m};
}

TEST(ThesisHybrid, prefers_what_is_near_to_where_the_leds_were_of_all_that_fits) {
  const std::vector candidates = {candidate_at(0, 0.001), candidate_at(0.05, 0.015),
                                  candidate_at(0.1, 0.025)};
  const auto found_from = [&](const std::optional<LmrPoints>& last_in_room) {
    return best_candidate(candidates, last_in_room, kLimits);
  };
  const auto all_at = [](double x_m) -> LmrPoints {
    return {Vec3(x_m, 0, 0), Vec3(x_m, 0, 0), Vec3(x_m, 0, 0)};
  };
  EXPECT_EQ(found_from(std::nullopt)->points[0].x_in_room.x(), 0);
  EXPECT_EQ(found_from(all_at(0.1))->points[0].x_in_room.x(), 0.05);
  EXPECT_FALSE(found_from(all_at(0.2)));  // it has not leapt so far
  EXPECT_FALSE(best_candidate({candidate_at(0, 0.025)}, std::nullopt, kLimits));
}

// The left camera's ray to l is square to m - l: one pixel outwards, and it misses.
TEST(ThesisHybrid, expands_the_sphere_for_a_ray_that_misses_it) {
  const HeadConfig head;
  const auto cameras = cameras_aside(45);
  const Rigid3 room_from_head{Quat::Identity(), {0, 1.75, 2}};
  auto left = perfect_view(cameras, 0, head, room_from_head, Time{}, {0, 1});
  const auto right = perfect_view(cameras, 1, head, room_from_head, Time{}, {1, 2});
  left.dots[0].x_px -= 1;

  const auto found =
      best_candidate(hybrid_candidates(rays_of(cameras[0], left), rays_of(cameras[1], right),
                                       lmr_of(head), kGap_m),
                     std::nullopt, kLimits);

  ASSERT_TRUE(found);
  EXPECT_GT(found->points[0].gap_m, 0.001);
  EXPECT_LT(found->points[0].gap_m, 0.003);
  EXPECT_LT((found->points[0].x_in_room - lmr_of(head, room_from_head)[0]).norm(), 0.02);
  EXPECT_LT(found->points[1].gap_m, 1e-6);
}

}  // namespace
}  // namespace vindu
