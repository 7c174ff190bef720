#include "tracker/calibration/wand_start.h"

#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "core/error.h"
#include "core/random.h"
#include "tracker/camera_model.h"
#include "tracker/triangulation.h"

namespace vindu {
namespace {

constexpr int kFewestTogether = 40;  // moments of a pair of cameras
constexpr int kSamples = 500;
constexpr int kLagSamples = 120;  // for each lag that is tried
constexpr std::array kLags_ms = {0.0, -30.0, 30.0, -60.0, 60.0, -90.0, 90.0, -120.0, 120.0};
constexpr double kGate_px = 6;  // off the epipolar line: the lens is known roughly only

/// A wand as two cameras saw it: dots on the plane at distance 1.
struct PairView {
  std::vector<Vec2> a, b;
};

Vec2 on_plane(const Lens& lens, const Vec2& image_px) {
  return {(image_px.x() - lens[2]) / lens[0], (image_px.y() - lens[3]) / (lens[0] * lens[1])};
}

std::vector<Vec2> on_plane(const WandWorld& world, const WandView& view, double t_s) {
  const AdjustedCamera& camera = world.cameras[static_cast<std::size_t>(view.camera)];
  const double late_s = t_s - view.t_s + 1e-3 * camera.lag_ms;
  std::vector<Vec2> points;
  for (std::size_t led = 0; led < view.dots_px.size(); ++led)
    points.push_back(on_plane(camera.lens, view.dots_px[led] + late_s * view.speed_px_s[led]));
  return points;
}

const WandView* view_of(const WandMoment& moment, int camera) {
  const auto view = std::ranges::find(moment.views, camera, &WandView::camera);
  return view == moment.views.end() ? nullptr : &*view;
}

/// First-order distance from the epipolar lines, squared (Sampson).
double sampson2(const Mat3& essential, const Vec2& a, const Vec2& b) {
  const Vec3 line_b = essential * a.homogeneous(), line_a = essential.transpose() * b.homogeneous();
  const double off = b.homogeneous().dot(line_b);
  return off * off / (line_b.head<2>().squaredNorm() + line_a.head<2>().squaredNorm());
}

double error2(const Mat3& essential, const PairView& view, bool turned) {
  const std::size_t last = view.a.size() - 1;
  return std::max(sampson2(essential, view.a[0], view.b[turned ? last : 0]),
                  sampson2(essential, view.a[last], view.b[turned ? 0 : last]));
}

std::vector<Mat3> essentials_of(const std::array<const PairView*, 3>& sample, unsigned turns) {
  std::vector<cv::Point2d> a, b;
  for (std::size_t i = 0; i < 5; ++i) {  // five of six ends
    const PairView& view = *sample[i / 2];
    const bool first = i % 2 == 0, turned = turns >> (i / 2) & 1;
    const Vec2 &in_a = first ? view.a.front() : view.a.back(),
               &in_b = first != turned ? view.b.front() : view.b.back();
    a.emplace_back(in_a.x(), in_a.y());
    b.emplace_back(in_b.x(), in_b.y());
  }
  const cv::Mat stacked = cv::findEssentialMat(a, b, cv::Mat::eye(3, 3, CV_64F), cv::RANSAC);
  std::vector<Mat3> found;
  for (int row = 0; row + 2 < stacked.rows; row += 3) {
    Mat3 essential;
    for (int i = 0; i < 9; ++i) essential(i / 3, i % 3) = stacked.at<double>(row + i / 3, i % 3);
    if (essential.allFinite()) found.push_back(essential);
  }
  return found;
}

struct Essential {
  Mat3 matrix = Mat3::Zero();
  double cost = 1e300;
};

/// The one that most views agree with (MSAC: Torr & Zisserman 2000).
Essential best_essential(const std::vector<PairView>& views, double gate, int samples,
                         Random& random) {
  const auto any = [&] {
    return &views[static_cast<std::size_t>(random.uniform(0, static_cast<double>(views.size())))];
  };
  Essential best;
  for (int i = 0; i < samples; ++i) {
    const auto turns = static_cast<unsigned>(random.uniform(0, 8));
    for (const Mat3& essential : essentials_of({any(), any(), any()}, turns)) {
      double cost = 0;
      for (const PairView& view : views) {
        cost +=
            std::min({gate * gate, error2(essential, view, false), error2(essential, view, true)});
        if (cost >= best.cost) break;
      }
      if (cost < best.cost) best = {essential, cost};
    }
  }
  return best;
}

Ray ray_of(const Rigid3& world_from_camera, const Vec2& on_plane) {
  return {world_from_camera.translation,
          world_from_camera.rotation * on_plane.homogeneous().normalized()};
}

/// Both outer LEDs, where the rays of two cameras meet.
std::optional<std::array<Vec3, 2>> ends_of(const PairView& view, const Rigid3& a_from_b,
                                           bool turned) {
  const std::size_t last = view.a.size() - 1;
  const auto first =
      triangulate(ray_of({}, view.a[0]), ray_of(a_from_b, view.b[turned ? last : 0]));
  const auto second =
      triangulate(ray_of({}, view.a[last]), ray_of(a_from_b, view.b[turned ? 0 : last]));
  if (!first || !second) return std::nullopt;
  return std::array{first->x_in_room, second->x_in_room};
}

struct PairPlace {
  Rigid3 a_from_b;
  double share = 0;  ///< of the views that agree with it
};

/// Of the four poses that an essential matrix allows, the one that has most wands before both
/// cameras; the baseline is 1.
PairPlace place_from(const Mat3& essential, const std::vector<PairView>& views, double gate) {
  cv::Matx33d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = essential(i / 3, i % 3);
  cv::Matx33d turn[2];
  cv::Matx31d way;
  cv::decomposeEssentialMat(matrix, turn[0], turn[1], way);
  PairPlace best;
  for (int i = 0; i < 4; ++i) {
    Mat3 rotation;
    for (int k = 0; k < 9; ++k) rotation(k / 3, k % 3) = turn[i % 2](k / 3, k % 3);
    const Vec3 translation = (i < 2 ? 1 : -1) * Vec3(way(0), way(1), way(2));
    const Rigid3 a_from_b = inverse(Rigid3::from(rotation, translation));
    int agree = 0;
    for (const PairView& view : views) {
      const bool turned = error2(essential, view, true) < error2(essential, view, false);
      if (error2(essential, view, turned) < gate * gate && ends_of(view, a_from_b, turned)) ++agree;
    }
    const double share = static_cast<double>(agree) / static_cast<double>(views.size());
    if (share > best.share) best = {a_from_b, share};
  }
  return best;
}

/// The baseline for which the median of the wands has its length.
double scale_of(const Mat3& essential, const PairPlace& place, const std::vector<PairView>& views,
                double length_m) {
  std::vector<double> lengths;
  for (const PairView& view : views) {
    const bool turned = error2(essential, view, true) < error2(essential, view, false);
    if (const auto ends = ends_of(view, place.a_from_b, turned))
      lengths.push_back(((*ends)[1] - (*ends)[0]).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  return length_m / *middle;
}

std::vector<PairView> common_views(const std::vector<WandMoment>& moments, const WandWorld& world,
                                   int a, int b) {
  std::vector<PairView> views;
  for (const WandMoment& moment : moments)
    if (const WandView* in_a = view_of(moment, a), *in_b = view_of(moment, b); in_a && in_b)
      views.push_back({on_plane(world, *in_a, moment.t_s), on_plane(world, *in_b, moment.t_s)});
  return views;
}

/// Sets the second camera's lag to the best of some.
void find_lag(const std::vector<WandMoment>& moments, int a, int b, double gate, Random& random,
              WandWorld& world) {
  double& lag_ms = world.cameras[static_cast<std::size_t>(b)].lag_ms;
  const double about_ms = lag_ms;
  double best_cost = 1e300, best_lag_ms = lag_ms;
  for (const double more_ms : kLags_ms) {
    lag_ms = about_ms + more_ms;
    const auto views = common_views(moments, world, a, b);
    const double cost = best_essential(views, gate, kLagSamples, random).cost;
    if (cost < 0.9 * best_cost) best_cost = cost, best_lag_ms = lag_ms;
  }
  lag_ms = best_lag_ms;
}

std::optional<PairPlace> place_pair(const std::vector<WandMoment>& moments, int a, int b,
                                    Random& random, WandWorld& world) {
  const double gate = kGate_px / world.cameras[static_cast<std::size_t>(b)].lens[0];
  find_lag(moments, a, b, gate, random, world);
  const auto views = common_views(moments, world, a, b);
  const Mat3 essential = best_essential(views, gate, kSamples, random).matrix;
  PairPlace place = place_from(essential, views, gate);
  if (place.share < 0.4) return std::nullopt;
  place.a_from_b.translation *=
      scale_of(essential, place, views, world.leds_m.back() - world.leds_m.front());
  return place;
}

/// A tree over the cameras: each is placed against the placed one with which it has most moments in
/// common.
void place_cameras(const std::vector<WandMoment>& moments, const std::vector<std::string>& names,
                   Random& random, WandWorld& world) {
  const std::size_t count = world.cameras.size();
  std::vector<bool> placed(count, false);
  placed[0] = true;
  std::vector<std::vector<bool>> tried(count, std::vector<bool>(count, false));
  for (std::size_t left = count - 1; left > 0;) {
    std::size_t from = 0, to = 0, most = 0;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        if (placed[a] && !placed[b] && !tried[a][b])
          if (const auto together = static_cast<std::size_t>(
                  std::ranges::count_if(moments,
                                        [&](const WandMoment& moment) {
                                          return view_of(moment, static_cast<int>(a)) &&
                                                 view_of(moment, static_cast<int>(b));
                                        }));
              together > most)
            from = a, to = b, most = together;
    if (most < kFewestTogether) {
      const auto lost = static_cast<std::size_t>(std::ranges::find(placed, false) - placed.begin());
      const bool seldom = std::ranges::none_of(tried, [&](const auto& row) { return row[lost]; });
      throw Error(seldom
                      ? ErrorText{"hardly ever sees the wand together with another camera",
                                  "camera " + names[lost],
                                  "wave it where this camera's view overlaps with others'"}
                      : ErrorText{"no place of it explains what it saw with the others",
                                  "camera " + names[lost],
                                  "keep all cameras still, take other lights away, wave slowly"});
    }
    tried[from][to] = true;
    world.cameras[to].lag_ms = world.cameras[from].lag_ms;
    const auto place =
        place_pair(moments, static_cast<int>(from), static_cast<int>(to), random, world);
    if (!place) continue;
    world.cameras[to].world_from_camera = world.cameras[from].world_from_camera * place->a_from_b;
    placed[to] = true;
    --left;
  }
}

/// Ends of the wand as the moment's first two views have them, the second turned if that is better.
std::optional<std::array<Vec3, 2>> join(const WandWorld& world, double t_s, const WandView& first,
                                        WandView& second) {
  const Rigid3& a = world.cameras[static_cast<std::size_t>(first.camera)].world_from_camera;
  const Rigid3& b = world.cameras[static_cast<std::size_t>(second.camera)].world_from_camera;
  const PairView view{on_plane(world, first, t_s), on_plane(world, second, t_s)};
  const std::size_t last = view.a.size() - 1;
  double best_gap_m = 0.15;  // more is no view of one wand
  std::optional<std::array<Vec3, 2>> ends;
  bool turn = false;
  for (const bool turned : {false, true}) {
    const auto p = triangulate(ray_of(a, view.a[0]), ray_of(b, view.b[turned ? last : 0]));
    const auto q = triangulate(ray_of(a, view.a[last]), ray_of(b, view.b[turned ? 0 : last]));
    if (!p || !q || p->gap_m + q->gap_m >= best_gap_m) continue;
    best_gap_m = p->gap_m + q->gap_m;
    ends = {p->x_in_room, q->x_in_room};
    turn = turned;
  }
  if (turn) second.reverse();
  return ends;
}

/// The wand's pose, all views turned alike; empty where they show no wand of its length.
std::optional<WandPose> place_wand(const WandWorld& world, WandMoment& moment) {
  const double length_m = world.leds_m.back() - world.leds_m.front();
  std::optional<std::array<Vec3, 2>> ends;
  for (std::size_t i = 1; i < moment.views.size(); ++i) {
    const auto found = join(world, moment.t_s, moment.views[0], moment.views[i]);
    if (!ends) ends = found;
  }
  if (!ends) return std::nullopt;
  const Vec3 way_m = (*ends)[1] - (*ends)[0];
  if (std::abs(way_m.norm() / length_m - 1) > 0.35) return std::nullopt;
  WandPose pose;
  pose << 0.5 * ((*ends)[0] + (*ends)[1]), way_m.normalized();
  return pose;
}

}  // namespace

void start_world(std::vector<WandMoment>& moments, const std::vector<std::string>& names,
                 std::uint64_t seed, WandWorld& world) {
  Random random(seed);
  place_cameras(moments, names, random, world);
  world.poses.assign(moments.size(), WandPose::Zero());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const auto pose = place_wand(world, moments[i]);
    moments[i].used = pose.has_value();
    if (pose) world.poses[i] = *pose;
  }
}

}  // namespace vindu
