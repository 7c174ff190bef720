// Assignment, and finding a head that nobody knew of.
#include "tracker/joint/acquisition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "tests/tracker/joint/scene.h"
#include "tracker/joint/assignment.h"
#include "tracker/joint/candidates.h"

namespace vindu {
namespace {

using namespace test;

/// The least sum over all ways to pair rows and columns, by trying them.
double least_cost(const CostMatrix& costs, double none, Eigen::Index row = 0, unsigned taken = 0) {
  if (row == costs.rows()) return 0;
  double best = none + least_cost(costs, none, row + 1, taken);
  for (Eigen::Index column = 0; column < costs.cols(); ++column)
    if (!(taken >> column & 1) && costs(row, column) < none)
      best = std::min(best,
                      costs(row, column) + least_cost(costs, none, row + 1, taken | 1u << column));
  return best;
}

TEST(Assignment, is_the_best_there_is) {
  Random random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const auto rows = static_cast<Eigen::Index>(random.uniform(0, 6));
    const auto columns = static_cast<Eigen::Index>(random.uniform(0, 6));
    CostMatrix costs(rows, columns);
    for (double& cost : costs.reshaped()) cost = random.uniform(0, 20);
    const auto assigned = assign(costs, 12);
    double sum = 0;
    std::vector<int> used;
    for (Eigen::Index row = 0; row < rows; ++row) {
      const int column = assigned[static_cast<std::size_t>(row)];
      sum += column < 0 ? 12 : costs(row, column);
      if (column >= 0) used.push_back(column);
    }
    std::ranges::sort(used);
    EXPECT_EQ(std::ranges::adjacent_find(used), used.end());
    EXPECT_NEAR(sum, least_cost(costs, 12), 1e-9);
  }
}

struct Share {
  int right = 0, wrong = 0, none = 0;
};

/// Single frames with the dots of each view shuffled.
Share labelled(const std::vector<Vec3>& leds, int cameras_count, double noise_px, int heads,
               int false_dots = 0) {
  const auto cameras = cameras_behind(cameras_count);
  Random random(7);
  std::mt19937 shuffler(3);
  Share share;
  for (int i = 0; i < heads; ++i) {
    const Rigid3 head = random_head(random, radians(35), radians(30));
    auto views = views_of(cameras, head, leds, noise_px, random);
    for (CameraView& view : views) {
      for (int extra = 0; extra < false_dots; ++extra)
        view.dots_px.emplace_back(random.uniform(0, 1023), random.uniform(0, 767));
      std::ranges::shuffle(view.dots_px, shuffler);
    }
    const auto found = find_head(cameras, views, leds);
    if (!found)
      ++share.none;
    else if ((found->fit.room_from_head.translation - head.translation).norm() < 0.05 &&
             angle_deg(found->fit.room_from_head, head) < 15)
      ++share.right;
    else
      ++share.wrong;
  }
  return share;
}

TEST(FindHead, labels_the_thesis_helmet_from_one_frame_of_two_cameras) {
  const Share share = labelled(kThreeLeds, 2, 0.5, 500);
  EXPECT_EQ(share.wrong, 0);
  EXPECT_GE(share.right, 490);
}

TEST(FindHead, labels_four_leds_amid_two_false_dots_in_each_camera) {
  const Share share = labelled(kFourLeds, 2, 0.5, 300, 2);
  EXPECT_EQ(share.wrong, 0);
  EXPECT_GE(share.right, 290);
}

TEST(FindHead, labels_four_leds_from_one_camera_or_says_nothing) {
  const Share share = labelled(kFourLeds, 1, 0.3, 200);
  EXPECT_LE(share.wrong, 2);
  EXPECT_GE(share.right, 120);
}

/// Where two solutions of P3P nearly meet, noise leaves it none.
TEST(FindHead, knows_of_one_camera_and_three_leds_the_pose_that_faces_the_wall) {
  const auto cameras = cameras_behind(1);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Rigid3 head = random_head(random, radians(25), radians(12));
    const auto views = views_of(cameras, head, kThreeLeds, 0.5, random);
    const auto found = find_head(cameras, views, kThreeLeds, {.least_margin = 0});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->led_of_dot[0], (std::vector{0, 1, 2})) << i;
    EXPECT_LT((found->fit.room_from_head.translation - head.translation).norm(), 0.12);
    EXPECT_LT(angle_deg(found->fit.room_from_head, head), 5);
  }
}

