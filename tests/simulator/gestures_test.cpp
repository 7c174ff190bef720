// Nods, shakes and looks of a person who walks about: all found, none invented, with the noise that
// tracking has.
#include "tracker/gestures.h"

#include <gmock/gmock.h>

#include <map>

#include "core/random.h"
#include "simulator/person.h"
#include "tracker/camera_model.h"
#include "tracker/point_fit.h"
#include "tracker/tracker.h"

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kRate_hz = 60;
constexpr double kPlaceNoise_m = 0.002;
constexpr double kRotationNoise_rad = radians(1);
const HeadConfig kHead;
const Rigid3 kRoomFromWall = room_from_wall_at(kDefaultCentreHeight_m, 0);

PoseSample sample_of(const Rigid3& pose, double time_s) {
  PoseSample sample;
  sample.capture_time = Time(from_seconds(time_s));
  sample.level = TrackingLevel::six_dof;
  sample.room_from_head = pose;
  return sample;
}

/// What a tracker makes of a true pose.
PoseSample tracked(const Rigid3& pose, double time_s, Random& random) {
  const auto three = [&](double sigma) {
    const double x = random.normal(sigma), y = random.normal(sigma);
    return Vec3(x, y, random.normal(sigma));
  };
  const Vec3 turn = three(kRotationNoise_rad);
  const Quat wrong(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return sample_of({wrong * pose.rotation, pose.translation + three(kPlaceNoise_m)}, time_s);
}

/// The head turned in addition about its own x (a nod) or y (a shake), to and fro.
struct Movement {
  Gesture gesture = Gesture::nod;
  double amplitude_rad = 0;  // half of a swing
  double rate_hz = 0;
  double start_s = 0;
  double cycles = 2;

  double end_s() const { return start_s + cycles / rate_hz; }
  Quat at(double time_s) const {
    const double u = (time_s - start_s) * rate_hz;
    const double angle_rad = u > 0 && u < cycles ? -amplitude_rad * std::sin(2 * kPi * u) : 0;
    return Quat(
        Eigen::AngleAxisd(angle_rad, gesture == Gesture::nod ? Vec3::UnitX() : Vec3::UnitY()));
  }
};

Rigid3 standing() { return {Quat::Identity(), Vec3(0, 1.65, 2) - kHead.eye_in_head}; }

std::vector<GestureEvent> events_of_standing(const std::vector<Movement>& movements, double until_s,
                                             std::vector<LookTarget> targets = {}) {
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall, std::move(targets));
  Random random(2);
  std::vector<GestureEvent> events;
  for (double t_s = 0; t_s < until_s; t_s += 1 / kRate_hz) {
    Rigid3 pose = standing();
    for (const Movement& movement : movements) pose.rotation = pose.rotation * movement.at(t_s);
    if (auto event = detector.absorb(tracked(pose, t_s, random))) events.push_back(*event);
  }
  return events;
}

std::vector<Gesture> kinds_of(const std::vector<GestureEvent>& events) {
  std::vector<Gesture> kinds;
  for (const GestureEvent& event : events) kinds.push_back(event.gesture);
  return kinds;
}

/// False alarms of a walk with all that disturbs: bob that pitches the head, the helmet lost and
/// found.
int false_alarms(std::uint64_t seed, double length_s) {
  const Person person(kHead, kRoomFromWall, {.seed = seed});
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall);
  Random random(seed);
  int alarms = 0;
  double lost_until_s = 0;
  for (double t_s = 0; t_s < length_s; t_s += 1 / kRate_hz) {
    Rigid3 pose = person.room_from_head(Time(from_seconds(t_s)));
    const double bob_rad = radians(1.5) * std::sin(2 * kPi * 1.8 * t_s);
    pose.rotation = pose.rotation * Eigen::AngleAxisd(bob_rad, Vec3::UnitX());
    if (random.uniform(0, 1) < 0.2 / kRate_hz) lost_until_s = t_s + random.uniform(0.05, 1.5);
    PoseSample sample = tracked(pose, t_s, random);
    if (t_s < lost_until_s) sample.level = TrackingLevel::position;
    alarms += detector.absorb(sample).has_value();
  }
  return alarms;
}

TEST(Gestures, HalfAnHourOfWalkingHasNoNodAndNoShake) {
  int alarms = 0;
  constexpr int kWalks = 8;
  for (std::uint64_t seed = 1; seed <= kWalks; ++seed) alarms += false_alarms(seed, 1800);
  // With none in n hours the rate is below 3 / n, with a confidence of 95 % (Hanley 1983).
  std::printf("%d false alarms in %.1f h; at 95 %% confidence fewer than %.1f an hour\n", alarms,
              0.5 * kWalks, (alarms ? 2.0 * alarms + 3 : 3) / (0.5 * kWalks));
  EXPECT_EQ(alarms, 0);
}

