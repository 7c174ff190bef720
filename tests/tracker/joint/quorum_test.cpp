// Which of several cameras stands aside: from dots of a walking head of which one camera's, or
// two's, are all shifted alike, as when it was turned.
#include "tracker/joint/quorum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/tracker/joint/scene.h"

namespace vindu {
namespace {

using namespace test;

using Shifts = std::vector<Vec2>;  // of each camera, raw pixels

Rigid3 walking_head(double t) {
  return {rotation_of({0.1 * std::sin(t), 0.35 * std::sin(0.9 * t), 0.05 * std::sin(1.7 * t)}),
          {0.4 * std::sin(0.5 * t), 1.65 + 0.05 * std::sin(2 * t), 2 + 0.3 * std::sin(0.7 * t)}};
}

/// Twenty times a second, from one time to another; the head believed to be where it is but for
/// `off_m` along z.
void watch(Quorum& quorum, const std::vector<CameraModel>& cameras, const Shifts& shifts_px,
           double from_s, double to_s, double size = 1, double off_m = 0,
           const std::vector<Vec3>& leds_in_head = kThreeLeds) {
  Random random(7);
  std::vector<Vec3> leds = leds_in_head;
  for (Vec3& led : leds) led *= size;
  for (double t = from_s; t < to_s; t += 0.05) {
    Rigid3 believed = walking_head(t);
    believed.translation.z() += off_m;
    std::vector<Glimpse> glimpses;
    for (CameraView& view : views_of(cameras, walking_head(t), leds, 0.4, random)) {
      for (Vec2& dot_px : view.dots_px) dot_px += shifts_px[static_cast<std::size_t>(view.camera)];
      glimpses.push_back({view.camera, believed, view.dots_px, view.sigma_px});
    }
    quorum.note(cameras, leds_in_head, glimpses);
  }
}

void expect_aside(const Quorum& quorum, const Shifts& shifts_px) {
  for (std::size_t camera = 0; camera < shifts_px.size(); ++camera) {
    EXPECT_LT((quorum.aside_px(camera) - shifts_px[camera]).norm(), 0.6)
        << "camera " << camera << " by " << quorum.aside_px(camera).transpose();
    EXPECT_NEAR(quorum.doubt_px(camera), shifts_px[camera].norm(), 0.6);
  }
  EXPECT_EQ(quorum.undecided_px(), 0);
}

/// To the side only the head's size tells which one it was.
TEST(Quorum, names_the_one_of_three_cameras_that_stands_aside) {
  const auto cameras = cameras_behind(3);
  for (std::size_t camera = 0; camera < 3; ++camera)
    for (const Vec2& shift_px : {Vec2(17, 0), Vec2(-17, 0), Vec2(0, 4), Vec2(9, 9)}) {
      Shifts shifts_px(3, Vec2::Zero());
      shifts_px[camera] = shift_px;
      Quorum quorum(3);
      watch(quorum, cameras, shifts_px, 0, 4);
      expect_aside(quorum, shifts_px);
    }
}

TEST(Quorum, names_nobody_where_all_agree) {
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), Shifts(3, Vec2::Zero()), 0, 4);
  EXPECT_TRUE(quorum.knows(0) && quorum.knows(1) && quorum.knows(2));
  expect_aside(quorum, Shifts(3, Vec2::Zero()));
}

TEST(Quorum, takes_back_what_it_said_when_asked) {
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), {{0, 17}, {0, 0}, {0, 0}}, 0, 4);
  EXPECT_GT(quorum.doubt_px(0), 16);
  quorum.forgive();
  expect_aside(quorum, Shifts(3, Vec2::Zero()));
}

TEST(Quorum, names_two_of_four) {
  const Shifts shifts_px = {{0, 12}, {0, 0}, {0, 0}, {20, -6}};
  Quorum quorum(4);
  watch(quorum, cameras_behind(4), shifts_px, 0, 6);
  expect_aside(quorum, shifts_px);
}