TEST(FindHead, works_for_sixteen_cameras) {
  const Share share = labelled(kThreeLeds, 16, 0.5, 20);
  EXPECT_EQ(share.right, 20);
}

TEST(FindHead, does_with_two_leds_that_both_see_and_a_third_that_one_sees) {
  const auto cameras = cameras_behind(2);
  Random random(8);
  const Rigid3 head = random_head(random, radians(10), radians(5));
  auto views = views_of(cameras, head, kThreeLeds, 0.3, random);
  views[1].dots_px.erase(views[1].dots_px.begin());
  const auto found = find_head(cameras, views, kThreeLeds);
  ASSERT_TRUE(found);
  EXPECT_LT((found->fit.room_from_head.translation - head.translation).norm(), 0.02);
  EXPECT_EQ(found->led_of_dot[1], (std::vector<int>{1, 2}));
}

/// What is left open, the turn about the line through them, the prior decides.
/// One of the two under weak perspective, whatever the noise.
TEST(Candidates, of_three_dots_of_one_camera_are_near_the_head) {
  const auto cameras = cameras_behind(1);
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    const Rigid3 head = random_head(random, radians(60), radians(25));
    const auto views = views_of(cameras, head, kThreeLeds, 0.5, random);
    auto next = candidates_from_one(cameras, views[0], kThreeLeds, radians(120));
    double nearest_m = 1e9, nearest_deg = 180;
    while (const auto poses = next())
      for (const Rigid3& pose : *poses) {
        if (angle_deg(pose, head) > nearest_deg) continue;
        nearest_deg = angle_deg(pose, head);
        nearest_m = (pose.translation - head.translation).norm();
      }
    EXPECT_LT(nearest_deg, 20) << i;
    EXPECT_LT(nearest_m, 0.3) << i;
  }
}

/// From the left camera the middle LED and the right one stand nearly in one direction; the right
/// camera sees the left one alone, at the edge of its picture.
TEST(FindHead, overlooks_no_labelling_where_two_leds_stand_behind_each_other) {
  const auto cameras = cameras_behind(2);
  const Vec3 inverse = kFacingSigma_rad.cwiseInverse();
  PosePrior facing;
  facing.information.diagonal().tail<3>() = inverse.cwiseProduct(inverse);
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Quat turn = Eigen::AngleAxisd(radians(random.uniform(12, 16)), Vec3::UnitY()) *
                      Eigen::AngleAxisd(radians(random.uniform(-8, 0)), Vec3::UnitX());
    const Rigid3 head = {turn, {random.uniform(1.2, 1.28), random.uniform(1.7, 1.85), 2.0}};
    auto views = views_of(cameras, head, kThreeLeds, 0.5, random);
    views[1].dots_px.resize(1);
    auto sightings = sightings_of({views[0]}, kThreeLeds, views[0].sigma_px);
    sightings.push_back({1, kThreeLeds[0], views[1].dots_px[0], views[1].sigma_px});
    const auto truth = fit_pose(cameras, sightings, head, facing);
    const AcquisitionOptions options = {.least_margin = 0, .least_dots = 4};
    const auto found = find_head(cameras, views, kThreeLeds, options);
    ASSERT_TRUE(found) << i;
    EXPECT_LT(found->cost, truth->cost + 2 * options.missing_led_cost + 0.01) << i;
  }
}

/// Two dots in each camera, that may as well be two other LEDs for all that is known of a third of
/// these heads: those are not found.
TEST(FindHead, finds_a_turned_head_by_two_leds_or_nobody) {
  const auto cameras = cameras_behind(2);
  Random random(10);
  int right = 0, wrong = 0;
  for (int i = 0; i < 300; ++i) {
    Rigid3 head = random_head(random);
    head.rotation = Quat(Eigen::AngleAxisd(radians(60), Vec3::UnitY()));
    auto views = views_of(cameras, head, kFourLeds, 0.3, random);
    for (CameraView& view : views) view.dots_px.resize(2);
    const auto found = find_head(cameras, views, kFourLeds);
    if (!found) continue;
    const double off_m = (found->fit.room_from_head * kFourLeds[0] - head * kFourLeds[0]).norm();
    ++(off_m < 0.03 ? right : wrong);
  }
  std::printf("  right in %d of 300, wrong in %d\n", right, wrong);
  EXPECT_GE(right, 80);
  EXPECT_EQ(wrong, 0);
}

