#include "tracker/calibration/wand_views.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tracker/calibration/median.h"

namespace vindu {
namespace {

constexpr double kShortest_px = 25;      // that a wand may appear
constexpr std::size_t kNeighbours = 8;   // pictures before and after one, that tell its speed
constexpr double kNeighbour_s = 0.25;    // not farther
constexpr double kFarthestStep_px = 80;  // a dot's, from one picture to the next
constexpr double kApart_s = 0.02;        // moments, at least
constexpr double kTogether_s = 0.02;     // pictures of one moment, at most

double distance_px(std::span<const Vec2> a, std::span<const Vec2> b) {
  double sum_px = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum_px += (a[i] - b[i]).norm();
  return sum_px / static_cast<double>(a.size());
}

/// Where between a and c the dot m stands on their line, 0 to 1; empty where it is not on it.
std::optional<double> place_between(const Vec2& a, const Vec2& m, const Vec2& c) {
  const Vec2 way = c - a;
  const double length_px = way.norm();
  if (length_px < kShortest_px) return std::nullopt;
  const Vec2 aside(-way.y(), way.x());
  const double off_px = std::abs(aside.dot(m - a)) / length_px;
  const double place = way.dot(m - a) / (length_px * length_px);
  if (off_px > std::max(2.5, 0.015 * length_px) || place < 0.08 || place > 0.92)
    return std::nullopt;
  return place;
}

/// The nearer end to the middle dot is the first or the last, as it is on the wand.
std::vector<std::vector<Vec2>> three_on_a_line(std::span<const Vec2> dots_px, bool near_first) {
  std::vector<std::vector<Vec2>> found;
  for (std::size_t a = 0; a < dots_px.size(); ++a)
    for (std::size_t c = a + 1; c < dots_px.size(); ++c)
      for (std::size_t m = 0; m < dots_px.size(); ++m) {
        if (m == a || m == c) continue;
        const auto place = place_between(dots_px[a], dots_px[m], dots_px[c]);
        if (!place) continue;
        if ((*place < 0.5) == near_first)
          found.push_back({dots_px[a], dots_px[m], dots_px[c]});
        else
          found.push_back({dots_px[c], dots_px[m], dots_px[a]});
      }
  return found;
}

std::optional<WandView> view_in(const CameraTrack::Picture& picture,
                                std::span<const double> leds_m) {
  WandView view;
  view.t_s = picture.t_s;
  view.sigma_s = picture.sigma_s;
  if (leds_m.size() == 2) {
    if (picture.dots_px.size() != 2) return std::nullopt;
    if ((picture.dots_px[0] - picture.dots_px[1]).norm() < kShortest_px) return std::nullopt;
    view.dots_px = picture.dots_px;
  } else {
    auto found = three_on_a_line(picture.dots_px, leds_m[1] < 0.5 * leds_m[2]);
    if (found.size() != 1) return std::nullopt;
    view.dots_px = std::move(found.front());
  }
  view.used.assign(leds_m.size(), true);
  return view;
}

/// Median of the slopes between all pairs of pictures (Theil and Sen), which a false dot in one of
/// them does not move.
Vec2 slope(const std::vector<std::pair<double, Vec2>>& track) {
  Vec2 speed;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> slopes;
    for (std::size_t i = 0; i < track.size(); ++i)
      for (std::size_t j = i + 1; j < track.size(); ++j)
        if (track[j].first - track[i].first > 0.004)
          slopes.push_back((track[j].second - track[i].second)[axis] /
                           (track[j].first - track[i].first));
    speed[axis] = median(std::move(slopes));
  }
  return speed;
}

/// The views before or after this one, each turned as the one beside it.
std::vector<WandView> neighbours(const std::vector<WandView>& views, std::size_t at, int step) {
  std::vector<WandView> found;
  const WandView* last = &views[at];
  found.reserve(kNeighbours);
  for (auto i = static_cast<std::ptrdiff_t>(at) + step;
       i >= 0 && i < static_cast<std::ptrdiff_t>(views.size()) && found.size() < kNeighbours;
       i += step) {
    WandView next = views[static_cast<std::size_t>(i)];
    if (std::abs(next.t_s - views[at].t_s) > kNeighbour_s) break;
    WandView turned = next;
    turned.reverse();
    if (distance_px(turned.dots_px, last->dots_px) < distance_px(next.dots_px, last->dots_px))
      next = turned;
    if (distance_px(next.dots_px, last->dots_px) > kFarthestStep_px) break;
    found.push_back(std::move(next));
    last = &found.back();
  }
  return found;
}

bool find_speed(const std::vector<WandView>& views, std::size_t at, WandView& view) {
  const auto before = neighbours(views, at, -1), after = neighbours(views, at, 1);
  if (before.empty() || after.empty() || before.size() + after.size() < 3) return false;
  for (std::size_t led = 0; led < view.dots_px.size(); ++led) {
    std::vector<std::pair<double, Vec2>> track;
    for (auto i = before.size(); i-- > 0;)
      track.emplace_back(before[i].t_s, before[i].dots_px[led]);
    track.emplace_back(view.t_s, view.dots_px[led]);
    for (const WandView& next : after) track.emplace_back(next.t_s, next.dots_px[led]);
    view.speed_px_s.push_back(slope(track));
  }
  return true;
}

const WandView* nearest(const std::vector<WandView>& views, double t_s, double within_s) {
  const auto after = std::ranges::lower_bound(views, t_s, {}, &WandView::t_s);
  const WandView* best = nullptr;
  for (const auto& candidate : {after, after == views.begin() ? after : after - 1})
    if (candidate != views.end() && std::abs(candidate->t_s - t_s) <= within_s) {
      within_s = std::abs(candidate->t_s - t_s);
      best = &*candidate;
    }
  return best;
}

/// The first camera that has a view there sets the time to which the others' nearest belong; the
/// moment is their middle: what is extrapolated by a speed that is known roughly shall be little.
WandMoment moment_near(const std::vector<std::vector<WandView>>& views,
                       std::span<const double> lag_s, double t_s) {
  WandMoment moment{.t_s = 0, .views = {}};
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    const WandView* view = nearest(views[camera], t_s + lag_s[camera], kTogether_s);
    if (!view) continue;
    if (moment.views.empty()) t_s = view->t_s - lag_s[camera];
    moment.views.push_back(*view);
    moment.t_s += view->t_s - lag_s[camera];
  }
  if (!moment.views.empty()) moment.t_s /= static_cast<double>(moment.views.size());
  return moment;
}

}  // namespace

