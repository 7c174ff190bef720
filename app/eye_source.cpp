#include "app/eye_source.h"

#include <algorithm>
#include <cmath>

namespace vindu::app {
namespace {

class PathEye final : public EyeSource {
 public:
  explicit PathEye(CameraPath path) : path_(std::move(path)) {}
  EyeNow at(Time now, Time) override {
    if (!start_) start_ = now;
    return {.eye_in_wall = path_.eye_at(seconds(now - *start_)), .mode = Mode::loop};
  }

 private:
  CameraPath path_;
  std::optional<Time> start_;
};

class PersonEye final : public EyeSource {
 public:
  explicit PersonEye(const Person& person) : person_(person) {}
  EyeNow at(Time, Time photon) override {
    return {.eye_in_wall = person_.eye_in_wall(photon), .mode = Mode::track};
  }

 private:
  const Person& person_;
};

class FixedEye final : public EyeSource {
 public:
  explicit FixedEye(const Vec3& eye_in_wall) : eye_in_wall_(eye_in_wall) {}
  EyeNow at(Time, Time) override { return {.eye_in_wall = eye_in_wall_, .mode = Mode::track}; }

 private:
  Vec3 eye_in_wall_;
};

class PointerEye final : public EyeSource {
 public:
  PointerEye(Window& window, const Wall& wall, const Vec3& start_in_wall)
      : window_(window),
        half_size_m_(wall.grid.width_m / 2, wall.grid.height_m / 2),
        start_in_wall_(start_in_wall) {}
  EyeNow at(Time, Time) override {
    distance_factor_ =
        std::clamp(distance_factor_ * std::pow(0.9, window_.take_wheel()), 0.1, 10.0);
    const Vec2 across = window_.pointer().cwiseProduct(half_size_m_);
    const Vec3 eye(across.x(), start_in_wall_.y() + across.y(),
                   start_in_wall_.z() * distance_factor_);
    return {.eye_in_wall = eye, .mode = Mode::touch};
  }

 private:
  Window& window_;
  Vec2 half_size_m_;
  Vec3 start_in_wall_;
  double distance_factor_ = 1;
};

}  // namespace

TrackedEye::TrackedEye(const Site& site, const EmulatedRoom& room, Clock& clock,
                       const TrackedEyeOptions& options)
    : tracker_(site.cameras, site.heads, site.wall.room_from_wall, site.tracking),
      ease_(site.viewer.default_eye_in_wall),
      cameras_(site, room, clock, options.cameras),
      warnings_(site),
      on_frame_(options.on_frame) {}

EyeNow TrackedEye::at(Time now, Time photon) {
  for (const auto& camera : cameras_.sources())
    while (const auto observation = camera->next(now)) tracker_.absorb(*observation);
  const std::optional<PoseSample> pose = tracker_.track(now, photon);
  warnings_.look(tracker_, now);
  if (on_frame_) on_frame_(tracker_);
  const bool known = pose && pose->level < TrackingLevel::held;
  const auto eye = known ? std::optional(tracker_.eye_in_wall(*pose)) : std::nullopt;
  const Vec3 shown = ease_.update(eye, now);
  return {.eye_in_wall = shown,
          .mode = Mode::track,
          .pose = pose,
          .tracked = eye && (shown - *eye).norm() < 1e-6};
}

FrameOrigin origin_of(const EyeNow& eye, Time tick, Time found) {
  const bool seen = eye.pose && eye.pose->level < TrackingLevel::held;
  return {.capture_time = seen ? std::optional(eye.pose->capture_time) : std::nullopt,
          .tick_time = tick,
          .eye_time = found};
}

std::unique_ptr<EyeSource> follow_path(CameraPath path) {
  return std::make_unique<PathEye>(std::move(path));
}
std::unique_ptr<EyeSource> follow_person(const Person& person) {
  return std::make_unique<PersonEye>(person);
}
std::unique_ptr<EyeSource> stay(const Vec3& eye_in_wall) {
  return std::make_unique<FixedEye>(eye_in_wall);
}
std::unique_ptr<EyeSource> follow_pointer(Window& window, const Wall& wall,
                                          const Vec3& start_in_wall) {
  return std::make_unique<PointerEye>(window, wall, start_in_wall);
}

}  // namespace vindu::app
