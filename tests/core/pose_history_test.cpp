// The pose history's honest answers: exact, interpolated, predicted, stale.
#include "core/pose_history.h"

#include <thread>

#include "tests/core/matchers.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;
using testing::IsNearPoint;
using testing::IsNearRotation;

constexpr Time at_ms(int time_ms) { return Time{} + std::chrono::milliseconds(time_ms); }

PoseSample sample_at(int time_ms, const Vec3& head_in_room = Vec3::Zero(),
                     TrackingLevel level = TrackingLevel::six_dof) {
  PoseSample sample;
  sample.capture_time = at_ms(time_ms);
  sample.level = level;
  sample.room_from_head.translation = head_in_room;
  return sample;
}

TEST(PoseHistory, IsEmptyOnlyBeforeTheFirstSample) {
  PoseHistory history;
  EXPECT_FALSE(history.at(at_ms(0)));
  history.add(sample_at(10));
  EXPECT_TRUE(history.at(at_ms(0)));
}

TEST(PoseHistory, AnswersExactlyAtASample) {
  PoseHistory history;
  history.add(sample_at(10, {1, 0, 0}));
  history.add(sample_at(20, {2, 0, 0}));
  for (const int time_ms : {10, 20}) {
    const auto pose = history.at(at_ms(time_ms));
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->answer, PoseAnswer::exact);
    EXPECT_EQ(pose->sample.capture_time, at_ms(time_ms));
    EXPECT_THAT(pose->sample.room_from_head.translation, IsNearPoint(Vec3(time_ms / 10., 0, 0), 0));
  }
}

TEST(PoseHistory, InterpolatesBetweenSamples) {
  PoseHistory history;
  history.add(sample_at(10, {1, 0, 0}));
  PoseSample turned = sample_at(20, {2, 4, 0});
  turned.room_from_head.rotation = Eigen::AngleAxisd(0.4, Vec3::UnitY());
  history.add(turned);

  const auto pose = history.at(at_ms(15));

  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->answer, PoseAnswer::interpolated);
  EXPECT_THAT(pose->sample.room_from_head.translation, IsNearPoint(Vec3(1.5, 2, 0), 1e-12));
  EXPECT_THAT(pose->sample.room_from_head.rotation,
              IsNearRotation(Quat(Eigen::AngleAxisd(0.2, Vec3::UnitY())), 1e-12));
  EXPECT_EQ(pose->sample.capture_time, at_ms(20));  // the newest that it rests on
}

TEST(PoseHistory, InterpolatesNoBetterThanTheWorseOfBothSamples) {
  PoseHistory history;
  history.add(sample_at(10, Vec3::Zero(), TrackingLevel::six_dof));
  history.add(sample_at(20, Vec3::Zero(), TrackingLevel::held));
  EXPECT_EQ(history.at(at_ms(11))->sample.level, TrackingLevel::held);
}

TEST(PoseHistory, PredictsWithTheNewestVelocitiesUpToTheLimit) {
  PoseHistory history({.kept = milliseconds(2000), .prediction_limit = milliseconds(60)});
  PoseSample moving = sample_at(10, {1, 0, 0});
  moving.velocity_in_room_m_s = {0.5, 0, -1};
  moving.angular_velocity_in_room_rad_s = {0, 2, 0};
  history.add(moving);

  const auto pose = history.at(at_ms(70));

  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->answer, PoseAnswer::predicted);
  EXPECT_THAT(pose->sample.room_from_head.translation, IsNearPoint(Vec3(1.03, 0, -0.06), 1e-12));
  EXPECT_THAT(pose->sample.room_from_head.rotation,
              IsNearRotation(Quat(Eigen::AngleAxisd(0.12, Vec3::UnitY())), 1e-12));
  EXPECT_EQ(pose->sample.capture_time, at_ms(10));
}

TEST(PoseHistory, IsStaleBeyondThePredictionLimitAndGivesTheNewestAsItIs) {
  PoseHistory history({.kept = milliseconds(2000), .prediction_limit = milliseconds(60)});
  PoseSample moving = sample_at(10, {1, 0, 0});
  moving.velocity_in_room_m_s = {0.5, 0, 0};
  history.add(moving);

  const auto pose = history.at(at_ms(70) + std::chrono::nanoseconds(1));

  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->answer, PoseAnswer::stale);
  EXPECT_THAT(pose->sample.room_from_head.translation, IsNearPoint(Vec3(1, 0, 0), 0));
}

