#include "tracker/joint/capture_clock.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace vindu {
namespace {

constexpr std::size_t kFirst = 64;    // arrivals that a lattice is looked for in
constexpr double kSilence_s = 1;      // after it the device may be another, or started anew
constexpr double kKept_s = 4;         // of arrivals that the line lies below
constexpr int kBetweenFits = 8;       // reports
constexpr double kPrompt_s = 1.2e-3;  // later than its earliest, a report still came at once
constexpr double kLongestWait_s = 0.04;
constexpr double kEarly_s = 0.5e-3;     // earlier than that, it cannot be this sample's
constexpr double kUnknown_s = 5e-3;     // scatter of arrivals in bursts
constexpr double kLatticeShare = 0.4;   // of arrivals at once; with fewer there is no lattice
constexpr double kLostLattice = 0.25;   // with fewer, it was wrong or is not there any more
constexpr double kShortest_s = 2.5e-3;  // between two samples; nearer arrivals are of one burst
constexpr double kHullJitter_s = 0.3e-3;
constexpr int kBehind = 2;  // first offset of the belief is -kBehind

struct Lattice {
  double period_s = 0;
  double phase_s = 0;
  std::size_t on_it = 0;
};

/// Of the phases modulo the period: where the fullest window of kPrompt_s begins.
Lattice fullest(const std::vector<double>& arrivals_s, double period_s) {
  std::vector<double> phases;
  for (const double arrival_s : arrivals_s) phases.push_back(std::fmod(arrival_s, period_s));
  std::ranges::sort(phases);
  const std::size_t count = phases.size();
  for (std::size_t i = 0; i < count; ++i) phases.push_back(phases[i] + period_s);
  Lattice best{period_s, 0, 0};
  for (std::size_t first = 0, last = 0; first < count; ++first) {
    last = std::max(last, first);
    while (last < phases.size() && phases[last] < phases[first] + kPrompt_s) ++last;
    if (last - first > best.on_it) best = {period_s, phases[first], last - first};
  }
  return best;
}

std::optional<double> usual_gap_s(const std::vector<double>& arrivals_s) {
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < arrivals_s.size(); ++i)
    if (const double gap_s = arrivals_s[i] - arrivals_s[i - 1]; gap_s > kShortest_s)
      gaps_s.push_back(gap_s);
  if (gaps_s.size() < arrivals_s.size() / 3) return std::nullopt;
  std::ranges::nth_element(gaps_s, gaps_s.begin() + static_cast<long>(gaps_s.size() / 2));
  return gaps_s[gaps_s.size() / 2];
}

bool prompt(double late_s) { return late_s > -kEarly_s && late_s < kPrompt_s; }

/// How likely a report comes so late (a density, in 1/ms): some come at once, the rest wait.
double likelihood(double late_s, double prompt_share) {
  if (late_s < -kEarly_s) return 1e-7;
  if (late_s < kPrompt_s) return prompt_share / (1e3 * (kPrompt_s + kEarly_s));
  return late_s < kLongestWait_s ? (1 - prompt_share) / (1e3 * kLongestWait_s) : 1e-5;
}

}  // namespace

void CaptureClock::restart() {
  locked_ = false;
  first_arrivals_s_.clear();
  points_.clear();
}

CaptureTime CaptureClock::capture_of(Time arrival) {
  if (!started_) origin_ = arrival;
  started_ = true;
  const double arrival_s = seconds(arrival - origin_), gap_s = arrival_s - last_arrival_s_;
  if (gap_s > kSilence_s) restart();
  last_arrival_s_ = arrival_s;
  if (!locked_) {
    first_arrivals_s_.push_back(arrival_s);
    if (first_arrivals_s_.size() >= kFirst && !find_lattice())
      first_arrivals_s_.erase(first_arrivals_s_.begin(), first_arrivals_s_.begin() + kFirst / 2);
    return {arrival - lag_, from_seconds(kUnknown_s)};
  }
  judge_offsets(arrival_s, gap_s);
  double mean = 0, square = 0;
  for (int offset = 0; offset < kOffsets; ++offset) {
    const double share = belief_[static_cast<std::size_t>(offset)];
    mean += share * (offset - kBehind);
    square += share * (offset - kBehind) * (offset - kBehind);
  }
  const double scatter = std::max(square - mean * mean, 0.0);
  const double sigma_s = std::sqrt(scatter * period_s_ * period_s_ + kHullJitter_s * kHullJitter_s);
  const double captured_s = std::min(due_s(index_ + mean), arrival_s);
  track_lattice(arrival_s, belief_[kBehind]);
  if (on_lattice_ < kLostLattice) restart();
  return {origin_ + from_seconds(captured_s) - lag_, from_seconds(sigma_s)};
}

// The period is near the usual gap; the one that puts most arrivals on one lattice is right.
bool CaptureClock::find_lattice() {
  const auto gap_s = usual_gap_s(first_arrivals_s_);
  if (!gap_s) return false;
  const double step_s = 0.5e-3 / static_cast<double>(first_arrivals_s_.size());
  Lattice best;
  for (double period_s = 0.94 * *gap_s; period_s < 1.06 * *gap_s; period_s += step_s)
    if (const Lattice found = fullest(first_arrivals_s_, period_s); found.on_it > best.on_it)
      best = found;
  if (static_cast<double>(best.on_it) < kLatticeShare * static_cast<double>(kFirst)) return false;
  period_s_ = best.period_s;
  floor_s_ = best.phase_s;
  floor_index_ = 0;
  for (const double arrival_s : first_arrivals_s_) {
    const double index = std::floor((arrival_s - floor_s_) / period_s_);
    if (arrival_s - due_s(index) < kPrompt_s) points_.push_back({index, arrival_s});
  }
  index_ = std::floor((first_arrivals_s_.back() - floor_s_) / period_s_);
  belief_ = {0.02, 0.08, 0.9, 0, 0, 0};
  on_lattice_ = 1;
  locked_ = true;
  fit_hull();
  return true;
}

