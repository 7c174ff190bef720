#include "tracker/joint/quorum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tracker/joint/rotation.h"

namespace vindu {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

constexpr double kStays = 1 - 1.0 / 40;    // of what is known, with each note: two seconds
constexpr double kEnough = 5;              // notes that tell something
constexpr double kSizeSigma = 0.005;       // of a head, as LEDs and lenses are known
constexpr double kPoseInformation = 1e-2;  // metres and radians: whatever it is
constexpr double kShiftSigma_px = 100;
constexpr double kDotSigma_px = 1;  // with what rounding leaves wrong in one picture after another

/// A labelling by one shift of all dots.
struct Shifted {
  std::vector<int> led_of_dot;
  std::ptrdiff_t dots = 0;
  double spread_px2 = 0;  // of their shifts, summed
};

/// To each LED the nearest dot, where one is near; of two LEDs with one dot the nearer.
std::vector<int> nearest_dots(const Vec2& shift_px, std::span<const Vec2> expected_px,
                              std::span<const Vec2> dots_px) {
  constexpr double kShape_px = 6;
  std::vector<int> led_of_dot(dots_px.size(), -1);
  const auto off_px = [&](std::size_t dot, std::size_t led) {
    return (dots_px[dot] - expected_px[led] - shift_px).norm();
  };
  for (std::size_t led = 0; led < expected_px.size(); ++led) {
    std::size_t nearest = 0;
    for (std::size_t dot = 1; dot < dots_px.size(); ++dot)
      if (off_px(dot, led) < off_px(nearest, led)) nearest = dot;
    int& taken = led_of_dot[nearest];
    const double limit_px =
        taken < 0 ? kShape_px : off_px(nearest, static_cast<std::size_t>(taken));
    if (off_px(nearest, led) < limit_px) taken = static_cast<int>(led);
  }
  return led_of_dot;
}

Shifted shifted_by(const Vec2& shift_px, std::span<const Vec2> expected_px,
                   std::span<const Vec2> dots_px) {
  Shifted result{.led_of_dot = nearest_dots(shift_px, expected_px, dots_px)};
  Vec2 sum_px = Vec2::Zero();
  double square_px2 = 0;
  for (std::size_t i = 0; i < dots_px.size(); ++i) {
    if (result.led_of_dot[i] < 0) continue;
    const Vec2 off_px =
        dots_px[i] - expected_px[static_cast<std::size_t>(result.led_of_dot[i])] - shift_px;
    sum_px += off_px;
    square_px2 += off_px.squaredNorm();
    ++result.dots;
  }
  if (result.dots > 0)
    result.spread_px2 = square_px2 - sum_px.squaredNorm() / static_cast<double>(result.dots);
  return result;
}

}  // namespace

std::vector<int> labels_aside(std::span<const Vec2> expected_px, std::span<const Vec2> dots_px) {
  constexpr double kFarthest_px = 60, kClearBy_px2 = 27;
  const auto least = std::min<std::ptrdiff_t>(3, std::ssize(expected_px));
  Shifted best{.led_of_dot = {}, .dots = least - 1};
  bool clear = false;
  for (std::size_t i = 0; i < dots_px.size(); ++i)
    for (std::size_t led = 0; led < expected_px.size(); ++led) {
      const Vec2 shift_px = dots_px[i] - expected_px[led];
      const bool known = !best.led_of_dot.empty() && best.led_of_dot[i] == static_cast<int>(led);
      if (known || shift_px.norm() > kFarthest_px) continue;
      Shifted next = shifted_by(shift_px, expected_px, dots_px);
      if (next.dots < best.dots || next.led_of_dot == best.led_of_dot) continue;
      const bool more = next.dots > best.dots;
      const bool better = more || next.spread_px2 < best.spread_px2;
      const bool apart = std::abs(next.spread_px2 - best.spread_px2) > kClearBy_px2;
      clear = more || ((clear || better) && apart);
      if (better) best = std::move(next);
    }
  return clear ? best.led_of_dot : std::vector<int>{};
}

