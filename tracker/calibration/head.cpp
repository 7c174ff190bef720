#include "tracker/calibration/head.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "core/error.h"
#include "tracker/calibration/lens.h"
#include "tracker/calibration/median.h"
#include "tracker/camera_model.h"
#include "tracker/point_fit.h"

namespace vindu {
namespace {

using Points = std::vector<Vec3>;
using Order = std::vector<std::size_t>;

constexpr double kGap_m = 0.03;       // by which rays of one LED may pass each other
constexpr double kWorstMisfit_m = 1;  // of no moments: worse than any
constexpr double kMisfit_m = 0.02;    // rms of a moment's points from the helmet's
constexpr std::size_t kTrials = 60;   // moments that choose the shape
constexpr std::size_t kFewestHeadMoments = 50;
constexpr std::size_t kFewestLeds = 3, kMostLeds = 8;

/// What two cameras saw at one time, all LEDs in both; and, once they are matched, which is which.
struct Moment {
  double t_s = 0;
  std::vector<Vec2> a_px, b_px;  // image
  Order of_a, of_b;              // dot of each LED
  Rigid3 room_from_shape;
};

std::vector<Vec2> dots_at(const CameraTrack& track, double t_s, std::size_t count) {
  const auto after = std::ranges::lower_bound(track.pictures, t_s, {}, &CameraTrack::Picture::t_s);
  if (after == track.pictures.end() || after == track.pictures.begin()) return {};
  const auto before = after - 1;
  if (after->t_s - before->t_s > 0.05 || before->dots_px.size() != count ||
      after->dots_px.size() != count)
    return {};
  const double share = (t_s - before->t_s) / (after->t_s - before->t_s);
  std::vector<Vec2> dots;
  for (const Vec2& dot : before->dots_px) {
    const auto next = std::ranges::min_element(
        after->dots_px, {}, [&](const Vec2& other) { return (other - dot).norm(); });
    if ((*next - dot).norm() > 30) return {};
    dots.emplace_back((1 - share) * dot + share * *next);
  }
  return dots;
}

std::vector<Moment> moments_of(const std::vector<CameraTrack>& tracks,
                               const std::vector<CameraConfig>& cameras, std::size_t a,
                               std::size_t b, std::size_t leds) {
  std::vector<Moment> moments;
  if (tracks[a].pictures.empty() || tracks[b].pictures.empty()) return moments;
  for (double t_s = tracks[a].pictures.front().t_s; t_s < tracks[a].pictures.back().t_s;
       t_s += 0.04) {
    Moment moment{t_s,
                  dots_at(tracks[a], t_s + 1e-3 * cameras[a].lag_ms, leds),
                  dots_at(tracks[b], t_s + 1e-3 * cameras[b].lag_ms, leds),
                  {},
                  {},
                  {}};
    if (!moment.a_px.empty() && !moment.b_px.empty()) moments.push_back(std::move(moment));
  }
  return moments;
}

CameraConfig with_image_dots(CameraConfig camera) {
  camera.source = CameraSource::video;  // whose dots are image coordinates
  return camera;
}

/// Where the rays of two dots nearly meet: they may be one LED.
struct Crossing {
  std::size_t a = 0, b = 0;  // the dots
  Vec3 x_in_room;
  double gap_m = 0;
};
using Crossings = std::vector<Crossing>;

Crossings cross(const CameraModel& a, const CameraModel& b, const Moment& moment) {
  Crossings crossings;
  for (std::size_t i = 0; i < moment.a_px.size(); ++i)
    for (std::size_t j = 0; j < moment.b_px.size(); ++j) {
      const auto point = triangulate(a.ray_through(moment.a_px[i]), b.ray_through(moment.b_px[j]));
      if (point && point->gap_m < kGap_m)
        crossings.push_back({i, j, point->x_in_room, point->gap_m});
    }
  return crossings;
}

/// Goes through the ways to choose a crossing for each LED, no dot twice.
class Matching {
 public:
  explicit Matching(const Crossings& crossings) : crossings_(crossings) {}

  /// Calls `done(chosen)` for all of `count` crossings of which each may be, beside those chosen
  /// before it: `fits(crossing, chosen)`.
  template <class Fits, class Done>
  void each(std::size_t count, Fits fits, Done done) {
    if (chosen_.size() == count) return done(chosen_);
    for (const Crossing& crossing : crossings_) {
      const auto shares_a_dot = [&](const Crossing& other) {
        return other.a == crossing.a || other.b == crossing.b;
      };
      if (std::ranges::any_of(chosen_, shares_a_dot) || !fits(crossing, chosen_)) continue;
      chosen_.push_back(crossing);
      each(count, fits, done);
      chosen_.pop_back();
    }
  }