// The report counts as the next one; each loss, and losses come in rows, puts it one
// farther. What its lateness says then decides. In a burst, after a short gap, few reports are new.
void CaptureClock::judge_offsets(double arrival_s, double gap_s) {
  constexpr double kLossGoesOn = 0.6;
  constexpr double kLeastPrompt[] = {0.1, 0.6, 0.2};  // else all would seem late for ever
  index_ += 1;
  const double gap_periods = gap_s / period_s_;
  const std::size_t kind = gap_periods < 0.4 ? 0 : gap_periods < 1.3 ? 1 : 2;
  double& prompt_share = prompt_share_[kind];
  std::array<double, kOffsets> after{};
  for (int from = 0; from < kOffsets; ++from) {
    double share = belief_[static_cast<std::size_t>(from)];
    for (int to = from; to < kOffsets; ++to) {
      after[static_cast<std::size_t>(to)] += share;
      share *= to == from ? loss_ : kLossGoesOn;
    }
  }
  for (int offset = 0; offset < kOffsets; ++offset)
    after[static_cast<std::size_t>(offset)] *=
        likelihood(arrival_s - due_s(index_ + offset - kBehind), prompt_share);
  const double sum = std::accumulate(after.begin(), after.end(), 0.0);
  for (double& share : after) share /= sum;
  const auto before = belief_;
  belief_ = after;
  learn(before, arrival_s, prompt_share);
  prompt_share = std::clamp(prompt_share, kLeastPrompt[kind], 0.995);
  shift_belief(arrival_s);
}

// Running means of what the belief holds to have happened.
void CaptureClock::learn(const std::array<double, kOffsets>& before, double arrival_s,
                         double& prompt_share) {
  constexpr double kShare = 0.03, kLossShare = 0.004;
  double came_at_once = 0, lost = 0;
  for (int offset = 0; offset < kOffsets; ++offset) {
    const auto at = static_cast<std::size_t>(offset);
    if (prompt(arrival_s - due_s(index_ + offset - kBehind))) came_at_once += belief_[at];
    lost += (belief_[at] - before[at]) * offset;
  }
  prompt_share += kShare * (came_at_once - prompt_share);
  on_lattice_ += 0.5 * kShare * (came_at_once - on_lattice_);
  loss_ = std::clamp(loss_ + kLossShare * (lost - loss_), 1e-3, 0.15);
}

// Keeps the likeliest in its place. After a long gap, or where nothing fits, the newest sample that
// can have arrived by now is as good a guess as there is.
void CaptureClock::shift_belief(double arrival_s) {
  const double newest = std::floor((arrival_s + kEarly_s - floor_s_) / period_s_) + floor_index_;
  const bool far_behind = newest - index_ > 0.05 / period_s_;
  const bool impossible = index_ - newest > kBehind;
  if (far_behind || impossible) {
    index_ = newest;
    belief_ = {0.15, 0.25, 0.6, 0, 0, 0};
    return;
  }
  const auto likeliest = std::ranges::max_element(belief_) - belief_.begin() - kBehind;
  if (likeliest == 0) return;
  index_ += static_cast<double>(likeliest);
  std::array<double, kOffsets> moved{};
  for (int offset = 0; offset < kOffsets; ++offset) {
    const long from = offset + likeliest;
    if (from >= 0 && from < kOffsets)
      moved[static_cast<std::size_t>(offset)] = belief_[static_cast<std::size_t>(from)];
  }
  belief_ = moved;
}

void CaptureClock::track_lattice(double arrival_s, double sure) {
  constexpr double kSure = 0.9;
  if (sure < kSure || arrival_s < due_s(index_) - kEarly_s) return;
  points_.push_back({index_, arrival_s});
  while (arrival_s - points_.front().arrival_s > kKept_s) points_.pop_front();
  if (++since_fit_ >= kBetweenFits) fit_hull();
}

// Of all lines below the points, the one nearest to them on average goes through the edge of the
// lower convex hull that stands over their mean index (Moon, Skelly & Towsley 1999). The hull:
// Andrew's monotone chain, 1979.
void CaptureClock::fit_hull() {
  since_fit_ = 0;
  std::vector<Point> hull;
  double mean = 0;
  for (const Point& point : points_) {
    mean += point.index / static_cast<double>(points_.size());
    if (!hull.empty() && point.index <= hull.back().index) {
      if (point.arrival_s >= hull.back().arrival_s) continue;
      hull.pop_back();
    }
    while (hull.size() >= 2) {
      const Point& a = hull[hull.size() - 2];
      const Point& b = hull.back();
      const double turn = (b.index - a.index) * (point.arrival_s - a.arrival_s) -
                          (b.arrival_s - a.arrival_s) * (point.index - a.index);
      if (turn > 0) break;
      hull.pop_back();
    }
    hull.push_back(point);
  }
  const auto right = std::ranges::find_if(hull, [&](const Point& p) { return p.index > mean; });
  if (right == hull.begin() || right == hull.end()) return;
  const Point& left = *(right - 1);
  const double period_s = (right->arrival_s - left.arrival_s) / (right->index - left.index);
  const bool sensible = std::abs(period_s / period_s_ - 1) < 0.01;
  if (sensible) period_s_ = period_s;
  floor_index_ = left.index;
  floor_s_ = left.arrival_s;
}

}  // namespace vindu
