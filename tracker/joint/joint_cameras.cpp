// What the joint method makes of its cameras: whether their dots fit, which of them was bumped,
// what they see beside heads.
#include <algorithm>
#include <cmath>

#include "tracker/joint/joint_method.h"

namespace vindu {
namespace {

using Milliseconds = std::chrono::milliseconds;

/// What its dots are off by, those that are a little too far off for any correction included.
std::vector<MisfitDot> misfit_of(const TimedDots& seen, const Association& association) {
  std::vector<MisfitDot> dots = association.aside;
  for (const AcceptedDot& dot : association.accepted)
    dots.push_back({raw_px_of(seen.dots[dot.dot]) - dot.residual_px, dot.residual_px});
  return dots;
}

}  // namespace

// Where a head was found by two cameras or more, a further one whose dots are all left over does
// not stand where it is said to. Of two cameras nobody can say which is wrong.
void JointMethod::judge_cameras(const std::vector<CameraView>& views, const FoundHead& found) {
  const std::ptrdiff_t agree = found.cameras();
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto camera = static_cast<std::size_t>(views[v].camera);
    if (const bool fits = found.seen_in(v);
        views[v].dots_px.size() >= 2 && agree - fits >= 2 && (fits || !quorum_.knows(camera)))
      eyes_[camera].watch.judge(fits);
  }
}

// What a report says of its camera counts once, however often the report is replayed.
void JointMethod::judge(Entry& entry) {
  if (entry.judged) return;
  entry.judged = true;
  const auto camera = static_cast<std::size_t>(entry.seen.camera);
  Eye& eye = eyes_[camera];
  std::array<bool, kMaxDots> explained{};
  for (const AcceptedDot& dot : entry.association.accepted) explained[dot.dot] = true;
  for (std::size_t i = 0; i < entry.seen.dots.size(); ++i) {
    const Dot& dot = entry.seen.dots[i];
    const Vec2 raw_px = raw_px_of(dot);
    if (explained[i]) {
      eye.statics.release(raw_px, entry.seen.captured);
      if (!entry.seen.masked[i]) eye.sizes.note(dot, entry.seen.captured);
    } else if (!entry.association.disputed[i] && !stands_aside(camera))
      eye.statics.watch(raw_px, entry.seen.captured);
  }
  eye.watch.count(entry.association);
  if (!options_.position_only) eye.watch.note_misfit(misfit_of(entry.seen, entry.association));
  if (may_contradict()) note_disagreement();
  const double other_s = seconds(entry.other_time - entry.seen.captured);
  if (eye.clock.locked() && eye.watch.prefers_other_time(entry.association, other_s))
    eye.uses_device_time = !eye.uses_device_time;
}

/// Of two cameras: of more, the one that stands aside is named, and trusted less. Where heads
/// face the wall, whatever they do, dots never fit.
bool JointMethod::may_contradict() const { return cameras_.size() == 2 && !options_.position_only; }

void JointMethod::note_disagreement() {
  double largest_px = 0;
  for (const Eye& eye : eyes_) largest_px = std::max(largest_px, eye.watch.aside_px().norm());
  disagreement_.note_aside(largest_px);
}

double JointMethod::heads_look_larger() const {
  double most = 0;
  for (std::size_t camera = 0; camera < eyes_.size(); ++camera)
    if (const double larger = eyes_[camera].watch.larger();
        !moved(camera) && !stands_aside(camera) && std::abs(larger) > std::abs(most))
      most = larger;
  return eyes_.size() > 1 ? most : 0;
}

bool JointMethod::moved(std::size_t camera) const {
  constexpr double kMoved_px = 12;  // half a degree of a Wiimote
  return eyes_[camera].watch.moved() || quorum_.aside_px(camera).norm() > kMoved_px;
}

/// Too far for its dots to be of use.
bool JointMethod::stands_aside(std::size_t camera) const {
  constexpr double kTooFar_px = 2;
  return quorum_.aside_px(camera).norm() > kTooFar_px;
}

/// Whether nobody is tracked though two cameras see dots: those that were named may be right again,
/// and others wrong.
bool JointMethod::puzzled() const {
  if (entries_.empty() || std::ranges::any_of(newest_heads(), [](const HeadTrack& track) {
        return track.state.has_value();
      }))
    return false;
  return std::ranges::count_if(together(common_time()), [&](std::size_t entry) {
           return entries_[entry].seen.dots.size() >= 2;
         }) >= 2;
}

// By the dots of the cameras' newest pictures, each where the head was by then.
void JointMethod::weigh_tracked(Time now) {
  constexpr Duration kPause = Milliseconds(50);
  if (cameras_.size() < 3 || options_.position_only || entries_.empty() || now - weighed_ < kPause)
    return;
  weighed_ = now;
  const std::vector<std::size_t> entries = together(common_time());
  if (entries.size() < 3) return;
  const Entry& first = entries_[*std::ranges::min_element(entries)];
  for (std::size_t head = 0; head < leds_of_heads_.size(); ++head) {
    const auto& state = first.after[head].state;
    if (!state) continue;
    std::vector<Glimpse> glimpses;
    for (const std::size_t i : entries) {
      const CameraView view = view_of(entries_[i], head, Duration::zero(), 0);
      const PoseSample then = predicted(*state, entries_[i].seen.captured - state->time);
      glimpses.push_back({view.camera, then.room_from_head, view.dots_px, view.sigma_px});
    }
    quorum_.note(cameras_, leds_of_heads_[head], glimpses);
  }
}

/// The same where no head is tracked, and cameras contradict each other in where it is.
void JointMethod::weigh(const Look& look, std::size_t head) {
  const auto leading = look.search.leading();
  if (cameras_.size() < 3 || options_.position_only || !leading) return;
  std::vector<Glimpse> glimpses;
  for (const std::size_t i : together(look.common)) {
    const CameraView view =
        view_of(entries_[i], head, std::chrono::abs(entries_[i].seen.captured - look.common), 0);
    glimpses.push_back({view.camera, *leading, view.dots_px, view.sigma_px});
  }
  quorum_.note(cameras_, leds_of_heads_[head], glimpses);
}

std::vector<CameraHealth> JointMethod::health() const {
  std::vector<CameraHealth> health;
  for (std::size_t camera = 0; camera < eyes_.size(); ++camera) {
    const Eye& eye = eyes_[camera];
    health.push_back({.moved = moved(camera),
                      .device_time = eye.uses_device_time && eye.clock.locked(),
                      .masks = eye.statics.masks_px().size(),
                      .aside_px = quorum_.aside_px(camera).norm()});
  }
  return health;
}

}  // namespace vindu
