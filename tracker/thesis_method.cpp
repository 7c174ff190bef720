#include "tracker/thesis_method.h"

#include <algorithm>

#include "core/error.h"

namespace vindu {
namespace {

constexpr Duration kStale = std::chrono::milliseconds(100);
constexpr std::size_t kLeds = 3;

std::array<CameraModel, 2> first_two(std::span<const CameraConfig> cameras) {
  if (cameras.size() < 2)
    throw Error({"the thesis' method needs two cameras, and the file names " +
                     std::to_string(cameras.size()),
                 "[[camera]]", "add another [[camera]]"});
  return {CameraModel(cameras[0]), CameraModel(cameras[1])};
}

// The head's own frame need not be the l-m-r frame of its LEDs; for the thesis' helmet it is.
Rigid3 lmr_from_head(const HeadConfig& head) {
  const auto fail = [](const std::string& what) {
    throw Error(
        {what, "[head] leds_m", "use leds_m = [[-0.09, 0, -0.09], [0, 0, 0], [0.09, 0, -0.09]]"});
  };
  if (head.leds_in_head.size() != kLeds)
    fail("the thesis' method needs three LEDs, not " + std::to_string(head.leds_in_head.size()));
  auto leds = head.leds_in_head;
  std::ranges::sort(leds, {}, [](const Vec3& led) { return led.x(); });
  const auto frame = lmr_frame(leds[0], leds[1], leds[2]);
  if (!frame) fail("three LEDs on one line give no orientation");
  return inverse(*frame);
}

ThesisResult without_pose(NoPose reason, std::vector<TriangulatedPoint> points = {}) {
  return {std::nullopt, reason, std::move(points)};
}

std::optional<NoPose> trouble_with_counts(std::size_t first, std::size_t second) {
  if (std::min(first, second) < kLeds) return NoPose::too_few_dots;
  if (first != second) return NoPose::unequal_counts;
  if (first > kLeds) return NoPose::too_many_dots;
  return std::nullopt;
}

}  // namespace

std::optional<Rigid3> lmr_frame(const Vec3& left, const Vec3& middle, const Vec3& right) {
  constexpr double kCoincide_m = 1e-6;
  const Vec3 line_m = right - left;
  if (!(line_m.norm() > kCoincide_m)) return std::nullopt;
  const Vec3 r = line_m.normalized();
  const Vec3 foot = left + r.dot(middle - left) * r;  // the thesis' P
  const Vec3 forward_m = foot - middle;
  if (!(forward_m.norm() > kCoincide_m)) return std::nullopt;
  const Vec3 f = forward_m.normalized();
  Mat3 rotation;
  rotation << r, r.cross(f), -f;
  return Rigid3::from(rotation, middle);
}

ThesisMethod::ThesisMethod(std::span<const CameraConfig> cameras, const HeadConfig& head,
                           const ThesisOptions& options)
    : options_(options), cameras_(first_two(cameras)), lmr_from_head_(lmr_from_head(head)) {}

void ThesisMethod::absorb(const Observation& observation) {
  const auto camera = static_cast<std::size_t>(observation.camera);
  if (camera >= freshest_.size()) return;
  if (!freshest_[camera] || freshest_[camera]->arrival <= observation.arrival)
    freshest_[camera] = observation;
}

DotList ThesisMethod::sorted_dots(std::size_t camera, Time now) const {
  const auto& seen = freshest_[camera];
  if (!seen || now - seen->arrival > kStale) return {};
  DotList dots = seen->dots;
  std::ranges::sort(dots, {}, &Dot::x_px);
  return dots;
}

ThesisResult ThesisMethod::track(Time now) const {
  const DotList first = sorted_dots(0, now), second = sorted_dots(1, now);
  if (const auto trouble = trouble_with_counts(first.size(), second.size()))
    return without_pose(*trouble);
  std::vector<TriangulatedPoint> points;
  for (std::size_t i = 0; i < kLeds; ++i) {
    const auto point = triangulate(cameras_[0].ray_through({first[i].x_px, first[i].y_px}),
                                   cameras_[1].ray_through({second[i].x_px, second[i].y_px}));
    if (!point || point->gap_m > options_.largest_gap_m)
      return without_pose(NoPose::rays_do_not_meet, std::move(points));
    points.push_back(*point);
  }
  std::ranges::sort(points, {}, [](const TriangulatedPoint& p) { return p.x_in_room.x(); });
  const auto room_from_lmr =
      lmr_frame(points[0].x_in_room, points[1].x_in_room, points[2].x_in_room);
  if (!room_from_lmr) return without_pose(NoPose::degenerate, std::move(points));
  PoseSample pose;
  pose.capture_time = std::max(freshest_[0]->arrival, freshest_[1]->arrival);
  pose.time = pose.capture_time;
  pose.level = TrackingLevel::six_dof;
  pose.room_from_head = *room_from_lmr * lmr_from_head_;
  return {pose, {}, std::move(points)};
}

}  // namespace vindu
