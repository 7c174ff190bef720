#include "simulator/single_frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "simulator/emulated_wiimote.h"
#include "tracker/coverage.h"
#include "tracker/joint/acquisition.h"
#include "tracker/thesis_method.h"
#include "tracker/wiimote/report.h"

namespace vindu {
namespace {

using Pictures = std::vector<DotList>;  // of each camera

struct PoseError {
  double eye_m = 0, depth_m = 0, rotation_rad = 0;
};

/// Sums of squares, and what they come to.
class Tally {
 public:
  void add(const PoseError& error) {
    eye2_ += error.eye_m * error.eye_m;
    depth2_ += error.depth_m * error.depth_m;
    rotation2_ += error.rotation_rad * error.rotation_rad;
    ++right_;
  }
  void add_wrong() { ++wrong_; }
  void add_level(TrackingLevel level) { ++levels_.at(static_cast<std::size_t>(level)); }

  bool empty() const { return right_ == 0; }
  double eye_m() const { return std::sqrt(eye2_ / std::max(1, right_)); }

  FrameErrors errors(int poses) const {
    const double all = std::max(1, poses), right = std::max(1, right_);
    return {.found = (right_ + wrong_) / all,
            .wrong = wrong_ / all,
            .eye_m = eye_m(),
            .lateral_m = std::sqrt((eye2_ - depth2_) / right),
            .depth_m = std::sqrt(depth2_ / right),
            .rotation_rad = std::sqrt(rotation2_ / right),
            .levels = {levels_[0] / all, levels_[1] / all, levels_[2] / all}};
  }

 private:
  int right_ = 0, wrong_ = 0;
  std::array<int, 3> levels_{};  // those that the thesis' method has
  double eye2_ = 0, depth2_ = 0, rotation2_ = 0;
};

/// Through the bytes of a report.
DotList picture(EmulatedSensor& sensor, const Rigid3& room_from_head) {
  const auto bytes = encode_report_0x33(sensor.look(room_from_head));
  const ParsedReport parsed = parse_report(bytes);
  assert(parsed.report);
  const auto& data = std::get<DataReport>(*parsed.report);
  return data.slots ? dots_of(*data.slots) : DotList{};
}

class Study {
 public:
  explicit Study(const FrameStudyOptions& options)
      : options_(options), configs_(cameras_of(options.row)), random_(options.seed) {
    for (std::size_t i = 0; i < configs_.size(); ++i) {
      models_.emplace_back(configs_[i]);
      onlookers_.emplace_back(configs_[i]);
      sensors_.push_back(sensor(configs_[i], options.head, i + 1));
    }
    outermost_ = {configs_.front(), configs_.back()};
    for (const CameraConfig& camera : outermost_)
      thesis_sensors_.push_back(sensor(camera, HeadConfig{}, 100 + thesis_sensors_.size()));
  }

  FrameStudy run() {
    constexpr int kTries = 20;  // for each pose, before the geometry is given up
    FrameStudy study;
    while (study.poses < options_.poses && study.passed_over < kTries * options_.poses)
      ++(judge(head_somewhere(random_)) ? study.poses : study.passed_over);
    study.joint = joint_tally_.errors(study.poses);
    study.bound = bound_tally_.errors(study.poses);
    if (thesis_takes_part()) study.thesis = thesis_tally_.errors(study.poses);
    if (!thesis_of_both_.empty())
      study.joint_over_thesis = joint_of_both_.eye_m() / thesis_of_both_.eye_m();
    return study;
  }

 private:
  EmulatedSensor sensor(const CameraConfig& camera, const HeadConfig& head, std::size_t number) {
    return {camera, head, options_.noise_px, options_.seed + 0x9e3779b97f4a7c15ULL * number};
  }

  /// False where a camera does not see every LED.
  bool judge(const Rigid3& truth) {
    const std::size_t leds = options_.head.leds_in_head.size();
    Pictures pictures;
    for (EmulatedSensor& sensor : sensors_) pictures.push_back(picture(sensor, truth));
    if (std::ranges::any_of(pictures, [&](const DotList& dots) { return dots.size() != leds; }))
      return false;
    const std::vector<bool> left =
        options_.dots_of_last ? choose(*options_.dots_of_last) : std::vector<bool>(leds, true);
    pictures.back() = without(pictures.back(), left, truth);
    const Sight sight = sight_of(truth, left);
    const Vec3 axis = sight.towards.normalized();
    const auto error = error_of(find(pictures), options_.head, truth, axis, joint_tally_);
    if (error) {
      const PoseBound bound = unaided_bound_of(sight);
      bound_tally_.add({bound.eye_m, bound.depth_m, bound.rotation_rad});
    }
    if (!thesis_takes_part()) return true;
    const auto by_thesis = find_by_thesis(options_.dots_of_last ? pictures : whole_pictures(truth));
    const auto of_thesis = error_of(by_thesis, HeadConfig{}, truth, axis, thesis_tally_);
    if (!error || !of_thesis) return true;
    joint_of_both_.add(*error);
    thesis_of_both_.add(*of_thesis);
    return true;
  }

  std::vector<bool> choose(int count) {
    std::vector<bool> chosen(options_.head.leds_in_head.size(), false);
    for (int left = std::min(count, static_cast<int>(chosen.size())); left > 0;) {
      const auto led =
          static_cast<std::size_t>(random_.uniform(0, static_cast<double>(chosen.size())));
      if (!chosen[led]) chosen[led] = true, --left;
    }
    return chosen;
  }