namespace {

/// Dots whose LED is known, as they would be with the head at `at`, not where the glimpse has it.
/// Empty where a camera cannot see the head, or its dots do not look like one.
std::vector<LedSighting> sightings_of(const CameraModel& camera, const Glimpse& glimpse,
                                      std::span<const Vec3> leds_in_head, const Rigid3& at) {
  const Rigid3 camera_from_head = camera.camera_from_room() * glimpse.room_from_head;
  const Rigid3 camera_from_moved = camera.camera_from_room() * at;
  std::vector<Vec2> expected_px, moved_px;
  for (const Vec3& led : leds_in_head) {
    const auto then_px = camera.project(camera_from_head * led);
    const auto there_px = camera.project(camera_from_moved * led);
    if (!then_px || !there_px) return {};
    expected_px.push_back(*then_px);
    moved_px.emplace_back(*there_px - *then_px);
  }
  const std::vector<int> labels = labels_aside(expected_px, glimpse.dots_px);
  const double sigma_px = std::hypot(glimpse.sigma_px, kDotSigma_px);
  std::vector<LedSighting> sightings;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const auto led = static_cast<std::size_t>(labels[i]);
    sightings.push_back(
        {glimpse.camera, leds_in_head[led], glimpse.dots_px[i] + moved_px[led], sigma_px});
  }
  return sightings;
}

struct Linearised {
  QuorumEvidence evidence;
  Vec6 step;  ///< to the pose that fits best: metres and radians in room
};

// Residuals are J pose + shift of the camera + size; the Schur complement leaves the last two.
Linearised linearised_at(const Rigid3& room_from_head, std::span<const CameraModel> cameras,
                         std::span<const LedSighting> sightings, Eigen::Index rows) {
  const Eigen::Index size = rows - 1;
  double square = 0;
  Mat6 of_pose = kPoseInformation * Mat6::Identity();
  Vec6 pose_pull = Vec6::Zero();
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size + 1, size + 1);
  Eigen::MatrixXd with_pose = Eigen::MatrixXd::Zero(size + 1, 6);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(size + 1);
  for (const LedSighting& seen : sightings) {
    const auto dot = dot_of_led(cameras[static_cast<std::size_t>(seen.camera)], room_from_head,
                                seen.led_in_head);
    if (!dot) continue;
    const auto row = 2 * static_cast<Eigen::Index>(seen.camera);
    const double weight = 1 / (seen.sigma_px * seen.sigma_px);
    const Vec2 residual_px = seen.raw_px - dot->raw_px;
    const Vec2 by_size_px =
        dot->d_raw_d_pose.leftCols<3>() * (room_from_head.rotation * seen.led_in_head);
    const Jacobian26 weighted = weight * dot->d_raw_d_pose;
    of_pose += dot->d_raw_d_pose.transpose() * weighted;
    pose_pull += weighted.transpose() * residual_px;
    with_pose.middleRows<2>(row) += weighted;
    with_pose.row(size) += by_size_px.transpose() * weighted;
    own.block<2, 2>(row, row) += weight * Eigen::Matrix2d::Identity();
    own.block<2, 1>(row, size) += weight * by_size_px;
    own.block<1, 2>(size, row) += weight * by_size_px.transpose();
    own(size, size) += weight * by_size_px.squaredNorm();
    pull.segment<2>(row) += weight * residual_px;
    pull(size) += weight * by_size_px.dot(residual_px);
    square += weight * residual_px.squaredNorm();
  }
  const Eigen::LDLT<Mat6> pose(of_pose);
  const Vec6 step = pose.solve(pose_pull);
  return {{own - with_pose * pose.solve(with_pose.transpose()), pull - with_pose * step,
           square - pose_pull.dot(step), 2 * static_cast<double>(sightings.size()) - 6},
          step};
}