 private:
  const Crossings& crossings_;
  Crossings chosen_;
};

Points points_of(const Crossings& crossings) {
  Points points;
  for (const Crossing& crossing : crossings) points.push_back(crossing.x_in_room);
  return points;
}

/// The labels for which a moment's points fit the shape best, turned from it by less than 75
/// degrees; the misfit, or a large one. LEDs in the order of the shape.
double match(const Crossings& crossings, const Points& shape, Moment& moment) {
  constexpr double kOff_m = 2 * kMisfit_m;  // of a distance between two
  double least_m = kWorstMisfit_m;
  const auto rigid = [&](const Crossing& next, const Crossings& chosen) {
    const Vec3& led = shape[chosen.size()];
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (std::abs((next.x_in_room - chosen[i].x_in_room).norm() - (led - shape[i]).norm()) >
          kOff_m)
        return false;
    return true;
  };
  Matching(crossings).each(shape.size(), rigid, [&](const Crossings& chosen) {
    const PointFit fit = fit_points(points_of(chosen), shape);
    const bool upright = Eigen::AngleAxisd(fit.rotation).angle() < radians(75);
    if (!upright || fit.rms >= least_m) return;
    least_m = fit.rms;
    moment.of_a.clear(), moment.of_b.clear();
    for (const Crossing& crossing : chosen) {
      moment.of_a.push_back(crossing.a);
      moment.of_b.push_back(crossing.b);
    }
    moment.room_from_shape = Rigid3::from(fit.rotation, fit.translation);
  });
  return least_m;
}

/// Each farthest from those before it: the first ones tell most of how the others lie.
Points far_first(Points points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto chosen = std::span(points).first(i);
    const auto distance = [&](const Vec3& point) {
      double nearest_m = kWorstMisfit_m;
      for (const Vec3& other : chosen) nearest_m = std::min(nearest_m, (point - other).norm());
      return nearest_m;
    };
    const auto rest = points.begin() + static_cast<std::ptrdiff_t>(i);
    std::iter_swap(rest, std::ranges::max_element(rest, points.end(), {}, distance));
  }
  return points;
}

/// The shapes that one moment allows, those whose rays meet most closely first.
std::vector<Points> shapes_of(const Crossings& crossings, std::size_t leds) {
  constexpr std::size_t kMost = 100;
  std::vector<std::pair<double, Points>> shapes;
  const auto in_order = [](const Crossing& next, const Crossings& chosen) {
    return next.a == chosen.size();
  };
  Matching(crossings).each(leds, in_order, [&](const Crossings& chosen) {
    double square_m2 = 0;
    for (const Crossing& crossing : chosen) square_m2 += crossing.gap_m * crossing.gap_m;
    shapes.emplace_back(square_m2, points_of(chosen));
  });
  std::ranges::sort(shapes, {}, &std::pair<double, Points>::first);
  if (shapes.size() > kMost) shapes.resize(kMost);
  std::vector<Points> closest;
  for (auto& [square_m2, points] : shapes) closest.push_back(far_first(std::move(points)));
  return closest;
}

/// The shape, as one moment allows it, that the others fit best; empty: none does.
Points choose_shape(std::size_t from, const std::vector<Crossings>& crossings,
                    const std::vector<Moment>& moments) {
  Points best;
  double least_m = kMisfit_m;
  for (const Points& shape : shapes_of(crossings[from], moments[from].a_px.size())) {
    std::vector<double> misfits_m;
    const std::size_t step = std::max<std::size_t>(1, moments.size() / kTrials);
    for (std::size_t i = 0; i < moments.size(); i += step) {
      Moment moment = moments[i];
      misfits_m.push_back(match(crossings[i], shape, moment));
    }
    if (const double misfit_m = median(misfits_m, kWorstMisfit_m); misfit_m < least_m)
      least_m = misfit_m, best = shape;
  }
  return best;
}

/// By the first moment; where its rays leave too much open, by later ones.
Points choose_shape(const std::vector<Crossings>& crossings, const std::vector<Moment>& moments) {
  constexpr std::size_t kMoments = 6;
  Points shape;
  for (std::size_t i = 0; i < kMoments && shape.empty(); ++i)
    shape = choose_shape(i * moments.size() / kMoments, crossings, moments);
  return shape;
}

struct HeadCost {
  Vec2 dot_px;
  Lens lens;
  Rigid3 camera_from_room;

