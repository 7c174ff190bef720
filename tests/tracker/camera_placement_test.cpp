// The proposal of camera places: as good as trying all, better with more cameras, the same each
// time.
#include "tracker/camera_placement.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace vindu {
namespace {

using ::testing::SizeIs;

const HeadConfig kHead = {
    .leds_in_head = {{-0.09, 0, 0}, {0.09, 0.02, 0}, {0.02, 0.09, -0.04}, {0, -0.03, 0.07}},
    .eye_in_head = {0, -0.06, -0.08}};

/// LEDs of the back of the head: seen from behind only.
std::optional<double> seen_from_behind(std::size_t, const Vec3& viewer_in_head) {
  return viewer_in_head.z() > 0.5 ? std::optional(0.5) : std::nullopt;
}

PlacementTask task_of_a_room() {
  PlacementTask task;
  task.head = kHead;
  for (const double x_m : {-1.8, -0.9, 0.0, 0.9, 1.8})
    for (const double z_m : {1.0, 1.75, 2.5})
      for (const double yaw_deg : {-30.0, 0.0, 30.0})
        task.poses.push_back(head_at({x_m, 1.65, z_m}, radians(yaw_deg), kHead));
  task.rails = {{{-2, 2.3, 4}, {2, 2.3, 4}}, {{-2, 2.6, 0}, {-2, 2.6, 0}}};
  for (const double x_m : {-1.0, 0.0, 1.0})
    for (const double z_m : {1.4, 2.2}) task.aims_in_room.emplace_back(x_m, 1.65, z_m);
  task.spacing_m = 0.8;
  return task;
}

double mean_worth(const PlacementTask& task, const std::vector<CameraConfig>& cameras) {
  double sum = 0;
  for (const PoseBound& bound : survey(cameras, task.head, seen_from_behind, task.poses))
    sum += worth(bound, task.good_eye_m);
  return sum / static_cast<double>(task.poses.size());
}

double covered_share(const PlacementTask& task, const std::vector<CameraConfig>& cameras) {
  double sum = 0;
  for (const PoseBound& bound : survey(cameras, task.head, seen_from_behind, task.poses))
    sum += covered(bound, task.good_eye_m);
  return sum / static_cast<double>(task.poses.size());
}

std::vector<CameraConfig> all_candidates(const PlacementTask& task) {
  std::vector<CameraConfig> all;
  for (const Rail& rail : task.rails)
    for (int step = 0; step <= 5; ++step)
      for (const Vec3& aim : task.aims_in_room) {
        CameraConfig camera = task.camera;
        camera.room_from_camera =
            look_at(rail.from_in_room + step / 5.0 * (rail.to_in_room - rail.from_in_room), aim);
        all.push_back(camera);
      }
  return all;
}

TEST(CameraPlacement, TwoCamerasAreAsGoodAsTheBestOfAllPairs) {
  const PlacementTask task = task_of_a_room();
  const std::vector<CameraConfig> all = all_candidates(task);
  double best = 0;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      best = std::max(best, mean_worth(task, {all[a], all[b]}));
  const double found = mean_worth(task, place_cameras(task, 2, seen_from_behind));
  std::printf("worth %.4f, of the best pair on the grid %.4f\n", found, best);
  EXPECT_GE(found, best - 0.01);
}

TEST(CameraPlacement, MoreCamerasCoverMore) {
  const PlacementTask task = task_of_a_room();
  const double two = covered_share(task, place_cameras(task, 2, seen_from_behind));
  const double four = covered_share(task, place_cameras(task, 4, seen_from_behind));
  EXPECT_GT(two, 0.1);
  EXPECT_GT(four, two + 0.1);
}

TEST(CameraPlacement, IsTheSameEachTimeAndStaysOnTheRails) {
  const PlacementTask task = task_of_a_room();
  const auto once = place_cameras(task, 3, seen_from_behind);
  const auto again = place_cameras(task, 3, seen_from_behind);
  ASSERT_THAT(once, SizeIs(3));
  for (std::size_t i = 0; i < once.size(); ++i) {
    const Vec3 place = once[i].room_from_camera.translation;
    EXPECT_EQ(place, again[i].room_from_camera.translation);
    EXPECT_EQ(once[i].name, "plan-" + std::to_string(i + 1));
    EXPECT_TRUE((place.z() == 4 && place.y() == 2.3 && std::abs(place.x()) <= 2) ||
                place == Vec3(-2, 2.6, 0))
        << place.transpose();
  }
}

TEST(CameraPlacement, TellsHowFarItIs) {
  std::vector<double> told;
  place_cameras(task_of_a_room(), 2, seen_from_behind,
                [&](double share) { told.push_back(share); });
  ASSERT_GE(told.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1);
}

TEST(CameraPlacement, RefusesToMountACameraWhereItShouldLook) {
  PlacementTask task = task_of_a_room();
  task.rails = {{{0, 1.65, 2}, {0, 1.65, 2}}};
  task.aims_in_room = {{0, 1.65, 2}};
  EXPECT_THROW(place_cameras(task, 2, seen_from_behind), Error);
}

TEST(CameraPlacement, RefusesARoomWithoutPlaces) {
  PlacementTask task = task_of_a_room();
  task.rails.clear();
  EXPECT_THROW(place_cameras(task, 2, seen_from_behind), Error);
  task = task_of_a_room();
  task.poses.clear();
  EXPECT_THROW(place_cameras(task, 2, seen_from_behind), Error);
}

}  // namespace
}  // namespace vindu