/// Around the pose that fits best, by Gauss-Newton steps, as far as all is not linear. Empty where
/// they lead nowhere.
std::optional<QuorumEvidence> evidence_of(std::span<const CameraModel> cameras,
                                          std::span<const LedSighting> sightings, Rigid3 pose,
                                          Eigen::Index rows) {
  constexpr double kLinear = 5e-3;  // metres and radians
  constexpr int kSteps = 10;
  for (int i = 0; i < kSteps; ++i) {
    auto [evidence, step] = linearised_at(pose, cameras, sightings, rows);
    if (!step.allFinite()) return std::nullopt;
    if (step.norm() < kLinear) return evidence;
    pose = {(rotation_of(step.tail<3>()) * pose.rotation).normalized(),
            pose.translation + step.head<3>()};
  }
  return std::nullopt;
}

std::vector<std::size_t> with(std::vector<std::size_t> set, std::size_t camera) {
  set.push_back(camera);
  return set;
}

}  // namespace

Quorum::Quorum(std::size_t cameras) : standings_(cameras) {
  const Eigen::Index rows = 2 * std::ssize(standings_) + 1;
  known_ = {Eigen::MatrixXd::Zero(rows, rows), Eigen::VectorXd::Zero(rows), 0, 0};
  leading_ = Eigen::VectorXd::Zero(rows);
}

void Quorum::note(std::span<const CameraModel> cameras, std::span<const Vec3> leds_in_head,
                  std::span<const Glimpse> glimpses) {
  std::vector<LedSighting> sightings;
  std::vector<std::size_t> seeing;
  for (const Glimpse& glimpse : glimpses) {
    const auto camera = static_cast<std::size_t>(glimpse.camera);
    const auto seen =
        sightings_of(cameras[camera], glimpse, leds_in_head, glimpses[0].room_from_head);
    if (seen.empty()) continue;
    seeing.push_back(camera);
    sightings.insert(sightings.end(), seen.begin(), seen.end());
  }
  for (Standing& standing : standings_) standing.seen *= kStays;
  for (const std::size_t camera : seeing) ++standings_[camera].seen;
  if (seeing.size() < 3) return;
  const auto news = evidence_of(cameras, sightings, glimpses[0].room_from_head, known_.pull.size());
  if (!news) return;
  if (torn_by(*news)) forget();
  known_.information = kStays * known_.information + news->information;
  known_.pull = kStays * known_.pull + news->pull;
  for (Standing& standing : standings_) standing.weighed *= kStays;
  for (const std::size_t camera : seeing) ++standings_[camera].weighed;
  judge();
}

// Dots that fit what is known no more: a camera was bumped just now. What was seen before and after
// is explained by nothing that stays.
bool Quorum::torn_by(const QuorumEvidence& news) {
  constexpr double kShare = 0.3, kTorn = 15, kUsual = 0.5;  // squared sigmas, of each dot's number
  if (weighed().size() < 3) return false;
  const double misfit =
      news.square - 2 * leading_.dot(news.pull) + leading_.dot(news.information * leading_);
  misfit_ += kShare * (misfit - kUsual * news.freedom - misfit_);
  return misfit_ > kTorn;
}

void Quorum::forgive() {
  forget();
  for (std::size_t camera = 0; camera < standings_.size(); ++camera) stand(camera, Vec2::Zero(), 0);
  undecided_px_ = 0;
}

void Quorum::forget() {
  known_.information.setZero();
  known_.pull.setZero();
  misfit_ = 0;
  for (Standing& standing : standings_) standing.weighed = 0;
}

bool Quorum::knows(std::size_t camera) const { return standings_[camera].seen > kEnough; }

Quorum::Set Quorum::weighed() const {
  Set set;
  for (std::size_t camera = 0; camera < standings_.size(); ++camera)
    if (standings_[camera].weighed > kEnough) set.push_back(camera);
  return set;
}