  template <class T>
  bool operator()(const T* turn, const T* place, const T* led, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(turn);
    const Vector3 x_in_room =
        rotation * Eigen::Map<const Vector3>(led) + Eigen::Map<const Vector3>(place);
    const Vector3 x_in_camera =
        camera_from_room.rotation.cast<T>() * x_in_room + camera_from_room.translation.cast<T>();
    const Eigen::Matrix<T, 9, 1> parameters = lens.cast<T>();
    Eigen::Matrix<T, 2, 1> image_px;
    if (!project<T>(parameters.data(), x_in_camera, image_px)) return false;
    residual[0] = T(dot_px.x()) - image_px.x();
    residual[1] = T(dot_px.y()) - image_px.y();
    return true;
  }
};

/// All poses and LEDs together; the first pose stays. Returns the rms in pixels.
double adjust(const CameraConfig& a, const CameraConfig& b, std::vector<Moment>& moments,
              Points& shape) {
  ceres::Problem problem;
  for (Moment& moment : moments) {
    double* turn = moment.room_from_shape.rotation.coeffs().data();
    double* place = moment.room_from_shape.translation.data();
    problem.AddParameterBlock(turn, 4, new ceres::EigenQuaternionManifold);
    for (std::size_t led = 0; led < shape.size(); ++led)
      for (const bool first : {true, false}) {
        const CameraConfig& camera = first ? a : b;
        const Vec2& dot = first ? moment.a_px[moment.of_a[led]] : moment.b_px[moment.of_b[led]];
        auto* cost =
            new HeadCost{dot, lens_of(camera.intrinsics), inverse(camera.room_from_camera)};
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeadCost, 2, 4, 3, 3>(cost),
                                 new ceres::HuberLoss(2), turn, place, shape[led].data());
      }
  }
  problem.SetParameterBlockConstant(moments[0].room_from_shape.rotation.coeffs().data());
  problem.SetParameterBlockConstant(moments[0].room_from_shape.translation.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 50;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return std::sqrt(2 * summary.final_cost / static_cast<double>(4 * shape.size() * moments.size()));
}

/// The pair of cameras that most often see all LEDs together.
std::pair<std::size_t, std::size_t> best_pair(const std::vector<CameraTrack>& tracks,
                                              const std::vector<CameraConfig>& cameras,
                                              std::size_t leds) {
  std::pair<std::size_t, std::size_t> best{0, 1};
  std::size_t most = 0;
  for (std::size_t a = 0; a < cameras.size(); ++a)
    for (std::size_t b = a + 1; b < cameras.size(); ++b)
      if (const auto count = moments_of(tracks, cameras, a, b, leds).size(); count > most)
        most = count, best = {a, b};
  return best;
}

/// What two cameras too seldom saw: as many LEDs as there are said to be. They may see another
/// number of them all the time.
Error too_few_moments(const std::vector<CameraTrack>& tracks,
                      const std::vector<CameraConfig>& cameras, std::size_t leds,
                      std::size_t moments) {
  const auto moments_of_best = [&](std::size_t count) {
    const auto [a, b] = best_pair(tracks, cameras, count);
    return moments_of(tracks, cameras, a, b, count).size();
  };
  std::size_t other = leds, of_other = 0;
  for (std::size_t count = kFewestLeds; count <= kMostLeds; ++count)
    if (const std::size_t seen = moments_of_best(count); count != leds && seen > of_other)
      other = count, of_other = seen;
  std::string remedy = "stay in view of two cameras for half a minute, turn little at a time";
  if (of_other >= kFewestHeadMoments)
    remedy = fmt::format(
        "they saw {} dots at {} moments: {}, or measure {} by --leds {}", other, of_other,
        other < leds ? "light and uncover all LEDs" : "take other lights away", other, other);
  return Error({fmt::format("two cameras saw all {} LEDs at {} moments only", leds, moments),
                "head", remedy});
}

/// The LEDs while the wearer stood still, in wall. Throws Error where he did not.
Points still_in_wall(const std::vector<Moment>& moments, const Points& shape,
                     const Rigid3& wall_from_room, double still_s) {
  Points mean(shape.size(), Vec3::Zero());
  double count = 0;
  for (const Moment& moment : moments)
    if (moment.t_s < moments[0].t_s + still_s) ++count;
  for (const Moment& moment : moments)
    for (std::size_t i = 0; i < shape.size(); ++i) {
      if (moment.t_s >= moments[0].t_s + still_s) continue;
      mean[i] += wall_from_room * (moment.room_from_shape * shape[i]) / count;
    }
  for (const Moment& moment : moments)
    if (moment.t_s < moments[0].t_s + still_s &&
        (wall_from_room * (moment.room_from_shape * shape[0]) - mean[0]).norm() > 0.04)
      throw Error(
          {"does not stand still at first", "wearer",
           fmt::format("look at the wall's middle, upright, for {:.0f} s, then move", still_s)});
  const PointFit fit = fit_points(mean, shape);
  Points leds;
  for (const Vec3& led : shape) leds.push_back(fit.rotation * led + fit.translation);
  return leds;
}

std::vector<Moment> thinned(std::vector<Moment> moments, double still_s, int most) {
  std::vector<Moment> chosen;
  std::vector<Moment> later;
  for (Moment& moment : moments)
    (moment.t_s < moments[0].t_s + still_s ? chosen : later).push_back(std::move(moment));
  const std::size_t count = std::min(later.size(), static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(later[i * later.size() / count]);
  return chosen;
}

Vec3 rearmost(const Points& leds) {
  return *std::ranges::max_element(leds, {}, [](const Vec3& led) { return led.z(); });
}

}  // namespace

HeadConfig from_rearmost(HeadConfig head) {
  const Vec3 rear = rearmost(head.leds_in_head);
  for (Vec3& led : head.leds_in_head) led -= rear;
  head.eye_in_head -= rear;
  return head;
}

void expect_measurable(int leds, const HeadConfig& head, std::span<const CameraConfig> cameras) {
  const auto count = static_cast<std::size_t>(leds);
  const std::string remedy =
      "cover the others, which it then does without, or measure all by hand and give them in the "
      "wall file: leds_m, eye_m";
  if (count < kFewestLeds || count > kMostLeds)
    throw Error({fmt::format("has {} LEDs; {} to {} can be measured", leds, kFewestLeds, kMostLeds),
                 "head " + head.name, remedy});
  std::vector<std::size_t> most;
  for (const CameraConfig& camera : cameras) most.push_back(most_dots(camera));
  std::ranges::sort(most, std::greater{});
  if (most.size() < 2)
    throw Error({"has fewer than two cameras", "wall file", "a helmet's LEDs are measured by two"});
  if (count > most[1])
    throw Error(
        {fmt::format("has {} LEDs, and no two cameras tell of more than {} dots", leds, most[1]),
         "head " + head.name, remedy});
}

HeadResult calibrate_head(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          const Rigid3& room_from_wall, const HeadConfig& head,
                          const HeadOptions& options) {
  expect_measurable(options.leds, head, cameras);
  const auto leds = static_cast<std::size_t>(options.leds);
  const auto tracks = moving_dots(capture, cameras);
  const auto [a, b] = best_pair(tracks, cameras, leds);
  auto moments =
      thinned(moments_of(tracks, cameras, a, b, leds), options.still_s, options.max_moments);
  if (moments.size() < kFewestHeadMoments)
    throw too_few_moments(tracks, cameras, leds, moments.size());
  const CameraModel model_a(with_image_dots(cameras[a])), model_b(with_image_dots(cameras[b]));
  std::vector<Crossings> crossings;
  for (const Moment& moment : moments) crossings.push_back(cross(model_a, model_b, moment));
  Points shape = choose_shape(crossings, moments);
  if (shape.empty())
    throw Error({"its dots are no rigid body", "head",
                 "calibrate the cameras first; take other lights and shiny things away"});
  std::vector<Moment> good;
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (match(crossings[i], shape, moments[i]) < kMisfit_m) good.push_back(moments[i]);
  HeadResult result;
  result.rms_px = adjust(cameras[a], cameras[b], good, shape);
  result.moments = static_cast<int>(good.size());
  Points in_wall = still_in_wall(good, shape, inverse(room_from_wall), options.still_s);
  std::ranges::sort(in_wall, {}, [](const Vec3& led) { return led.x(); });
  const Vec3 rear = rearmost(in_wall);
  result.head = from_rearmost(head);
  result.head.leds_in_head.clear();
  for (const Vec3& led : in_wall) result.head.leds_in_head.emplace_back(led - rear);
  if (options.eye_in_room)
    result.head.eye_in_head = inverse(room_from_wall) * *options.eye_in_room - rear;
  std::vector<double> misfits_m;
  for (std::size_t i = 0; i < moments.size(); ++i)
    misfits_m.push_back(match(crossings[i], shape, moments[i]));
  result.led_sigma_mm =
      1e3 * median(misfits_m, kWorstMisfit_m) / std::sqrt(static_cast<double>(good.size()));
  return result;
}

}  // namespace vindu