/// How far the walk itself turns the head aside meanwhile.
double own_turn_rad(const Person& person, const Movement& movement) {
  double least = kPi, largest = -kPi;
  for (double t_s = movement.start_s; t_s < movement.end_s(); t_s += 0.05) {
    const Vec3 facing = person.room_from_head(Time(from_seconds(t_s))).rotation * -Vec3::UnitZ();
    const double yaw_rad = std::atan2(-facing.x(), -facing.z());
    least = std::min(least, yaw_rad), largest = std::max(largest, yaw_rad);
  }
  return largest - least;
}

struct Found {
  int right = 0, wrong = 0, all = 0;
};

/// One movement every five seconds of a walk. Those during which the walker turns aside by more
/// than the movement itself are not counted: nobody does both.
Found found_while_walking(Gesture gesture, double amplitude_deg, double rate_hz) {
  constexpr int kMovements = 90;
  const Person person(kHead, kRoomFromWall, {.seed = 11});
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall);
  Random random(5);
  Found found;
  for (int i = 0; i < kMovements; ++i) {
    const Movement movement{gesture, radians(amplitude_deg), rate_hz, 5.0 * i + 1.3, 2};
    int right = 0;
    for (int k = 0; k < 5 * kRate_hz; ++k) {
      const double t_s = 5.0 * i + k / kRate_hz;
      Rigid3 pose = person.room_from_head(Time(from_seconds(t_s)));
      pose.rotation = pose.rotation * movement.at(t_s);
      const auto event = detector.absorb(tracked(pose, t_s, random));
      if (!event) continue;
      const bool in_time = t_s > movement.start_s && t_s < movement.end_s() + 0.6;
      ++(event->gesture == gesture && in_time ? right : found.wrong);
    }
    found.wrong += std::max(0, right - 1);
    if (own_turn_rad(person, movement) > 2 * movement.amplitude_rad) continue;
    found.right += right > 0;
    ++found.all;
  }
  return found;
}

TEST(Gestures, AreFoundWhileWalkingAtEveryAmplitudeAndRate) {
  for (const Gesture gesture : {Gesture::nod, Gesture::shake})
    for (const double amplitude_deg : {5.0, 10.0, 20.0})
      for (const double rate_hz : {1.0, 1.5, 2.0, 3.0}) {
        const Found found = found_while_walking(gesture, amplitude_deg, rate_hz);
        std::printf("%-5s %4.0f deg %3.1f Hz: %d of %d, %d wrong\n", name_of(gesture).data(),
                    amplitude_deg, rate_hz, found.right, found.all, found.wrong);
        EXPECT_GE(found.right, 0.95 * found.all);
        EXPECT_EQ(found.wrong, 0);
      }
}

TEST(Gestures, AMovementIsOneEventHoweverLongItLasts) {
  EXPECT_THAT(kinds_of(events_of_standing({{Gesture::nod, radians(10), 2, 1, 8}}, 7)),
              ElementsAre(Gesture::nod));
  EXPECT_THAT(kinds_of(events_of_standing({{Gesture::shake, radians(10), 2, 1, 8}}, 7)),
              ElementsAre(Gesture::shake));
}

TEST(Gestures, TwoMovementsAreTwoEvents) {
  EXPECT_THAT(kinds_of(events_of_standing({{Gesture::nod, radians(10), 2, 1, 2},
                                           {Gesture::nod, radians(10), 2, 4.5, 2},
                                           {Gesture::shake, radians(10), 2, 8, 2}},
                                          10)),
              ElementsAre(Gesture::nod, Gesture::nod, Gesture::shake));
}

TEST(Gestures, ASingleQuickNodCountsButAGlanceAsideDoesNot) {
  // Half a cycle: down and up again.
  EXPECT_THAT(kinds_of(events_of_standing({{Gesture::nod, radians(15), 1, 1, 0.5}}, 3)),
              ElementsAre(Gesture::nod));
  EXPECT_THAT(events_of_standing({{Gesture::shake, radians(30), 1, 1, 0.5}}, 3), IsEmpty());
  EXPECT_THAT(events_of_standing({{Gesture::nod, radians(20), 0.3, 1, 0.5}}, 4), IsEmpty());
}

TEST(Gestures, SwingsAslantAreNeither) {
  EXPECT_THAT(
      events_of_standing(
          {{Gesture::nod, radians(10), 1.5, 1, 4}, {Gesture::shake, radians(10), 1.5, 1, 4}}, 6),
      IsEmpty());
}

TEST(Gestures, SlowAndFastSwingsAreNone) {
  EXPECT_THAT(events_of_standing({{Gesture::nod, radians(10), 0.5, 1, 4}}, 11), IsEmpty());
  EXPECT_THAT(events_of_standing({{Gesture::shake, radians(15), 7, 1, 14}}, 5), IsEmpty());
}