/// The least-squares shifts of these cameras, two numbers each, and then the size.
Eigen::VectorXd Quorum::shifts_of(const Set& set) const {
  std::vector<Eigen::Index> rows;
  for (const std::size_t camera : set)
    for (const Eigen::Index axis : {0, 1})
      rows.push_back(2 * static_cast<Eigen::Index>(camera) + axis);
  rows.push_back(known_.pull.size() - 1);
  Eigen::MatrixXd information = known_.information(rows, rows);
  information.diagonal().array() += 1 / (kShiftSigma_px * kShiftSigma_px);
  information(information.rows() - 1, information.rows() - 1) += 1 / (kSizeSigma * kSizeSigma);
  return information.ldlt().solve(known_.pull(rows));
}

/// By how much the sum of squares becomes less where these are shifted.
double Quorum::explained_by(const Set& set) const {
  const Eigen::VectorXd shifts = shifts_of(set);
  double explained = shifts(shifts.size() - 1) * known_.pull(known_.pull.size() - 1);
  for (std::size_t i = 0; i < set.size(); ++i)
    explained += shifts.segment<2>(2 * static_cast<Eigen::Index>(i))
                     .dot(known_.pull.segment<2>(2 * static_cast<Eigen::Index>(set[i])));
  return explained;
}

double Quorum::shift_px(const Set& others, std::size_t camera) const {
  return shifts_of(with(others, camera)).segment<2>(2 * std::ssize(others)).norm();
}

/// Those that explain, beside `aside`, what is wrong; of several nobody can say which it is. What
/// was said is not taken back for little.
Quorum::Set Quorum::suspects(const Set& agreeing, const Set& aside) const {
  constexpr double kClear = 40, kClearBy = 16, kUsual_px = 0.8;
  std::vector<double> explained;
  for (const std::size_t camera : agreeing)
    explained.push_back(explained_by(with(aside, camera)) +
                        (standings_[camera].aside_px.isZero(0) ? 0 : kClearBy));
  const double most = *std::ranges::max_element(explained);
  if (most - explained_by(aside) < kClear) return {};
  Set suspects;
  for (std::size_t i = 0; i < agreeing.size(); ++i)
    if (explained[i] > most - kClearBy) suspects.push_back(agreeing[i]);
  const auto usual = [&](std::size_t camera) { return shift_px(aside, camera) < kUsual_px; };
  return std::ranges::any_of(suspects, usual) ? Set{} : suspects;
}

// One after the other, while two agree.
void Quorum::judge() {
  Set agreeing = weighed(), aside, suspected;
  if (agreeing.size() < 3) return;
  while (agreeing.size() > 2) {
    suspected = suspects(agreeing, aside);
    if (suspected.size() != 1) break;
    std::erase(agreeing, suspected[0]);
    aside.push_back(suspected[0]);
    suspected.clear();
  }
  for (const std::size_t camera : agreeing) stand(camera, Vec2::Zero(), 0);
  undecided_px_ = 0;
  for (const std::size_t camera : suspected) {
    const double off_px = shift_px(aside, camera);
    stand(camera, Vec2::Zero(), off_px / static_cast<double>(suspected.size()));
    undecided_px_ = undecided_px_ == 0 ? off_px : std::min(undecided_px_, off_px);
  }
  lead(suspected.empty() ? aside : with(aside, suspected[0]));
  const Eigen::VectorXd shifts = shifts_of(aside);
  for (std::size_t i = 0; i < aside.size(); ++i) {
    const Vec2 off_px = shifts.segment<2>(2 * static_cast<Eigen::Index>(i));
    stand(aside[i], off_px, off_px.norm());
  }
}

void Quorum::lead(const Set& set) {
  const Eigen::VectorXd shifts = shifts_of(set);
  leading_.setZero();
  for (std::size_t i = 0; i < set.size(); ++i)
    leading_.segment<2>(2 * static_cast<Eigen::Index>(set[i])) =
        shifts.segment<2>(2 * static_cast<Eigen::Index>(i));
  leading_(leading_.size() - 1) = shifts(shifts.size() - 1);
}

void Quorum::stand(std::size_t camera, const Vec2& aside_px, double doubt_px) {
  standings_[camera].aside_px = aside_px;
  standings_[camera].doubt_px = doubt_px;
}

}  // namespace vindu
