// What the joint method makes of the newest reports: whether a head is sure, how well its dots fix
// it, and whether any head fits.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tracker/joint/joint_method.h"

namespace vindu {
namespace {

using Milliseconds = std::chrono::milliseconds;

constexpr Duration kLevelWindow = Milliseconds(35);  // that the level is judged by
constexpr Duration kRemembered = Milliseconds(500);  // what was sure, to place the eye by

}  // namespace

bool JointMethod::bears(const Entry& entry, std::size_t head) {
  return std::ranges::any_of(entry.births, [&](const auto& birth) { return birth.first == head; });
}

/// Whether so few dots are the head's since it was found, and so many nobody's, that the few may
/// fit by chance. A camera that was bumped says nothing.
bool JointMethod::contradicted(std::size_t head) const {
  constexpr Duration kLately = Milliseconds(100);
  constexpr double kFew = 5, kLeftPerOwn = 0.5;
  if (searches_[head].beaten >= 2) return true;
  struct Count {
    double reports = 0, own = 0, left = 0;
  };
  std::vector<Count> counts(cameras_.size());
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    const auto camera = static_cast<std::size_t>(entry->seen.camera);
    if (entries_.back().seen.captured - entry->seen.captured > kLately || bears(*entry, head) ||
        !entry->after[head].state)
      break;
    if (moved(camera) || stands_aside(camera)) continue;
    std::array<bool, kMaxDots> known = entry->seen.masked;
    for (std::size_t i = 0; i < known.size(); ++i) known[i] |= entry->association.disputed[i];
    for (const AcceptedDot& dot : entry->association.accepted) {
      known[dot.dot] = true;
      counts[camera].own += dot.head == static_cast<int>(head);
    }
    ++counts[camera].reports;
    counts[camera].left += static_cast<double>(
        std::count(known.begin(),
                   known.begin() + static_cast<std::ptrdiff_t>(entry->seen.dots.size()), false));
  }
  double own = 0, left = 0;
  for (const Count& count : counts) {
    own += count.own / std::max(1.0, count.reports);
    left += count.left / std::max(1.0, count.reports);
  }
  return own < kFew && left > kLeftPerOwn * own;
}

/// One camera's dots of three LEDs fit up to four poses (P3P: Grunert 1841), of which one faces
/// away by some 70 degrees, a metre nearer: the one is taken that faces the wall.
bool JointMethod::known_by_facing(std::size_t head) const {
  return cameras_.size() == 1 && leds_of_heads_[head].size() == 3;
}

/// Whether what was seen lately tells one LED from another: three of two cameras' dots always fit
/// some pose, and so do two LEDs whichever they are. One camera alone has no more than three dots.
bool JointMethod::sure(std::size_t head) const {
  constexpr Duration kLately = Milliseconds(80);
  std::vector<std::ptrdiff_t> most(cameras_.size());  // dots of one report
  std::array<bool, kMaxLeds> seen{};
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (entries_.back().seen.captured - entry->seen.captured > kLately) break;
    std::ptrdiff_t dots = 0;
    for (const AcceptedDot& dot : entry->association.accepted) {
      if (dot.head != static_cast<int>(head)) continue;
      seen[static_cast<std::size_t>(dot.led)] = true;
      ++dots;
    }
    auto& of_camera = most[static_cast<std::size_t>(entry->seen.camera)];
    of_camera = std::max(of_camera, dots);
  }
  const std::ptrdiff_t leds = std::ssize(leds_of_heads_[head]);
  const auto dots_needed = cameras_.size() == 1 ? std::min<std::ptrdiff_t>(leds, 3)
                                                : std::min<std::ptrdiff_t>(2 * leds, 4);
  return std::accumulate(most.begin(), most.end(), std::ptrdiff_t{0}) >= dots_needed &&
         std::ranges::count(seen, true) >= std::min<std::ptrdiff_t>(leds, 3);
}

/// Of the dots that each camera's newest report gave.
Mat6 JointMethod::information_now(std::size_t head) const {
  const auto& state = newest_heads()[head].state;
  Mat6 information = Mat6::Zero();
  std::vector<bool> done(cameras_.size(), false);
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (entries_.back().seen.captured - entry->seen.captured > kLevelWindow) break;
    const auto camera = static_cast<std::size_t>(entry->seen.camera);
    if (done[camera]) continue;
    for (const AcceptedDot& accepted : entry->association.accepted) {
      if (accepted.head != static_cast<int>(head)) continue;
      const auto dot = dot_of_led(cameras_[camera], state->room_from_head,
                                  leds_of_heads_[head][static_cast<std::size_t>(accepted.led)]);
      if (!dot) continue;
      done[camera] = true;
      const Eigen::Matrix<double, 6, 2> in_sigmas =
          dot->d_raw_d_pose.transpose() / entry->seen.dot_sigma_px;
      information += in_sigmas.lazyProduct(in_sigmas.transpose());
    }
  }
  return information;
}

TrackingLevel JointMethod::level_now(std::size_t head) const {
  if (options_.position_only) return TrackingLevel::position;
  if (contradicted(head)) return TrackingLevel::held;
  if (known_by_facing(head)) return TrackingLevel::bearing;
  constexpr double kFarTooLarge = 0.05;  // or too small: the place is wrong by as much
  if (std::abs(heads_look_larger()) > kFarTooLarge) return TrackingLevel::bearing;
  const TrackingLevel level = std::min(level_of(information_now(head)), TrackingLevel::bearing);
  const Duration remembered = entries_.back().seen.captured - searches_[head].sure;
  return remembered > kRemembered ? TrackingLevel::bearing : level;
}

// What does not fit is the same in every picture: no mean over time makes it less.
void JointMethod::add_misfit(std::size_t head, PoseSample& sample) const {
  constexpr double kUsual = 0.005;  // of sizes, as LEDs and lenses are known
  if (disagreement_px() > 0) {
    const Eigen::LDLT<Mat6> information(information_now(head));
    if (information.isPositive() && information.rcond() > 1e-12)
      sample.covariance += information.solve(Mat6::Identity());
  }
  const double larger = heads_look_larger();
  if (std::abs(larger) < kUsual) return;
  for (const CameraModel& camera : cameras_) {
    const Vec3 off_m =
        larger * (sample.room_from_head.translation - camera.room_from_camera().translation);
    sample.covariance.topLeftCorner<3, 3>() +=
        off_m * off_m.transpose() / static_cast<double>(cameras_.size());
  }
}

bool JointMethod::nothing_fits() const {
  return !options_.position_only && std::ranges::any_of(searches_, [](const Search& search) {
    return search.failed.baffled();
  });
}

}  // namespace vindu