TEST(Gestures, AClearerMovementHasMoreConfidence) {
  const auto small = events_of_standing({{Gesture::shake, radians(4.5), 2, 1, 3}}, 4);
  const auto large = events_of_standing({{Gesture::shake, radians(15), 2, 1, 3}}, 4);
  ASSERT_THAT(small, SizeIs(1));
  ASSERT_THAT(large, SizeIs(1));
  EXPECT_GT(small[0].confidence, 0);
  EXPECT_LT(small[0].confidence, large[0].confidence);
  EXPECT_LE(large[0].confidence, 1);
}

std::vector<GestureEvent> nods_at_level(TrackingLevel level) {
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall);
  const Movement nod{Gesture::nod, radians(12), 2, 1, 3};
  std::vector<GestureEvent> events;
  for (double t_s = 0; t_s < 4; t_s += 1 / kRate_hz) {
    PoseSample sample = sample_of({nod.at(t_s), standing().translation}, t_s);
    sample.level = level;
    sample.object = 3;
    if (auto event = detector.absorb(sample)) events.push_back(*event);
  }
  return events;
}

TEST(Gestures, CountOnlyWhereTheRotationIsKnown) {
  for (const TrackingLevel level : {TrackingLevel::six_dof, TrackingLevel::hybrid}) {
    const auto events = nods_at_level(level);
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_EQ(events[0].object, 3);
    EXPECT_GT(events[0].time, Time(std::chrono::seconds(1)));
  }
  for (const TrackingLevel level :
       {TrackingLevel::position, TrackingLevel::bearing, TrackingLevel::held, TrackingLevel::lost})
    EXPECT_THAT(nods_at_level(level), IsEmpty());
}

/// Of a nod, a shake and a look at the vase, by a head whose turn about that axis is known so well.
std::vector<Gesture> found_with_sigma(const Vec3& axis_in_room, double sigma_deg) {
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall, {{"wall", {0, 0, 0}, 0.5}});
  const Movement nod{Gesture::nod, radians(12), 2, 1, 3}, shake{Gesture::shake, radians(12), 2, 4};
  std::vector<Gesture> kinds;
  for (double t_s = 0; t_s < 6; t_s += 1 / kRate_hz) {
    PoseSample sample = sample_of({nod.at(t_s) * shake.at(t_s), standing().translation}, t_s);
    sample.level = TrackingLevel::hybrid;
    sample.covariance.bottomRightCorner<3, 3>() =
        std::pow(radians(sigma_deg), 2) * axis_in_room * axis_in_room.transpose();
    if (const auto event = detector.absorb(sample)) kinds.push_back(event->gesture);
  }
  return kinds;
}

TEST(Gestures, CountOnlyWhereTheAngleThatTheyAreOfIsKnown) {
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    EXPECT_THAT(found_with_sigma(axis, 3),
                ElementsAre(Gesture::look, Gesture::nod, Gesture::shake));
  EXPECT_THAT(found_with_sigma(Vec3::UnitX(), 5), ElementsAre(Gesture::shake));
  EXPECT_THAT(found_with_sigma(Vec3::UnitY(), 5), ElementsAre(Gesture::nod));
  EXPECT_THAT(found_with_sigma(Vec3::UnitZ(), 10),
              ElementsAre(Gesture::look, Gesture::nod, Gesture::shake));
}

/// What a tracker of two cameras tells of a head on a walk, which may nod or shake meanwhile.
std::vector<Gesture> found_by_tracker(const std::vector<Vec3>& leds_in_head, std::uint64_t seed,
                                      const std::vector<Movement>& movements) {
  HeadConfig head;
  head.leds_in_head = leds_in_head;
  std::vector<CameraConfig> cameras(2);
  cameras[0].room_from_camera = look_at({-1, 2.3, 5}, {0, 1.65, 2});
  cameras[1].room_from_camera = look_at({1, 2.3, 5}, {0, 1.65, 2});
  Tracker tracker(cameras, std::vector{head}, kRoomFromWall);
  GestureDetector detector(head.eye_in_head, kRoomFromWall);
  const Person person(head, kRoomFromWall, {.seed = seed});
  std::vector<Gesture> kinds;
  for (double t_s = 0; t_s < 20; t_s += 0.01) {
    const Time time{from_seconds(t_s)};
    Rigid3 pose = person.room_from_head(time);
    for (const Movement& movement : movements) pose.rotation = pose.rotation * movement.at(t_s);
    for (const int camera : {0, 1}) {
      const CameraModel model(cameras[static_cast<std::size_t>(camera)]);
      Observation seen{camera, time, {}};
      for (const Vec3& led : leds_in_head)
        if (const auto raw_px = model.project(model.camera_from_room() * (pose * led)))
          seen.dots.push_back({std::round(raw_px->x()), std::round(raw_px->y()), 3});
      tracker.absorb(seen);
    }
    tracker.track(time, time);
    for (const PoseSample& sample : tracker.poses())
      if (const auto event = detector.absorb(sample)) kinds.push_back(event->gesture);
  }
  return kinds;
}

