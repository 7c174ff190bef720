#include "tracker/joint/acquisition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tracker/joint/assignment.h"
#include "tracker/joint/candidates.h"

namespace vindu {
namespace {

using Labels = std::vector<std::vector<int>>;

/// Pairs of views with dots, the widest apart first: they fix depth best.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(std::span<const CameraModel> cameras,
                                                          std::span<const CameraView> views) {
  constexpr std::size_t kPairs = 6;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < views.size(); ++a)
    for (std::size_t b = a + 1; b < views.size(); ++b)
      if (!views[a].dots_px.empty() && !views[b].dots_px.empty()) pairs.emplace_back(a, b);
  const auto worth = [&](const std::pair<std::size_t, std::size_t>& pair) {
    const CameraView &a = views[pair.first], &b = views[pair.second];
    const auto place = [&](const CameraView& view) {
      return cameras[static_cast<std::size_t>(view.camera)].room_from_camera().translation;
    };
    const auto dots = static_cast<double>(std::min(a.dots_px.size(), b.dots_px.size()));
    return std::min(dots, 3.0) * 10 + std::min((place(a) - place(b)).norm(), 3.0);
  };
  std::ranges::stable_sort(pairs, std::greater{}, worth);
  if (pairs.size() > kPairs) pairs.resize(kPairs);
  return pairs;
}

std::ptrdiff_t dots_of(std::span<const CameraView> views) {
  std::ptrdiff_t dots = 0;
  for (const CameraView& view : views) dots += std::ssize(view.dots_px);
  return dots;
}

}  // namespace

std::ptrdiff_t FoundHead::dots() const {
  std::ptrdiff_t dots = 0;
  for (const auto& leds : led_of_dot) dots += std::ssize(leds) - std::ranges::count(leds, -1);
  return dots;
}

bool FoundHead::seen_in(std::size_t view) const {
  return std::ranges::any_of(led_of_dot[view], [](int led) { return led >= 0; });
}

std::ptrdiff_t FoundHead::cameras() const {
  std::ptrdiff_t count = 0;
  for (std::size_t view = 0; view < led_of_dot.size(); ++view) count += seen_in(view);
  return count;
}

bool FoundHead::fits_closely() const {
  constexpr double kLargest = 2.5;  // squared sigmas for each number that the pose leaves free
  return fit.cost <= kLargest * static_cast<double>(std::max<std::ptrdiff_t>(2 * dots() - 6, 1));
}

class HeadSearch::Contest {
 public:
  Contest(std::span<const CameraModel> cameras, std::vector<CameraView> views,
          std::vector<Vec3> leds, const AcquisitionOptions& options)
      : cameras_(cameras),
        views_(std::move(views)),
        leds_(std::move(leds)),
        options_(options),
        pairs_(pairs_of(cameras_, views_)),
        few_(dots_of(views_) < kManyDots) {
    const Vec3 inverse = options.facing_sigma_rad.cwiseInverse();
    prior_.information.diagonal().tail<3>() = inverse.cwiseProduct(inverse);
  }

  const std::vector<CameraView>& views() const { return views_; }

  /// How many there are at most.
  std::size_t steps() const {
    std::size_t steps = pairs_.size() * (1 + options_.candidates_kept) + views_.size() + 1;
    for (const CameraView& view : views_)
      steps += candidates_from_one(view.dots_px.size(), leds_.size());
    return steps;
  }

  /// Considers the next rough pose, or makes more of them: those of pairs of cameras, then, where
  /// these are not enough, those of single ones. False: there are no others.
  bool step() {
    if (const auto poses = poses_()) {
      for (const Rigid3& pose : *poses) enter(pose);
      return true;
    }
    if (next_pair_ < pairs_.size() && !settled())
      poses_ = of_pair(pairs_[next_pair_++]);
    else if (options_.from_one && next_view_ < views_.size() && (next_view_ > 0 || !sure()))
      poses_ = of_one(views_[next_view_++]);
    else
      return false;
    return true;
  }

  /// What is believed of a tracked head, however few dots it rests on and wherever it faces: others
  /// must be better by the margin. In the end, for no other is given up for its sake.
  void enter_believed() {
    if (!options_.believed) return;
    Labels labels = label(*options_.believed, 0);
    const auto sightings = sightings_of(labels);
    if (sightings.size() < 2) return;
    if (const auto fit = fit_pose(cameras_, sightings, *options_.believed, prior_))
      judge(*fit, std::move(labels), /*believed=*/true);
  }

  std::optional<Rigid3> leading() const {
    const auto best = std::ranges::min_element(entries_, {}, &FoundHead::cost);
    return best == entries_.end() ? std::nullopt : std::optional(best->fit.room_from_head);
  }

  /// Whether what is believed is not the best, and neither near it nor nearly as good.
  bool believed_is_beaten() const {
    if (!options_.believed || entries_.empty()) return false;
    const auto best = std::ranges::min_element(entries_, {}, &FoundHead::cost);
    const auto believed = std::ranges::find(entries_, true, &FoundHead::believed);
    return believed == entries_.end() ||
           (elsewhere(*believed, *best) && believed->cost > best->cost + options_.least_margin);
  }

