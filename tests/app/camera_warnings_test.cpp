// What is said of cameras that contradict each other or the heads: once, and that it is over when
// it has been so for half a minute.
#include "app/camera_warnings.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tracker/camera_model.h"
#include "tracker/joint/rotation.h"

namespace vindu::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kNothingFits = "the cameras see dots enough, but these fit no head";
constexpr const char* kAllIsWell = "agree with each other and with the heads again";

Site two_cameras() {
  Site site;
  for (const double x : {-1.0, 1.0}) {
    CameraConfig camera;
    camera.name = x < 0 ? "left" : "right";
    camera.room_from_camera = look_at({x, 2.3, 5}, {0, 1.65, 2});
    site.cameras.push_back(camera);
  }
  return site;
}

/// Room from the head of somebody who steps left and right, turned by up to so much.
Rigid3 stepping(double t_s, double yaw_rad = 0) {
  return {rotation_of({0, yaw_rad * std::sin(0.7 * t_s), 0}),
          {0.25 * std::sin(1.3 * t_s), 1.65, 2}};
}

/// What is said while the tracker is told of LEDs (in head), a hundred times a second, as cameras
/// that truly stand as those of `truth` see them.
std::string said_of(Tracker& tracker, const Site& truth, const std::vector<Vec3>& leds_in_head,
                    std::chrono::seconds duration, double yaw_rad = 0) {
  CameraWarnings warnings(truth);
  ::testing::internal::CaptureStderr();
  for (Time time{}; time < Time{duration}; time += std::chrono::milliseconds(10)) {
    const Rigid3 pose = stepping(seconds(time.time_since_epoch()), yaw_rad);
    for (int camera = 0; camera < std::ssize(truth.cameras); ++camera) {
      const CameraModel model(truth.cameras[static_cast<std::size_t>(camera)]);
      Observation seen{camera, time, {}};
      for (const Vec3& led_in_head : leds_in_head) {
        const Vec2 raw_px = *model.project(model.camera_from_room() * (pose * led_in_head));
        seen.dots.push_back({std::round(raw_px.x()), std::round(raw_px.y()), 3});
      }
      tracker.absorb(seen);
    }
    tracker.track(time, time);
    warnings.look(tracker, time);
  }
  return ::testing::internal::GetCapturedStderr();
}

/// One before which another helmet moved for fifteen seconds.
Tracker puzzled_tracker(const Site& site) {
  Tracker tracker(site.cameras, site.heads, Rigid3{});
  said_of(tracker, site, {{-0.3, 0, 0}, {0, 0.3, 0.1}, {0.2, 0, 0}}, std::chrono::seconds(15));
  return tracker;
}

class CameraWarningsTest : public ::testing::Test {
 protected:
  /// What is said while that tracker is looked at, once a second, from one second to another.
  std::string said(const Tracker& tracker, int from_s, int to_s) {
    ::testing::internal::CaptureStderr();
    for (int second = from_s; second < to_s; ++second)
      warnings_.look(tracker, Time{std::chrono::seconds(100 + second)});
    return ::testing::internal::GetCapturedStderr();
  }

  const Site site_ = two_cameras();
  const Tracker bad_ = puzzled_tracker(site_);
  const Tracker good_{site_.cameras, site_.heads, Rigid3{}};
  CameraWarnings warnings_{site_};
};

/// The third of three cameras was turned by so many pixels after they were calibrated.
std::string said_of_three_cameras(double px) {
  Site site = two_cameras();
  CameraConfig third = site.cameras.front();
  third.name = "third";
  third.room_from_camera = look_at({0, 2.5, 5}, {0, 1.65, 2});
  site.cameras.push_back(third);
  Tracker tracker(site.cameras, site.heads, Rigid3{});
  Rigid3& turned = site.cameras[2].room_from_camera;
  turned.rotation = turned.rotation * rotation_of({px / 1335, 0, 0});
  return said_of(tracker, site, site.heads.front().leds_in_head, std::chrono::seconds(15));
}

TEST(CameraWarningsOfThree, NameTheOneThatStandsAsideOrWasMoved) {
  EXPECT_THAT(said_of_three_cameras(0), IsEmpty());
  EXPECT_THAT(said_of_three_cameras(5), AllOf(HasSubstr("third: its dots stand"),
                                              Not(HasSubstr("left: ")), Not(HasSubstr("right: "))));
  EXPECT_THAT(
      said_of_three_cameras(60),
      AllOf(HasSubstr("third: was moved"), Not(HasSubstr("left: ")), Not(HasSubstr("right: "))));
}

/// Of a helmet of two LEDs that turns left and right, and whose LEDs are so many times as far apart
/// as the wall file has it.
std::string said_of_two_leds(double times) {
  Site site = two_cameras();
  site.heads.front().leds_in_head = {{-0.09, 0.03, -0.09}, {0, 0, 0}};
  std::vector<Vec3> leds_in_head = site.heads.front().leds_in_head;
  for (Vec3& led : leds_in_head) led *= times;
  Tracker tracker(site.cameras, site.heads, Rigid3{});
  return said_of(tracker, site, leds_in_head, std::chrono::seconds(40), 0.6);
}

TEST(CameraWarningsOfTwoLeds, SayWhatNoiseDoesNotExplain) {
  EXPECT_THAT(said_of_two_leds(1), IsEmpty());
  EXPECT_THAT(said_of_two_leds(1.1), HasSubstr("% larger than where the cameras see them"));
}

TEST_F(CameraWarningsTest, SayThatAllIsWellWhenItHasBeenForHalfAMinute) {
  ASSERT_TRUE(bad_.nothing_fits());
  EXPECT_THAT(said(bad_, 0, 1), HasSubstr(kNothingFits));
  EXPECT_THAT(said(good_, 1, 31), IsEmpty());
  EXPECT_THAT(said(good_, 31, 32), HasSubstr(kAllIsWell));
  EXPECT_THAT(said(good_, 32, 100), IsEmpty());
  EXPECT_THAT(said(bad_, 100, 101), HasSubstr(kNothingFits));
}

TEST_F(CameraWarningsTest, SayNothingAgainOfWhatComesBackWithinHalfAMinute) {
  EXPECT_THAT(said(bad_, 0, 5), HasSubstr(kNothingFits));
  EXPECT_THAT(said(good_, 5, 30), IsEmpty());
  EXPECT_THAT(said(bad_, 30, 32), IsEmpty());
  EXPECT_THAT(said(good_, 32, 62), IsEmpty());
  EXPECT_THAT(said(good_, 62, 63), HasSubstr(kAllIsWell));
}

}  // namespace
}  // namespace vindu::app