TEST(Quorum, names_one_of_sixteen_by_four_leds) {
  Shifts shifts_px(16, Vec2::Zero());
  shifts_px[5] = {17, 0};
  Quorum quorum(16);
  watch(quorum, cameras_behind(16), Shifts(16, Vec2::Zero()), 0, 2, 1, 0, kFourLeds);
  watch(quorum, cameras_behind(16), shifts_px, 2, 6, 1, 0, kFourLeds);
  expect_aside(quorum, shifts_px);
}

/// How they turn about their line shows nowhere.
TEST(Quorum, does_with_two_leds) {
  const Shifts shifts_px = {{0, 0}, {0, 12}, {0, 0}};
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), shifts_px, 0, 4, 1, 0, {{-0.09, 0, 0}, {0.09, 0, 0}});
  expect_aside(quorum, shifts_px);
}

TEST(Quorum, knows_within_two_seconds_of_a_bump_and_of_its_end) {
  const auto cameras = cameras_behind(3);
  const Shifts none(3, Vec2::Zero()), bumped = {{0, 0}, {17, 0}, {0, 0}};
  Quorum quorum(3);
  watch(quorum, cameras, none, 0, 4);
  watch(quorum, cameras, bumped, 4, 6);
  expect_aside(quorum, bumped);
  watch(quorum, cameras, none, 6, 8);
  expect_aside(quorum, none);
}

TEST(Quorum, is_not_misled_by_a_head_that_is_believed_elsewhere) {
  const Shifts shifts_px = {{0, 0}, {0, 0}, {17, 0}};
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), shifts_px, 0, 4, 1, 0.06);
  expect_aside(quorum, shifts_px);
}

TEST(Quorum, takes_leds_that_are_measured_a_little_wrong_for_that) {
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), Shifts(3, Vec2::Zero()), 0, 4, 1.01);
  expect_aside(quorum, Shifts(3, Vec2::Zero()));
}

/// Three pixels to the side change the head's size by less than it is known.
TEST(Quorum, doubts_all_whose_turn_would_explain_it) {
  Quorum quorum(3);
  watch(quorum, cameras_behind(3), {{0, 0}, {3, 0}, {0, 0}}, 0, 4);
  for (const std::size_t camera : {0u, 1u, 2u}) {
    EXPECT_EQ(quorum.aside_px(camera).norm(), 0);
    EXPECT_GT(quorum.doubt_px(camera), 0.5);
  }
  EXPECT_NEAR(quorum.undecided_px(), 3, 0.5);
}

TEST(Quorum, knows_nothing_of_a_camera_whose_dots_look_like_no_head) {
  const auto cameras = cameras_behind(3);
  Quorum quorum(3);
  watch(quorum, cameras, Shifts(3, Vec2::Zero()), 0, 2);
  EXPECT_TRUE(quorum.knows(2));
  watch(quorum, cameras, {{0, 0}, {0, 0}, {200, 0}}, 2, 8);
  EXPECT_FALSE(quorum.knows(2));
  EXPECT_TRUE(quorum.knows(0));
}

const std::vector<Vec2> kExpected_px = {{400, 300}, {440, 310}, {480, 300}};

TEST(LabelsAside, are_by_shape_whatever_the_shift) {
  std::vector<Vec2> dots_px = {{480, 300}, {400, 300}, {440, 310}, {700, 500}};
  for (Vec2& dot_px : dots_px) dot_px += Vec2(35, -20);
  EXPECT_EQ(labels_aside(kExpected_px, dots_px), (std::vector{2, 0, 1, -1}));
}

TEST(LabelsAside, are_none_where_the_shape_is_another_or_too_little_is_seen) {
  EXPECT_TRUE(
      labels_aside(kExpected_px, std::vector<Vec2>{{400, 300}, {440, 290}, {480, 300}}).empty());
  EXPECT_TRUE(labels_aside(kExpected_px, std::vector<Vec2>{{400, 300}, {440, 310}}).empty());
  EXPECT_TRUE(labels_aside(kExpected_px, std::vector<Vec2>{}).empty());
}

TEST(LabelsAside, are_none_where_two_are_as_good) {
  const std::vector<Vec2> twice_px = {{410, 300}, {450, 310}, {490, 300},
                                      {380, 320}, {420, 330}, {460, 320}};
  EXPECT_TRUE(labels_aside(kExpected_px, twice_px).empty());
}

}  // namespace
}  // namespace vindu