  std::optional<FoundHead> winner() {
    if (entries_.empty()) return std::nullopt;
    const auto best = std::ranges::min_element(entries_, {}, &FoundHead::cost);
    for (const FoundHead& rival : entries_)
      if (elsewhere(rival, *best)) best->margin = std::min(best->margin, rival.cost - best->cost);
    if (best->margin < options_.least_margin) return std::nullopt;
    FoundHead found = *best;
    // The prior has done its work: it must not pull at a pose that the dots fix by themselves.
    const bool free = options_.facing_sigma_rad.minCoeff() > radians(5);
    if (found.level == TrackingLevel::six_dof && free)
      if (const auto fit =
              fit_pose(cameras_, sightings_of(found.led_of_dot), found.fit.room_from_head))
        found.fit = *fit;
    return found;
  }

 private:
  void enter(const Rigid3& rough) {
    const Labels nearest = label(rough, kGates_px[0]);
    pursue(rough, nearest);
    if (few_) pursue_others(rough, nearest);
  }

  /// A rough pose does not tell which LED a dot is where several stand near it; among few dots
  /// there may be no other rough pose that does. One dot at a time is another one near it.
  void pursue_others(const Rigid3& rough, const Labels& nearest) {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const CostMatrix off = distances(views_[v], rough, kGates_px[0] / 4);
      for (std::size_t dot = 0; dot < nearest[v].size(); ++dot)
        for (int led = 0; led < off.cols(); ++led) {
          const int own = nearest[v][dot];
          if (led == own || !(off(static_cast<Eigen::Index>(dot), led) < options_.false_dot_cost))
            continue;
          Labels labels = nearest;
          std::ranges::replace(labels[v], led, own);
          labels[v][dot] = led;
          pursue(rough, std::move(labels));
        }
    }
  }

  /// Completes a rough pose with all dots that fit it, in rounds with a shrinking gate. Most rough
  /// poses meet in a labelling that was tried before, or leave too much unexplained beside what was
  /// found already; they end there.
  void pursue(const Rigid3& rough, Labels labels) {
    Rigid3 pose = rough;
    std::optional<PoseFit> fit;
    for (std::size_t round = 0; round < kRounds; ++round) {
      if (round > 0) {
        if (settled() && hopeless(pose)) return;
        labels = label(pose, kGates_px[round]);
      }
      if (std::ranges::find(tried_[round], labels) != tried_[round].end()) return;
      tried_[round].push_back(labels);
      const auto sightings = sightings_of(labels);
      if (sightings.size() < 2) return;
      const bool last = round + 1 == kRounds;
      fit = fit_pose(cameras_, sightings, pose, prior_, {.converged = last ? 1e-6 : 1e-3});
      if (!fit) return;
      pose = fit->room_from_head;
    }
    if (sightings_of(labels).size() >= options_.least_dots &&
        level_of(fit->dot_information) <= options_.least_level)
      judge(*fit, std::move(labels));
  }

  /// Whether some pose is fixed by the dots and leaves none over: further pairs can only repeat it.
  bool settled() const { return settled_cost_ < kNoPair; }

  /// Whether there is a winner that many dots agree upon: few may do so by chance.
  bool sure() {
    const auto best = winner();
    return best && std::ssize(sightings_of(best->led_of_dot)) >= kManyDots;
  }

  /// Who turns away from the wall is looked for by few dots alone: else these would seem to be of
  /// one who does not.
  double steepest_rad() const { return few_ ? radians(120) : radians(80); }

  RoughPoses of_pair(const std::pair<std::size_t, std::size_t>& pair) const {
    return candidates_from_pair(cameras_, views_[pair.first], views_[pair.second], leds_,
                                /*least_leds=*/1, options_.candidates_kept, steepest_rad());
  }
  RoughPoses of_one(const CameraView& view) const {
    return view.dots_px.size() < 3 ? RoughPoses(none)
                                   : candidates_from_one(cameras_, view, leds_, steepest_rad());
  }
  static std::optional<std::vector<Rigid3>> none() { return std::nullopt; }

  const CameraModel& camera(const CameraView& view) const {
    return cameras_[static_cast<std::size_t>(view.camera)];
  }

  /// Of each dot (row) and LED (column): the square of their distance, in sigmas.
  CostMatrix distances(const CameraView& view, const Rigid3& pose, double sigma_px) const {
    CostMatrix costs = CostMatrix::Constant(static_cast<Eigen::Index>(view.dots_px.size()),
                                            static_cast<Eigen::Index>(leds_.size()), kNoPair);
    for (Eigen::Index led = 0; led < costs.cols(); ++led) {
      const auto dot = dot_of_led(camera(view), pose, leds_[static_cast<std::size_t>(led)]);
      if (!dot) continue;
      for (Eigen::Index i = 0; i < costs.rows(); ++i)
        costs(i, led) = (view.dots_px[static_cast<std::size_t>(i)] - dot->raw_px).squaredNorm() /
                        (sigma_px * sigma_px);
    }
    return costs;
  }

  /// In each view the cheapest pairing of dots and LEDs; `gate_px` zero: by the dots' own sigma.
  Labels label(const Rigid3& pose, double gate_px) const {
    Labels labels;
    for (const CameraView& view : views_)
      labels.push_back(assign(distances(view, pose, gate_px > 0 ? gate_px / 4 : view.sigma_px),
                              options_.false_dot_cost));
    return labels;
  }

  /// Whether the dots lie so far from this pose's that no further round makes it a rival.
  bool hopeless(const Rigid3& pose) const {
    constexpr double kGain = 60;  // of a round, in sigmas squared
    double least = 0;
    for (const CameraView& view : views_) {
      const CostMatrix costs = distances(view, pose, view.sigma_px);
      for (Eigen::Index dot = 0; dot < costs.rows(); ++dot)
        least += std::min(costs.row(dot).minCoeff(), options_.false_dot_cost);
    }
    return least > settled_cost_ + options_.least_margin + kGain;
  }

  std::vector<LedSighting> sightings_of(const Labels& labels) const {
    std::vector<LedSighting> sightings;
    for (std::size_t v = 0; v < views_.size(); ++v)
      for (std::size_t i = 0; i < labels[v].size(); ++i)
        if (labels[v][i] >= 0)
          sightings.push_back({views_[v].camera, leds_[static_cast<std::size_t>(labels[v][i])],
                               views_[v].dots_px[i], views_[v].sigma_px});
    return sightings;
  }

  void judge(const PoseFit& fit, Labels labels, bool believed = false) {
    if (fit.rms_px > options_.largest_rms_px) return;
    const TrackingLevel level = level_of(fit.dot_information);
    double cost = fit.cost;
    bool all_explained = true;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const auto false_dots = std::ranges::count(labels[v], -1);
      const auto seen = static_cast<double>(labels[v].size()) - static_cast<double>(false_dots);
      cost += options_.false_dot_cost * static_cast<double>(false_dots) +
              options_.missing_led_cost * (static_cast<double>(leds_.size()) - seen);
      all_explained &= false_dots == 0;
    }
    if (all_explained && level == TrackingLevel::six_dof)
      settled_cost_ = std::min(settled_cost_, cost);
    entries_.push_back({fit, level, std::move(labels), cost, kNoPair, believed});
  }

  static constexpr std::size_t kRounds = 3;
  static constexpr std::array<double, kRounds> kGates_px = {40, 12, 0};  // zero: the dots' sigma

  static bool elsewhere(const FoundHead& a, const FoundHead& b) {
    constexpr double kSame_m = 0.03, kSame_rad = radians(12);
    const Rigid3 &p = a.fit.room_from_head, &q = b.fit.room_from_head;
    return (p.translation - q.translation).norm() > kSame_m ||
           p.rotation.angularDistance(q.rotation) > kSame_rad;
  }

  std::span<const CameraModel> cameras_;
  std::vector<CameraView> views_;
  std::vector<Vec3> leds_;
  AcquisitionOptions options_;
  PosePrior prior_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
  bool few_;  // dots
  std::size_t next_pair_ = 0, next_view_ = 0;
  RoughPoses poses_ = none;  // of the pair or view before these
  std::array<std::vector<Labels>, kRounds> tried_;
  std::vector<FoundHead> entries_;
  double settled_cost_ = kNoPair;  // of the best pose that leaves no dot over
};

