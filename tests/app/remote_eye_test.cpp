// Whose poses a master follows, of trackers elsewhere.
#include "app/remote_eye.h"

#include <gtest/gtest.h>

#include "cluster/in_process.h"

namespace vindu::app {
namespace {

using std::chrono::milliseconds;

/// Two trackers, each of which sees a head of its own: the bus lets both be heard.
class RemoteEyes : public ::testing::Test {
 protected:
  RemoteEyes() { site_.heads.resize(2); }

  std::unique_ptr<Bus> join(Role role, const std::string& name, Topics publishes,
                            Topics subscribes) {
    return transport_.join(
        {{.role = role, .name = name, .host = "here", .version = "1"}, publishes, subscribes});
  }

  void say(Bus& bus, const std::string& name, std::uint32_t strength, int object, double x_m) {
    PoseMessage message{.sent_time = now_, .followed = true, .tracker = name, .strength = strength};
    message.pose.object = object;
    message.pose.time = message.pose.capture_time = now_;
    message.pose.level = TrackingLevel::six_dof;
    message.pose.room_from_head.translation = {x_m, 1.6, 2};
    bus.publish(message);
  }

  /// For ten seconds both say where they see somebody, and the master asks: where the eye is then.
  double eye_x_m(bool weak_speaks, bool strong_speaks) {
    double x_m = 0;
    for (int i = 0; i < 1000; ++i) {
      now_ += milliseconds(10);
      if (weak_speaks) say(*weak_, "weak", 5, 1, -1);
      if (strong_speaks) say(*strong_, "strong", 20, 0, 1);
      x_m = eye_.at(now_, now_).eye_in_wall.x();
    }
    return x_m;
  }

  InProcessTransport transport_;
  Site site_;
  std::unique_ptr<Bus> weak_ = join(Role::tracker, "weak", {Topic::pose}, {}),
                       strong_ = join(Role::tracker, "strong", {Topic::pose}, {}),
                       master_ = join(Role::master, "master", {}, {Topic::pose});
  RemoteEye eye_{*master_, site_, nullptr};
  Time now_{std::chrono::seconds(100)};
};

TEST_F(RemoteEyes, FollowTheStrongerTrackerAloneAndTheOtherWhenItIsSilent) {
  EXPECT_EQ(eye_.tracker(), "");
  EXPECT_LT(eye_x_m(true, false), -0.9);
  EXPECT_EQ(eye_.tracker(), "weak");
  ::testing::internal::CaptureStderr();
  EXPECT_GT(eye_x_m(true, true), 0.9);
  EXPECT_EQ(eye_.tracker(), "strong");
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(said.find("poses come from strong"), said.rfind("poses come from")) << said;
  EXPECT_LT(eye_x_m(true, false), -0.9);
  EXPECT_EQ(eye_.tracker(), "weak");
  eye_x_m(false, false);
  EXPECT_EQ(eye_.tracker(), "");
}

}  // namespace
}  // namespace vindu::app
