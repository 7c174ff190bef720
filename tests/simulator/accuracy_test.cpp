// The accuracy that is asked of the tracker, on a few geometries and motions and with fewer poses
// than `vindu measure accuracy` has; the margins hold over seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/motions.h"
#include "simulator/moving_study.h"
#include "simulator/single_frame.h"
#include "simulator/trial.h"
#include "tracker/wiimote/emulator_link.h"

namespace vindu {
namespace {

struct Geometry {
  CameraRow row;
  HeadConfig head;
  int poses = 0;
};

TEST(SingleFrame, ComesWithin15PercentOfTheBoundAndNoNearerThanPossible) {
  const Geometry geometries[] = {
      {{3, 2, 2}, {}, 1000}, {{5, 1, 2}, four_led_head(), 700}, {{3, 2, 4}, four_led_head(), 300}};
  for (const auto& [row, head, poses] : geometries) {
    const FrameStudy study = study_frames({.row = row, .head = head, .poses = poses});
    EXPECT_EQ(study.poses, poses);
    EXPECT_LE(study.joint.eye_m, 1.15 * study.bound.eye_m);
    EXPECT_GE(study.joint.eye_m, 0.9 * study.bound.eye_m);
    EXPECT_LE(study.joint.rotation_rad, 1.15 * study.bound.rotation_rad);
    EXPECT_GE(study.joint.found, 0.99);
    EXPECT_LE(study.joint.wrong, 0.005);
  }
}

TEST(SingleFrame, HasSixTenthsOfTheThesisErrorAtMost) {
  const FrameStudy study = study_frames({.row = {3, 2, 2}, .head = {}, .poses = 1000});
  ASSERT_TRUE(study.joint_over_thesis);
  EXPECT_LE(*study.joint_over_thesis, 0.6);
  EXPECT_GE(study.thesis->found, 0.9);
}

TEST(SingleFrame, OneDotInASecondCameraBringsTheDepth) {
  const auto depth_m = [](int dots) {
    return study_frames({.row = {}, .head = four_led_head(), .poses = 300, .dots_of_last = dots})
        .joint.depth_m;
  };
  EXPECT_LE(depth_m(1), 0.25 * depth_m(0));
}

TEST(SingleFrame, OfPartialSightIsHybridOrPositionAloneForTheThesisMethod) {
  const auto by_thesis = [](int dots) {
    return *study_frames({.row = {}, .head = {}, .poses = 200, .dots_of_last = dots}).thesis;
  };
  EXPECT_EQ(by_thesis(0).found, 0);
  const FrameErrors one = by_thesis(1), two = by_thesis(2);
  EXPECT_GT(one.found, 0.8);
  EXPECT_EQ(one.levels[2], one.found);
  EXPECT_GT(two.levels[1], 0.8);
  EXPECT_EQ(two.levels[0], 0);
  EXPECT_NEAR(two.levels[1] + two.levels[2], two.found, 1e-9);
}

MovingStudyOptions moving(HeadMoves moves, Link link, const HeadConfig& head) {
  MovingStudyOptions options;
  options.moves = moves;
  options.link = link;
  options.head = head;
  options.length_s = 8;
  return options;
}

TEST(MovingHead, IsKnownTo1500MicrometresWhenStill) {
  const MovingStudy study = study_moving(moving(HeadMoves::still, Link::bursts, four_led_head()));
  EXPECT_EQ(study.joint.found, 1);
  EXPECT_LE(study.joint.eye_rms_m, 0.0015);
}

TEST(MovingHead, HasAFifthOfTheThesisErrorAndNoMoreThanTheBestFixedNoise) {
  const MovingStudy study = study_moving(moving(HeadMoves::sways, Link::bursts, {}));
  ASSERT_TRUE(study.thesis);
  EXPECT_LE(study.joint.eye_rms_m, 0.2 * study.thesis->six_dof.eye_rms_m);
  EXPECT_LE(study.joint.eye_rms_m, 1.2 * study.best_fixed.eye_rms_m);
  EXPECT_GE(study.joint.found, 0.99);
}

TEST(MovingHead, NeedsNobodyToSayHowItMoves) {
  for (const HeadMoves moves : {HeadMoves::still, HeadMoves::walks, HeadMoves::starts_and_stops}) {
    MovingStudyOptions options = moving(moves, Link::bursts, {});
    options.length_s = 40;
    const MovingStudy study = study_moving(options);
    EXPECT_LE(study.joint.eye_rms_m, 1.08 * study.best_fixed.eye_rms_m) << name_of(moves);
  }
}

/// What a head of few LEDs costs, over half a minute and a bursty link.
TrialErrors errors_with_leds(std::vector<Vec3> leds_in_head, const std::string& mode,
                             const BodyMotion& motion) {
  TrialOptions options;
  options.cameras = cameras_of({});
  options.head.leds_in_head = std::move(leds_in_head);
  options.room_from_head = motion;
  options.wiimote.noise_px = 0.5;
  options.wiimote.link = two_on_one_adapter();
  options.length = std::chrono::seconds(30);
  return errors_of(run_trial(options, {{.mode = mode}})[0]);
}

TEST(MovingHead, IsFollowedByOneLedWhereItFacesTheWall) {
  const TrialErrors errors =
      errors_with_leds({{0, 0, 0}}, "position", swaying(kHeadPlace_in_room, 0.57, 0));
  EXPECT_EQ(errors.found, 1);
  EXPECT_LE(errors.eye_rms_m, 0.006);
}

TEST(MovingHead, IsFollowedByTwoLeds) {
  const std::vector<Vec3> leds = {{-0.09, 0, -0.09}, {0.09, 0, -0.09}};
  const TrialErrors errors =
      errors_with_leds(leds, "auto", swaying(kHeadPlace_in_room, 0.57, radians(40)));
  EXPECT_EQ(errors.found, 1);
  EXPECT_LE(errors.eye_rms_m, 0.03);
}

/// 8 cm and 15 degrees to the side within a quarter of a second, and back after half a second.
Rigid3 twitching(Time time) {
  constexpr double kWay_s = 0.25;
  const double t_s = std::fmod(seconds(time.time_since_epoch()), 1.5);
  const double begun = std::clamp(t_s / kWay_s, 0.0, 1.0);
  const double ended = std::clamp((t_s - 0.75) / kWay_s, 0.0, 1.0);
  const double share = 0.5 * (std::cos(kPi * ended) - std::cos(kPi * begun));
  return {Quat(Eigen::AngleAxisd(radians(15) * share, Vec3::UnitY())),
          kHeadPlace_in_room + 0.08 * share * Vec3::UnitX()};
}

TEST(MovingHead, IsFoundAgainAtOnceWhereItStartsTooSharply) {
  const TrialErrors errors = errors_with_leds(HeadConfig{}.leds_in_head, "auto", twitching);
  EXPECT_GE(errors.found, 0.997);  // six frames of 2700 are missing
}

TEST(MovingHead, HasAQuarterOfTheThesisErrorWhereReportsAreLost) {
  const MovingStudy study = study_moving(moving(HeadMoves::sways, Link::loss, {}));
  ASSERT_TRUE(study.thesis);
  EXPECT_LE(study.joint.eye_rms_m, 0.25 * study.thesis->six_dof.eye_rms_m);
  EXPECT_LE(study.joint.eye_rms_m, 1.2 * study.best_fixed.eye_rms_m);
}

TEST(MovingHead, StaysFoundAmongFalseDots) {
  const MovingStudy study = study_moving(moving(HeadMoves::sways, Link::false_dots, {}));
  EXPECT_GE(study.joint.found, 0.99);
  EXPECT_LE(study.joint.eye_max_m, 0.04);
}

TEST(Motions, StartAndStopWithTheGivenPeaks) {
  const BodyMotion motion = starting_and_stopping({0.57, 1.3}, 3);
  double fastest_m_s = 0, fastest_rad_s = 0;
  int still = 0;
  for (int i = 0; i < 60000; ++i) {
    const Rigid3 a = motion(Time{std::chrono::milliseconds(i)});
    const Rigid3 b = motion(Time{std::chrono::milliseconds(i + 1)});
    const double m_s = 1e3 * (b.translation - a.translation).norm();
    fastest_m_s = std::max(fastest_m_s, m_s);
    fastest_rad_s = std::max(fastest_rad_s, 1e3 * a.rotation.angularDistance(b.rotation));
    still += m_s == 0;
  }
  EXPECT_NEAR(fastest_m_s, 0.57, 0.01);
  EXPECT_NEAR(fastest_rad_s, 1.3, 0.03);
  EXPECT_GT(still, 15000);
}

}  // namespace
}  // namespace vindu