HeadSearch::HeadSearch(std::span<const CameraModel> cameras, std::vector<CameraView> views,
                       std::vector<Vec3> leds_in_head, const AcquisitionOptions& options)
    : contest_(
          std::make_unique<Contest>(cameras, std::move(views), std::move(leds_in_head), options)) {}
HeadSearch::~HeadSearch() = default;
HeadSearch::HeadSearch(HeadSearch&&) noexcept = default;
HeadSearch& HeadSearch::operator=(HeadSearch&&) noexcept = default;

bool HeadSearch::advance(std::size_t most) {
  for (; most > 0; --most)
    if (!contest_->step()) {
      contest_->enter_believed();
      return true;
    }
  return false;
}

std::size_t HeadSearch::steps() const { return contest_->steps(); }

std::optional<FoundHead> HeadSearch::winner() const { return contest_->winner(); }

bool HeadSearch::believed_is_beaten() const { return contest_->believed_is_beaten(); }

std::optional<Rigid3> HeadSearch::leading() const { return contest_->leading(); }

const std::vector<CameraView>& HeadSearch::views() const { return contest_->views(); }

std::optional<FoundHead> find_head(std::span<const CameraModel> cameras,
                                   std::span<const CameraView> views,
                                   std::span<const Vec3> leds_in_head,
                                   const AcquisitionOptions& options) {
  HeadSearch search(cameras, {views.begin(), views.end()},
                    {leds_in_head.begin(), leds_in_head.end()}, options);
  search.advance(std::numeric_limits<std::size_t>::max());
  return search.winner();
}

}  // namespace vindu