// A second look, with other false dots, is the tracker's remedy for the rest.
TEST(FindHead, hardly_ever_finds_somebody_in_false_dots) {
  const auto cameras = cameras_behind(2);
  Random random(9);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<CameraView> views(2);
    for (int camera = 0; camera < 2; ++camera) {
      views[static_cast<std::size_t>(camera)].camera = camera;
      for (int dot = 0; dot < 4; ++dot)
        views[static_cast<std::size_t>(camera)].dots_px.emplace_back(random.uniform(0, 1023),
                                                                     random.uniform(0, 767));
    }
    found += find_head(cameras, views, kThreeLeds, {.least_dots = 4}).has_value();
  }
  EXPECT_LE(found, 12);  // of 300
}

/// Few dots of a head that is turned away from the wall, beside a lamp.
TEST(FindHead, hardly_ever_takes_the_dots_of_one_who_turns_away_for_another_pose) {
  const auto cameras = cameras_behind(2);
  Random random(13);
  int wrong = 0, wrong_beside_the_tracked = 0;
  for (int i = 0; i < 300; ++i) {
    Rigid3 head = random_head(random);
    head.rotation = Quat(Eigen::AngleAxisd(radians(95), Vec3::UnitY())) * head.rotation;
    auto views = views_of(cameras, head, kThreeLeds, 0.5, random);
    views[0].dots_px.resize(2);
    views[0].dots_px.emplace_back(500, 300);  // a lamp that both see
    views[1].dots_px.resize(2);
    const auto elsewhere = [&](const std::optional<FoundHead>& found) {
      return found && !found->believed &&
             (found->fit.room_from_head.translation - head.translation).norm() > 0.06;
    };
    wrong += elsewhere(find_head(cameras, views, kThreeLeds));
    wrong_beside_the_tracked +=
        elsewhere(find_head(cameras, views, kThreeLeds, {.believed = head}));
  }
  std::printf("  of 300: %d wrong, %d beside what is tracked\n", wrong, wrong_beside_the_tracked);
  EXPECT_LE(wrong, 4);
  EXPECT_LE(wrong_beside_the_tracked, 2);
}

TEST(HeadSearch, says_where_dots_speak_for_another_pose_than_the_believed_one) {
  const auto cameras = cameras_behind(2);
  Random random(17);
  const Rigid3 head = random_head(random);
  const auto beaten = [&](const Rigid3& believed, std::size_t dots) {
    auto views = views_of(cameras, head, kThreeLeds, 0.5, random);
    for (CameraView& view : views) view.dots_px.resize(dots);
    HeadSearch search(cameras, std::move(views), kThreeLeds, {.believed = believed});
    search.advance(search.steps());
    return search.believed_is_beaten();
  };
  const Rigid3 aside = {head.rotation, head.translation + Vec3(0.2, 0, 0)};
  const Rigid3 one_led_on = {head.rotation, head * kThreeLeds[1] - head.rotation * kThreeLeds[0]};
  EXPECT_FALSE(beaten(head, 3));
  EXPECT_TRUE(beaten(aside, 3));
  EXPECT_TRUE(beaten(one_led_on, 3));
  EXPECT_FALSE(beaten(head, 2));
  EXPECT_FALSE(beaten(aside, 0));  // by nothing
}

TEST(FindHead, finds_nobody_where_nothing_is_seen) {
  const auto cameras = cameras_behind(2);
  EXPECT_FALSE(find_head(cameras, {}, kThreeLeds));
  EXPECT_FALSE(find_head(cameras, std::vector<CameraView>(2), kThreeLeds));
}

}  // namespace
}  // namespace vindu
