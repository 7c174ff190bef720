// Half an hour with everything that goes wrong in a room: the walker leaves and returns, ducks,
// turns away, lamps and false dots stand in the picture, the radio is busy. What the wall shows
// must stay sane throughout.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "simulator/led_sight.h"
#include "simulator/person.h"
#include "simulator/single_frame.h"
#include "simulator/trial.h"
#include "tracker/eye_ease.h"

namespace vindu {
namespace {

constexpr double kFrame_s = 1.0 / 60;
constexpr Duration kRadio = std::chrono::milliseconds(6);  // from the light to a good report

/// 0 most of the time, 1 for the middle of `length_s` in each `every_s`, smooth between.
double now_and_then(double t_s, double every_s, double length_s, double at_s) {
  const double into_s = std::fmod(t_s + every_s - at_s, every_s);
  if (into_s > length_s) return 0;
  const double sine = std::sin(kPi * into_s / length_s);
  return sine * sine;
}

struct Walker {
  std::uint64_t seed;
  int leds;  // 3: the thesis' helmet
};

TrialOptions room_with_a_restless(const Walker& walker) {
  const Site site = read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  const HeadConfig head = walker.leds == 4 ? four_led_head() : site.heads.front();
  PersonOptions walk{.seed = walker.seed};
  walk.least_eye_in_room.x() = -1.6;  // farther than both cameras see
  walk.largest_eye_in_room.x() = 1.6;
  walk.largest_eye_in_room.z() = 2.6;
  const Person person(head, site.wall.room_from_wall, walk);
  TrialOptions options{.cameras = site.cameras, .head = head, .room_from_head = {}};
  options.room_from_head = [person](Time time) {
    const double t_s = seconds(time.time_since_epoch());
    Rigid3 pose = person.room_from_head(time);
    const double turn_rad = radians(150) * now_and_then(t_s, 41, 6, 11);
    pose.rotation = Quat(Eigen::AngleAxisd(turn_rad, Vec3::UnitY())) * pose.rotation;
    pose.translation.y() -= 0.6 * now_and_then(t_s, 23, 3, 5);
    return pose;
  };
  options.wiimote.seed = walker.seed;
  options.wiimote.link = two_on_one_adapter();
  options.wiimote.false_dots = 0.02;
  options.wiimote.glints = {{{-0.9, 2.2, 0.3}, 1.5}, {{0.7, 0.9, 0.2}, 1.5}};
  options.warm_up = std::chrono::seconds(5);
  options.length = std::chrono::minutes(30);
  return options;
}

/// The frames for which something holds, in seconds: all, and the longest run of them.
class Runs {
 public:
  void add(bool holds) {
    all_ += holds;
    longest_ = std::max(longest_, run_ = holds ? run_ + 1 : 0);
  }
  double all_s() const { return kFrame_s * all_; }
  double longest_s() const { return kFrame_s * longest_; }

 private:
  int all_ = 0, run_ = 0, longest_ = 0;
};

/// Whether the dots that the cameras have of the head tell where it is, whatever is remembered:
/// four or more, of three LEDs.
bool can_be_told(const TrialOptions& options, Time captured) {
  const std::array poses = {options.room_from_head(captured)};
  return survey(options.cameras, options.head, helmet_dot_noise(options.head), poses)
             .front()
             .level == TrackingLevel::six_dof;
}

class LongWalk : public ::testing::TestWithParam<Walker> {};

TEST_P(LongWalk, never_shows_a_wrong_head_nor_a_jump) {
  const TrialOptions options = room_with_a_restless(GetParam());
  const auto frames = run_trial(options, {TrackingConfig{}})[0];
  EyeEase ease(Vec3(0, 1.65, 2));
  Runs wrong, off, needlessly_off;
  double largest_jump_m = 0;
  int tracked = 0;
  Vec3 before = Vec3::Zero(), truth_before = Vec3::Zero();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TrialFrame& frame = frames[i];
    const bool known = frame.level < TrackingLevel::held;
    tracked += known;
    ASSERT_TRUE(frame.eye_in_room.allFinite());
    // Wrong is what is farther off than the pose itself says; a bearing does not say how far away.
    const bool placed = frame.level <= TrackingLevel::position;
    wrong.add(placed && frame.eye_error_m > std::max(0.10, 4 * frame.eye_sigma_m));
    const bool is_off = known && frame.eye_error_m > 0.15;
    off.add(is_off);
    needlessly_off.add(is_off && can_be_told(options, frame.photon - options.photon_lag - kRadio));
    const Vec3 eye =
        ease.update(known ? std::optional(frame.eye_in_room) : std::nullopt, frame.photon);
    const Vec3 truth = options.room_from_head(frame.photon) * options.head.eye_in_head;
    if (i > 0)
      largest_jump_m =
          std::max(largest_jump_m, (eye - before).norm() - (truth - truth_before).norm());
    before = eye;
    truth_before = truth;
  }
  const TrialErrors errors = errors_of(frames);
  std::printf(
      "  found %.1f %%, rms %.1f mm, p95 %.1f mm, max %.0f mm; wrong for %.2f s at most, "
      "largest jump %.1f mm; over 150 mm off for %.1f s, for %.2f s with dots that tell\n",
      100 * errors.found, 1e3 * errors.eye_rms_m, 1e3 * errors.eye_p95_m, 1e3 * errors.eye_max_m,
      wrong.longest_s(), 1e3 * largest_jump_m, off.all_s(), needlessly_off.all_s());
  EXPECT_LE(wrong.longest_s(), 0.1);
  EXPECT_LE(needlessly_off.longest_s(), 0.4);
  EXPECT_LT(largest_jump_m, 0.02);
  EXPECT_LT(errors.eye_max_m, 0.7);  // one camera, two dots
  EXPECT_GT(tracked, static_cast<int>(frames.size() / 2));
}

INSTANTIATE_TEST_SUITE_P(Walkers, LongWalk,
                         ::testing::Values(Walker{1, 3}, Walker{3, 3}, Walker{29, 3}, Walker{39, 3},
                                           Walker{74, 3}, Walker{88, 3}, Walker{190, 3},
                                           Walker{14, 4}, Walker{15, 4}),
                         [](const auto& walker) {
                           return "number_" + std::to_string(walker.param.seed) + "_with_" +
                                  std::to_string(walker.param.leds) + "_leds";
                         });

}  // namespace
}  // namespace vindu