  /// The dots that are nearest to where the LEDs which are not left have theirs are taken away.
  DotList without(const DotList& dots, const std::vector<bool>& left, const Rigid3& truth) const {
    std::vector<Dot> rest(dots.begin(), dots.end());
    const CameraModel& camera = models_.back();
    for (std::size_t led = 0; led < left.size(); ++led) {
      if (left[led]) continue;
      const auto raw_px =
          camera.project(camera.camera_from_room() * (truth * options_.head.leds_in_head[led]));
      rest.erase(std::ranges::min_element(
          rest, {}, [&](const Dot& dot) { return (Vec2(dot.x_px, dot.y_px) - *raw_px).norm(); }));
    }
    DotList kept;
    for (const Dot& dot : rest) kept.push_back(dot);
    return kept;
  }

  Sight sight_of(const Rigid3& truth, const std::vector<bool>& left) const {
    const double sigma_px = rounded_noise_px(options_.noise_px);
    Sight sight;
    for (std::size_t i = 0; i < onlookers_.size(); ++i)
      sight += onlookers_[i].look(options_.head, truth,
                                  [&](std::size_t led, const Vec3&) -> std::optional<double> {
                                    if (i + 1 == onlookers_.size() && !left[led])
                                      return std::nullopt;
                                    return sigma_px;
                                  });
    return sight;
  }

  std::optional<Rigid3> find(const Pictures& pictures) const {
    std::vector<CameraView> views;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      CameraView view{.camera = static_cast<int>(i),
                      .dots_px = {},
                      .sigma_px = rounded_noise_px(options_.noise_px)};
      for (const Dot& dot : pictures[i]) view.dots_px.emplace_back(dot.x_px, dot.y_px);
      views.push_back(std::move(view));
    }
    const auto found = find_head(models_, views, options_.head.leds_in_head);
    if (!found) return std::nullopt;
    return found->fit.room_from_head;
  }

  bool thesis_takes_part() const {
    return !options_.dots_of_last ||
           (configs_.size() == 2 && options_.head.leds_in_head == HeadConfig{}.leds_in_head);
  }

  Pictures whole_pictures(const Rigid3& truth) {
    Pictures pictures;
    for (EmulatedSensor& sensor : thesis_sensors_) pictures.push_back(picture(sensor, truth));
    return pictures;
  }

  std::optional<Rigid3> find_by_thesis(const Pictures& pictures) {
    const auto mode = options_.dots_of_last ? ThesisMode::automatic : ThesisMode::six_dof;
    ThesisMethod method(outermost_, HeadConfig{}, {.mode = mode});
    for (std::size_t i = 0; i < pictures.size(); ++i)
      method.absorb({static_cast<int>(i), Time{}, pictures[i]});
    const ThesisResult result = method.track(Time{});
    if (!result.pose) return std::nullopt;
    thesis_tally_.add_level(result.pose->level);
    return result.pose->room_from_head;
  }

  /// Empty where nothing, or something wrong, was found.
  static std::optional<PoseError> error_of(const std::optional<Rigid3>& found,
                                           const HeadConfig& head, const Rigid3& truth,
                                           const Vec3& axis_in_room, Tally& tally) {
    constexpr double kWrong_m = 0.060, kWrong_rad = radians(20);
    if (!found) return std::nullopt;
    const Vec3 eye_error_m = *found * head.eye_in_head - truth * head.eye_in_head;
    const PoseError error{eye_error_m.norm(), eye_error_m.dot(axis_in_room),
                          found->rotation.angularDistance(truth.rotation)};
    if (!(error.eye_m <= kWrong_m && error.rotation_rad <= kWrong_rad)) {
      tally.add_wrong();
      return std::nullopt;
    }
    tally.add(error);
    return error;
  }

  FrameStudyOptions options_;
  std::vector<CameraConfig> configs_;
  std::vector<CameraModel> models_;
  std::vector<Onlooker> onlookers_;
  std::vector<EmulatedSensor> sensors_;
  std::vector<CameraConfig> outermost_;
  std::vector<EmulatedSensor> thesis_sensors_;
  Random random_;
  Tally joint_tally_, bound_tally_, thesis_tally_;
  Tally joint_of_both_, thesis_of_both_;
};

}  // namespace

HeadConfig four_led_head() {
  HeadConfig head;
  head.leds_in_head = {{-0.10, 0, -0.09}, {0, 0.06, 0}, {0.10, -0.02, -0.09}, {0.03, -0.06, -0.02}};
  return head;
}

std::vector<CameraConfig> cameras_of(const CameraRow& row) {
  constexpr double kHeight_m = 2.3, kRadioLag_ms = 6;
  assert(row.cameras >= 2);
  std::vector<CameraConfig> cameras;
  for (int i = 0; i < row.cameras; ++i) {
    CameraConfig camera;
    camera.name = "camera-" + std::to_string(i);
    camera.lag_ms = kRadioLag_ms;
    const double x_m = row.baseline_m * (static_cast<double>(i) / (row.cameras - 1) - 0.5);
    camera.room_from_camera =
        look_at({x_m, kHeight_m, kHeadPlace_in_room.z() + row.distance_m}, kHeadPlace_in_room);
    cameras.push_back(camera);
  }
  return cameras;
}

Rigid3 head_somewhere(Random& random) {
  const auto within = [&](double half) { return random.uniform(-half, half); };
  const Quat yaw(Eigen::AngleAxisd(within(radians(25)), Vec3::UnitY()));
  const Quat pitch(Eigen::AngleAxisd(within(radians(15)), Vec3::UnitX()));
  const Quat roll(Eigen::AngleAxisd(within(radians(10)), Vec3::UnitZ()));
  const double x_m = within(0.3), y_m = within(0.15);
  return {yaw * pitch * roll, kHeadPlace_in_room + Vec3(x_m, y_m, within(0.3))};
}

FrameStudy study_frames(const FrameStudyOptions& options) { return Study(options).run(); }

}  // namespace vindu