TEST(PoseHistory, IsStaleBeforeTheOldestSample) {
  PoseHistory history;
  history.add(sample_at(10, {1, 0, 0}));
  history.add(sample_at(20, {2, 0, 0}));
  const auto pose = history.at(at_ms(9));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->answer, PoseAnswer::stale);
  EXPECT_THAT(pose->sample.room_from_head.translation, IsNearPoint(Vec3(1, 0, 0), 0));
}

TEST(PoseHistory, PutsLateSamplesInTheirPlace) {
  PoseHistory history;
  for (const int time_ms : {10, 40, 20, 30}) history.add(sample_at(time_ms, {time_ms / 10., 0, 0}));
  for (const int time_ms : {15, 25, 35}) {
    const auto pose = history.at(at_ms(time_ms));
    EXPECT_EQ(pose->answer, PoseAnswer::interpolated);
    EXPECT_THAT(pose->sample.room_from_head.translation,
                IsNearPoint(Vec3(time_ms / 10., 0, 0), 1e-12));
  }
}

TEST(PoseHistory, KeepsTheLastOfTwoSamplesOfOneTime) {
  PoseHistory history;
  history.add(sample_at(10, {1, 0, 0}));
  history.add(sample_at(20, {2, 0, 0}));
  history.add(sample_at(10, {7, 0, 0}));
  EXPECT_THAT(history.at(at_ms(10))->sample.room_from_head.translation,
              IsNearPoint(Vec3(7, 0, 0), 0));
}

TEST(PoseHistory, ForgetsWhatIsOlderThanItKeeps) {
  PoseHistory history({.kept = milliseconds(100), .prediction_limit = milliseconds(60)});
  history.add(sample_at(0));
  history.add(sample_at(50));
  history.add(sample_at(101));
  EXPECT_EQ(history.at(at_ms(0))->answer, PoseAnswer::stale);
  EXPECT_EQ(history.at(at_ms(50))->answer, PoseAnswer::exact);
}

TEST(PoseHistory, IgnoresASampleThatComesLaterThanItKeeps) {
  PoseHistory history({.kept = milliseconds(100), .prediction_limit = milliseconds(60)});
  history.add(sample_at(500, {5, 0, 0}));
  history.add(sample_at(0, {1, 0, 0}));
  EXPECT_THAT(history.at(at_ms(0))->sample.room_from_head.translation,
              IsNearPoint(Vec3(5, 0, 0), 0));
}

TEST(PoseHistory, MayBeAskedWhileItIsFilled) {
  PoseHistory history;
  history.add(sample_at(0));
  std::jthread tracker([&] {
    for (int time_ms = 1; time_ms < 2000; ++time_ms)
      history.add(sample_at(time_ms, {time_ms / 1000., 0, 0}));
  });
  for (int time_ms = 0; time_ms < 2000; ++time_ms) EXPECT_TRUE(history.at(at_ms(time_ms)));
}

TEST(Extrapolation, BackUndoesAhead) {
  PoseSample sample = sample_at(0, {1, 2, 3});
  sample.velocity_in_room_m_s = {0.3, -0.2, 0.1};
  sample.angular_velocity_in_room_rad_s = {0.5, 1, -2};
  const PoseSample there_and_back =
      extrapolate(extrapolate(sample, milliseconds(40)), milliseconds(-40));
  EXPECT_THAT(there_and_back.room_from_head, testing::IsNearRigid(sample.room_from_head, 1e-12));
}

TEST(Names, OfAnswersAndLevelsAreForPeople) {
  EXPECT_EQ(name_of(PoseAnswer::exact), "exact");
  EXPECT_EQ(name_of(PoseAnswer::stale), "stale");
  EXPECT_EQ(name_of(TrackingLevel::six_dof), "six-dof");
  EXPECT_EQ(name_of(TrackingLevel::lost), "lost");
}

}  // namespace
}  // namespace vindu