void WandView::reverse() {
  std::ranges::reverse(dots_px);
  std::ranges::reverse(speed_px_s);
  std::reverse(used.begin(), used.end());
}

std::vector<WandView> find_wand(const CameraTrack& track, int camera,
                                std::span<const double> leds_m) {
  std::vector<WandView> all, moving;
  for (const CameraTrack::Picture& picture : track.pictures)
    if (auto view = view_in(picture, leds_m)) all.push_back(std::move(*view));
  for (std::size_t i = 0; i < all.size(); ++i) {
    WandView view = all[i];
    view.camera = camera;
    if (find_speed(all, i, view)) moving.push_back(std::move(view));
  }
  return moving;
}

std::vector<WandMoment> join_views(const std::vector<std::vector<WandView>>& views,
                                   std::span<const double> lag_s, int most) {
  double begin_s = 1e300, end_s = -1e300;
  for (const auto& of_camera : views) {
    if (of_camera.empty()) continue;
    begin_s = std::min(begin_s, of_camera.front().t_s);
    end_s = std::max(end_s, of_camera.back().t_s);
  }
  std::vector<WandMoment> moments;
  for (double t_s = begin_s; t_s <= end_s; t_s += kApart_s) {
    WandMoment moment = moment_near(views, lag_s, t_s);
    if (moment.views.size() >= 2) moments.push_back(std::move(moment));
  }
  std::vector<WandMoment> chosen;
  const auto count = std::min(moments.size(), static_cast<std::size_t>(most) * 10 / 9);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(moments[i * moments.size() / count]);
    chosen.back().held_out = i % 10 == 9;
  }
  return chosen;
}

}  // namespace vindu
