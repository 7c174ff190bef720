#include "tracker/thesis_method.h"

#include <algorithm>

#include "core/error.h"

namespace vindu {
namespace {

constexpr Duration kStale = std::chrono::milliseconds(100);
constexpr Duration kForgets = std::chrono::milliseconds(300);  // where the head was

std::array<CameraModel, 2> first_two(std::span<const CameraConfig> cameras) {
  if (cameras.size() < 2)
    throw Error({"the thesis' method needs two cameras, and the file names " +
                     std::to_string(cameras.size()),
                 "[[camera]]", "add another [[camera]]"});
  return {CameraModel(cameras[0]), CameraModel(cameras[1])};
}

std::vector<Vec3> from_left_to_right(std::vector<Vec3> leds_in_head) {
  std::ranges::sort(leds_in_head, {}, [](const Vec3& led) { return led.x(); });
  return leds_in_head;
}

// The head's own frame need not be the l-m-r frame of its LEDs; for the thesis' helmet it is.
Rigid3 lmr_from_head(std::span<const Vec3> leds_in_head) {
  const auto fail = [](const std::string& what) {
    throw Error(
        {what, "[head] leds_m", "use leds_m = [[-0.09, 0, -0.09], [0, 0, 0], [0.09, 0, -0.09]]"});
  };
  if (leds_in_head.size() != kLmrLeds)
    fail("the thesis' method needs three LEDs, not " + std::to_string(leds_in_head.size()));
  const auto frame = lmr_frame(leds_in_head[0], leds_in_head[1], leds_in_head[2]);
  if (!frame) fail("three LEDs on one line give no orientation");
  return inverse(*frame);
}

std::optional<NoPose> trouble_with_counts(std::size_t first, std::size_t second) {
  if (std::min(first, second) < kLmrLeds) return NoPose::too_few_dots;
  if (first != second) return NoPose::unequal_counts;
  if (first > kLmrLeds) return NoPose::too_many_dots;
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
    : options_(options),
      cameras_(first_two(cameras)),
      leds_in_head_(from_left_to_right(head.leds_in_head)) {
  if (options.mode != ThesisMode::position) lmr_from_head_ = lmr_from_head(leds_in_head_);
}

void ThesisMethod::absorb(const Observation& observation) {
  const auto camera = static_cast<std::size_t>(observation.camera);
  if (camera >= freshest_.size()) return;
  if (!freshest_[camera] || freshest_[camera]->arrival <= observation.arrival)
    freshest_[camera] = observation;
}

ThesisMethod::Rays ThesisMethod::sorted_rays(std::size_t camera, Time now) const {
  const auto& seen = freshest_[camera];
  if (!seen || now - seen->arrival > kStale) return {};
  DotList dots = seen->dots;
  std::ranges::sort(dots, {}, &Dot::x_px);
  Rays rays;
  rays.reserve(dots.size());
  for (const Dot& dot : dots) rays.push_back(cameras_[camera].ray_through({dot.x_px, dot.y_px}));
  return rays;
}

ThesisMethod::Found ThesisMethod::six_dof(const Rays& first, const Rays& second) const {
  if (const auto trouble = trouble_with_counts(first.size(), second.size()))
    return {.reason = *trouble};
  Found found;
  for (std::size_t i = 0; i < kLmrLeds; ++i) {
    const auto point = triangulate(first[i], second[i]);
    if (!point || point->gap_m > options_.largest_gap_m) {
      found.reason = NoPose::rays_do_not_meet;
      return found;
    }
    found.points.push_back(*point);
  }
  std::ranges::sort(found.points, {}, [](const TriangulatedPoint& p) { return p.x_in_room.x(); });
  const auto room_from_lmr =
      lmr_frame(found.points[0].x_in_room, found.points[1].x_in_room, found.points[2].x_in_room);
  if (room_from_lmr) found.room_from_head = *room_from_lmr * lmr_from_head_;
  found.reason = NoPose::degenerate;
  return found;
}

bool ThesisMethod::knows_where_it_was(Time now) const {
  return last_found_ && now - *last_found_ <= kForgets;
}

std::optional<LmrPoints> ThesisMethod::expected_lmr(Time now) const {
  if (!knows_where_it_was(now)) return std::nullopt;
  return LmrPoints{last_room_from_head_ * leds_in_head_[0], last_room_from_head_ * leds_in_head_[1],
                   last_room_from_head_ * leds_in_head_[2]};
}

ThesisMethod::Found ThesisMethod::hybrid(const Rays& first, const Rays& second, Time now) const {
  const LmrPoints lmr_in_head{leds_in_head_[0], leds_in_head_[1], leds_in_head_[2]};
  const auto best =
      best_candidate(hybrid_candidates(first, second, lmr_in_head, options_.largest_gap_m),
                     expected_lmr(now), {options_.largest_misfit_m, options_.largest_step_m});
  if (!best) return {};
  const auto [left, middle, right] = best->lmr_in_room();
  const auto room_from_lmr = lmr_frame(left, middle, right);
  if (!room_from_lmr) return {};
  return {.level = TrackingLevel::hybrid,
          .room_from_head = *room_from_lmr * lmr_from_head_,
          .points = {best->points.begin(), best->points.end()}};
}

// Of all pairs of rays that meet, and all LEDs that the point may be, the pair and the LED for
// which the head has moved least. Where it was not known before: of rays of the same rank, or all
// where the cameras see unlike numbers, the two that meet best; the LED is that of its rank in a
// camera that sees all, or else the middle one.
ThesisMethod::Found ThesisMethod::position(const Rays& first, const Rays& second, Time now) const {
  const bool knows = knows_where_it_was(now);
  const std::size_t leds = leds_in_head_.size();
  const Quat& rotation = last_room_from_head_.rotation;
  Found best{
      .level = TrackingLevel::position,
      .reason = first.empty() || second.empty() ? NoPose::too_few_dots : NoPose::rays_do_not_meet};
  double least_m = knows ? options_.largest_step_m : options_.largest_gap_m;
  const auto consider = [&](const TriangulatedPoint& point, std::size_t led, double cost_m) {
    if (cost_m > least_m) return;
    least_m = cost_m;
    best.room_from_head = {rotation, point.x_in_room - rotation * leds_in_head_[led]};
    best.points = {point};
  };
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j) {
      const auto point = triangulate(first[i], second[j]);
      if (!point || point->gap_m > options_.largest_gap_m) continue;
      if (knows) {
        for (std::size_t led = 0; led < leds; ++led)
          consider(*point, led,
                   (point->x_in_room - last_room_from_head_ * leds_in_head_[led]).norm());
      } else if (first.size() != second.size() || i == j) {
        const std::size_t rank = first.size() == leds ? i : second.size() == leds ? j : leds / 2;
        consider(*point, rank, point->gap_m);
      }
    }
  return best;
}

/// Without a pose: the reason and the points of the best way that was tried.
ThesisMethod::Found ThesisMethod::find(const Rays& first, const Rays& second, Time now) const {
  const ThesisMode mode = options_.mode;
  if (mode == ThesisMode::position) return position(first, second, now);
  Found whole = six_dof(first, second);
  if (whole.room_from_head || mode == ThesisMode::six_dof) return whole;
  Found parts = hybrid(first, second, now);
  if (parts.room_from_head) return parts;
  if (mode == ThesisMode::hybrid) return whole;
  Found point = position(first, second, now);
  return point.room_from_head ? point : whole;
}

ThesisResult ThesisMethod::track(Time now) {
  Found found = find(sorted_rays(0, now), sorted_rays(1, now), now);
  ThesisResult result{.pose = {}, .reason = found.reason, .points = std::move(found.points)};
  if (!found.room_from_head) return result;
  last_room_from_head_ = *found.room_from_head;
  last_found_ = now;
  PoseSample pose;
  pose.capture_time = std::max(freshest_[0]->arrival, freshest_[1]->arrival);
  pose.time = pose.capture_time;
  pose.level = found.level;
  pose.room_from_head = last_room_from_head_;
  result.pose = pose;
  return result;
}

}  // namespace vindu