TEST(Gestures, OfATrackedHeadAreFoundUnlessItsLedsDoNotShowThem) {
  const Movement nod{Gesture::nod, radians(10), 2, 5.3, 2};
  const Movement shake{Gesture::shake, radians(15), 2, 12.3, 2};
  EXPECT_THAT(found_by_tracker(kHead.leds_in_head, 1, {nod, shake}),
              ElementsAre(Gesture::nod, Gesture::shake));
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_THAT(found_by_tracker({{-0.09, 0, 0}, {0.09, 0, 0}, {0, 0, 0}}, seed, {}), IsEmpty());
    EXPECT_THAT(found_by_tracker({{-0.09, 0.03, -0.09}, {0, 0, 0}}, seed, {}), IsEmpty());
  }
}

TEST(Gestures, OldAndBrokenSamplesAreIgnored) {
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall);
  const Movement nod{Gesture::nod, radians(12), 2, 1, 3};
  int events = 0;
  for (double t_s = 0; t_s < 4; t_s += 1 / kRate_hz) {
    events += detector.absorb(sample_of({nod.at(t_s), standing().translation}, t_s)).has_value();
    Rigid3 broken = standing();
    broken.rotation.x() = std::nan("");
    EXPECT_FALSE(detector.absorb(sample_of(broken, t_s + 1e-3)));
    EXPECT_FALSE(detector.absorb(sample_of(standing(), t_s - 0.1)));
  }
  EXPECT_EQ(events, 1);
}

const std::vector<LookTarget> kThings = {
    {"vase", {0, 0.1, 0}, 0.25}, {"far vase", {0, 0.1, -2}, 0.5}, {"lamp", {1.2, 0.1, 0}, 0.25}};

/// Looks at a point of the wall from a time on.
std::vector<std::pair<std::string, double>> looks(const std::map<double, Vec3>& points_by_time_s,
                                                  double until_s) {
  GestureDetector detector(kHead.eye_in_head, kRoomFromWall, kThings);
  Random random(9);
  std::vector<std::pair<std::string, double>> found;
  for (double t_s = 0; t_s < until_s; t_s += 1 / kRate_hz) {
    const Vec3 point_in_wall = std::prev(points_by_time_s.upper_bound(t_s))->second;
    const Vec3 way = kRoomFromWall * point_in_wall - Vec3(0, 1.65, 2);
    const Quat rotation = least_turn(-Vec3::UnitZ(), way);
    const Rigid3 pose{rotation, Vec3(0, 1.65, 2) - rotation * kHead.eye_in_head};
    const auto event = detector.absorb(tracked(pose, t_s, random));
    if (event && event->gesture == Gesture::look) found.emplace_back(event->target, t_s);
  }
  return found;
}

TEST(Gestures, LookingAtAThingForAWhileIsToldOnceAndInTime) {
  const auto found = looks({{0, {-1, 0.1, 0}}, {2, {0.05, 0.1, 0}}}, 6);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].first, "vase");
  EXPECT_NEAR(found[0].second, 2.8, 0.15);
}

TEST(Gestures, AGlanceAtAThingIsNoLook) {
  EXPECT_THAT(looks({{0, {-1, 0.1, 0}}, {2, {0, 0.1, 0}}, {2.6, {-1, 0.1, 0}}}, 6), IsEmpty());
}

TEST(Gestures, AShortGlanceAwayDoesNotEndALook) {
  const auto found =
      looks({{0, {-1, 0.1, 0}}, {2, {0, 0.1, 0}}, {2.4, {-1, 0.1, 0}}, {2.5, {0, 0.1, 0}}}, 6);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_LT(found[0].second, 3.0);
}

TEST(Gestures, LookingFromOneThingToAnotherAndBackIsThreeLooks) {
  const auto found = looks({{0, {0, 0.1, 0}}, {2, {1.2, 0.1, 0}}, {4, {0, 0.1, 0}}}, 6);
  ASSERT_THAT(found, SizeIs(3));
  EXPECT_EQ(found[0].first, "vase");
  EXPECT_EQ(found[1].first, "lamp");
  EXPECT_EQ(found[2].first, "vase");
}

TEST(Gestures, AGazeOnTheEdgeOfAThingDoesNotFlicker) {
  EXPECT_THAT(looks({{0, {0, 0.1, 0}}, {1, {0.27, 0.1, 0}}}, 20), SizeIs(1));
}

}  // namespace
}  // namespace vindu
