#include "tracker/joint/joint_method.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/error.h"

namespace vindu {
namespace {

using Milliseconds = std::chrono::milliseconds;

constexpr Duration kKept = Milliseconds(200);         // reports that a late one may come before
constexpr Duration kTogether = Milliseconds(17);      // apart, two pictures still show one pose
constexpr Duration kFresh = Milliseconds(80);         // older reports find no heads
constexpr Duration kLook = Milliseconds(25);          // between two looks for a lost head
constexpr Duration kDoubt = Milliseconds(50);         // between two checks of a doubtful one
constexpr Duration kCheck = std::chrono::seconds(2);  // and of one that explains all dots,
constexpr Duration kCheckMany = std::chrono::seconds(10);  // so many that they agree on no other
constexpr Duration kLevelWindow = Milliseconds(35);        // that the level is judged by
constexpr Duration kHeld = Milliseconds(250);
constexpr Duration kLost = std::chrono::seconds(2);
constexpr Duration kRemembered = Milliseconds(500);  // what was sure, to place the eye by
constexpr double kHeadSpeed_px_s = 250;  // what pictures apart in time add to a dot's sigma

std::ptrdiff_t dots_of(const FoundHead& found) {
  std::ptrdiff_t dots = 0;
  for (const auto& leds : found.led_of_dot) dots += std::ssize(leds) - std::ranges::count(leds, -1);
  return dots;
}

/// Few dots that are not one head's fit some pose as well, but seldom as closely as a head's.
bool fits_closely(const FoundHead& found) {
  constexpr double kLargest = 2.5;  // squared sigmas for each number that the pose leaves free
  const std::ptrdiff_t dots = dots_of(found);
  if (dots >= kManyDots || found.level != TrackingLevel::six_dof) return true;
  return found.fit.cost <=
         kLargest * static_cast<double>(std::max<std::ptrdiff_t>(2 * dots - 6, 1));
}

/// The fewer dots agree, the more often they must, unless those of a tracked head agree even less.
int looks_needed(const FoundHead& found, bool contradicted) {
  return dots_of(found) >= kManyDots || contradicted ? 2 : 4;
}

bool same_pose(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm() < 0.06 &&
         a.rotation.angularDistance(b.rotation) < radians(20);
}

}  // namespace

JointMethod::JointMethod(std::span<const CameraConfig> cameras, std::span<const HeadConfig> heads,
                         const JointOptions& options)
    : options_(options), base_(heads.size()), searches_(heads.size()) {
  if (cameras.size() > kMaxCameras)
    throw Error(
        {"names " + std::to_string(cameras.size()) + " cameras", "[[camera]]", "name 16 at most"});
  association_.turns = !options.position_only;
  association_.fixed_noise = options.fixed_noise;
  for (const CameraConfig& camera : cameras) {
    cameras_.emplace_back(camera);
    eyes_.push_back({.clock = CaptureClock(from_seconds(1e-3 * camera.lag_ms)),
                     .uses_device_time = camera.source != CameraSource::video,
                     .statics = StaticDots({}, camera.masks_px)});
  }
  for (const HeadConfig& head : heads) leds_of_heads_.push_back(head.leds_in_head);
}

void JointMethod::absorb(const Observation& observation) {
  assert(observation.camera >= 0 && static_cast<std::size_t>(observation.camera) < eyes_.size());
  Eye& eye = eyes_[static_cast<std::size_t>(observation.camera)];
  const CaptureTime device = eye.clock.capture_of(observation.arrival);
  const CaptureTime arrival = {observation.arrival - eye.clock.lag(), Milliseconds(2)};
  const CaptureTime& used = eye.uses_device_time ? device : arrival;
  Entry entry;
  entry.other_time = eye.uses_device_time ? arrival.time : device.time;
  entry.seen = {.camera = observation.camera,
                .captured = used.time,
                .time_sigma_s = seconds(used.sigma),
                .dot_sigma_px = options_.dot_sigma_px,
                .distrust = eye.watch.distrust(),
                .dots = {}};
  for (const Dot& dot : observation.dots) {
    entry.seen.masked[entry.seen.dots.size()] = eye.statics.masked(raw_px_of(dot));
    entry.seen.dots.push_back(dot);
  }
  insert(std::move(entry));
}

void JointMethod::insert(Entry entry) {
  if (!entries_.empty() && entry.seen.captured + kKept < entries_.back().seen.captured) return;
  const auto place = std::ranges::upper_bound(entries_, entry.seen.captured, {},
                                              [](const Entry& e) { return e.seen.captured; });
  const auto index = static_cast<std::size_t>(place - entries_.begin());
  entries_.insert(place, std::move(entry));
  replay_from_ = std::min(replay_from_, index);
}

const std::vector<HeadTrack>& JointMethod::newest_heads() const {
  return entries_.empty() ? base_ : entries_.back().after;
}

void JointMethod::replay() {
  for (std::size_t i = replay_from_; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    entry.after = i == 0 ? base_ : entries_[i - 1].after;
    const auto camera = static_cast<std::size_t>(entry.seen.camera);
    AssociationOptions options = association_;
    options.may_widen = eyes_[camera].watch.may_widen();
    entry.association =
        associate(entry.seen, cameras_[camera], leds_of_heads_, entry.after, options);
    for (const auto& [head, state] : entry.births) {
      entry.after[head].state = state;
      HeadTrack& born = entry.after[head];
      born.seen = entry.seen.captured;
      born.seen_by.fill(born.seen);
      born.led_seen.fill(born.seen);
    }
    judge(entry);
  }
  replay_from_ = entries_.size();
  forget_old();
}

void JointMethod::forget_old() {
  while (!entries_.empty() &&
         entries_.front().seen.captured + kKept < entries_.back().seen.captured) {
    base_ = std::move(entries_.front().after);
    entries_.pop_front();
    --replay_from_;
  }
}

// Where a head was found by two cameras or more, a further one whose dots are all left over does
// not stand where it is said to. Of two cameras nobody can say which is wrong.
void JointMethod::judge_cameras(const std::vector<CameraView>& views, const FoundHead& found) {
  const auto labelled = [](const std::vector<int>& leds) {
    return std::ranges::any_of(leds, [](int led) { return led >= 0; });
  };
  const auto agree = std::ranges::count_if(found.led_of_dot, labelled);
  for (std::size_t v = 0; v < views.size(); ++v)
    if (const bool fits = labelled(found.led_of_dot[v]);
        views[v].dots_px.size() >= 2 && agree - fits >= 2)
      eyes_[static_cast<std::size_t>(views[v].camera)].watch.judge(fits);
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
    const Vec2 raw_px = raw_px_of(entry.seen.dots[i]);
    if (explained[i])
      eye.statics.release(raw_px, entry.seen.captured);
    else if (!entry.association.disputed[i])
      eye.statics.watch(raw_px, entry.seen.captured);
  }
  eye.watch.count(entry.association);
  const double other_s = seconds(entry.other_time - entry.seen.captured);
  if (eye.clock.locked() && eye.watch.prefers_other_time(entry.association, other_s))
    eye.uses_device_time = !eye.uses_device_time;
}

/// The newest time that all cameras which have reported lately have reported of.
Time JointMethod::common_time() const {
  std::vector<std::optional<Time>> last(cameras_.size());
  for (const Entry& entry : entries_)
    last[static_cast<std::size_t>(entry.seen.camera)] = entry.seen.captured;
  const Time end = entries_.back().seen.captured;
  Time common = end;
  for (const auto& time : last)
    if (time && end - *time < kFresh) common = std::min(common, *time);
  return common;
}

// Each camera's report nearest to that time.
std::vector<std::size_t> JointMethod::together(Time common) const {
  std::vector<std::optional<std::size_t>> nearest(cameras_.size());
  const auto off = [&](std::size_t i) {
    return std::chrono::abs(entries_[i].seen.captured - common);
  };
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    auto& best = nearest[static_cast<std::size_t>(entries_[i].seen.camera)];
    if (off(i) < kTogether && (!best || off(i) < off(*best))) best = i;
  }
  std::vector<std::size_t> entries;
  for (const auto& entry : nearest)
    if (entry) entries.push_back(*entry);
  return entries;
}

/// Of a report: the dots that may be this head's. Not those of others, nor known reflections.
CameraView JointMethod::view_of(const Entry& entry, std::size_t head, Duration apart) const {
  const TimedDots& seen = entry.seen;
  CameraView view{.camera = seen.camera,
                  .dots_px = {},
                  .sigma_px = std::hypot(seen.dot_sigma_px, kHeadSpeed_px_s * seconds(apart))};
  std::array<bool, kMaxDots> excluded = seen.masked;
  for (const AcceptedDot& dot : entry.association.accepted)
    excluded[dot.dot] = dot.head != static_cast<int>(head);
  for (std::size_t i = 0; i < seen.dots.size(); ++i)
    if (!excluded[i]) view.dots_px.push_back(raw_px_of(seen.dots[i]));
  return view;
}

void JointMethod::bear(std::size_t head, const FoundHead& found, std::size_t entry) {
  HeadState state = state_of(found.fit, entries_[entry].seen.captured);
  if (options_.position_only) {
    state.room_from_head.rotation = Quat::Identity();
    state.covariance.bottomRows<9>().setZero();
    state.covariance.rightCols<9>().setZero();
  }
  entries_[entry].births.emplace_back(head, state);
  searches_[head].sure = state.time;
  replay_from_ = std::min(replay_from_, entry);
}

AcquisitionOptions JointMethod::acquisition_options(const HeadTrack& head) const {
  AcquisitionOptions options;
  if (head.state) options.believed = head.state->room_from_head;
  // Three dots always fit some pose; where there is but one camera, that has to do.
  options.least_dots = cameras_.size() == 1 ? 3 : 4;
  if (!options_.position_only) return options;
  options.least_dots = 2;
  options.facing_sigma_rad.setConstant(1e-3);
  options.least_level = TrackingLevel::position;
  options.least_margin = 0;
  return options;
}

/// Doubtful is a head that surprises, or leaves dots of the cameras' newest reports to nobody: few
/// beside many of its own are lamps, unless a camera has nothing else.
Duration JointMethod::pause_of_looks(std::size_t head) const {
  constexpr double kSurprising = 4;
  constexpr std::ptrdiff_t kOwnPerLeft = 4;
  const HeadTrack& track = newest_heads()[head];
  if (!track.state) return kLook;
  std::vector<bool> done(cameras_.size(), false);
  std::ptrdiff_t own = 0, left = 0;
  bool nothing_else = false;
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (done[static_cast<std::size_t>(entry->seen.camera)]) continue;
    done[static_cast<std::size_t>(entry->seen.camera)] = true;
    const auto& accepted = entry->association.accepted;
    const auto unmasked = static_cast<std::ptrdiff_t>(entry->seen.dots.size()) -
                          std::ranges::count(entry->seen.masked, true);
    const auto left_here = std::max<std::ptrdiff_t>(0, unmasked - std::ssize(accepted));
    own += std::ranges::count(accepted, static_cast<int>(head), &AcceptedDot::head);
    left += left_here;
    nothing_else |= accepted.empty() && left_here >= 2;
  }
  if (track.surprise > kSurprising || nothing_else) return kDoubt;
  if (own < kManyDots) return left > 0 ? kDoubt : kCheck;
  return kOwnPerLeft * left > own ? kDoubt : left > 0 ? kCheck : kCheckMany;
}

bool JointMethod::bears(const Entry& entry, std::size_t head) {
  return std::ranges::any_of(entry.births, [&](const auto& birth) { return birth.first == head; });
}

/// Whether so few dots are the head's since it was found, and so many nobody's, that the few may
/// fit by chance. A camera that was bumped says nothing.
bool JointMethod::contradicted(std::size_t head) const {
  constexpr Duration kLately = Milliseconds(100);
  constexpr double kFew = 5, kLeftPerOwn = 0.5;
  struct Count {
    double reports = 0, own = 0, left = 0;
  };
  std::vector<Count> counts(cameras_.size());
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    const auto camera = static_cast<std::size_t>(entry->seen.camera);
    if (entries_.back().seen.captured - entry->seen.captured > kLately || bears(*entry, head) ||
        !entry->after[head].state)
      break;
    if (eyes_[camera].watch.moved()) continue;
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

// One that is tracked is looked for as well; where nothing speaks against it, by one step a
// frame, so that no frame pays for the whole look.
void JointMethod::look_for(std::size_t head, Time now) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  if (entries_.empty()) return;
  Search& search = searches_[head];
  const Duration pause = pause_of_looks(head);
  if (now - search.looked < pause) return;
  search.looked = now;
  search.look.reset();
  const Time common = common_time();
  const auto entries = together(common);
  if (entries.empty()) return;
  const std::size_t newest = *std::ranges::max_element(entries);
  const TimedDots& seen = entries_[newest].seen;
  if (seen.captured <= search.seen) return;  // the same reports prove nothing new
  search.seen = seen.captured;
  std::vector<CameraView> views;
  for (const std::size_t i : entries)
    views.push_back(
        view_of(entries_[i], head, std::chrono::abs(entries_[i].seen.captured - common)));
  const HeadTrack& track = entries_[newest].after[head];
  search.look = Look{.search = HeadSearch(cameras_, std::move(views), leds_of_heads_[head],
                                          acquisition_options(track)),
                     .camera = seen.camera,
                     .captured = seen.captured,
                     .steps = pause >= kCheck && !search.rumour ? 1 : kAll};
  if (track.state) search.look->tracked = track.state->room_from_head;
}

void JointMethod::go_on(std::size_t head) {
  std::optional<Look>& look = searches_[head].look;
  if (!look || !look->search.advance(look->steps)) return;
  conclude(head);
  look.reset();
}

/// Empty: it has become too old.
std::optional<std::size_t> JointMethod::entry_of(const Look& look) const {
  for (std::size_t i = entries_.size(); i-- > 0;)
    if (entries_[i].seen.captured == look.captured && entries_[i].seen.camera == look.camera)
      return i;
  return std::nullopt;
}

// Looks in a row that find a head in one place are right: false dots do not repeat themselves.
void JointMethod::conclude(std::size_t head) {
  Search& search = searches_[head];
  const auto found = search.look->search.winner();
  if (!found || !(options_.position_only || fits_closely(*found))) return search.rumour.reset();
  judge_cameras(search.look->search.views(), *found);
  const std::optional<Rigid3>& tracked = search.look->tracked;
  const Rigid3& pose = found->fit.room_from_head;
  if (found->believed || (tracked && same_pose(pose, *tracked))) return search.rumour.reset();
  const bool again = search.rumour && same_pose(pose, *search.rumour);
  search.rumour = pose;
  search.confirmed = again ? search.confirmed + 1 : 1;
  if (search.confirmed < looks_needed(*found, tracked && contradicted(head))) return;
  if (const auto newest = entry_of(*search.look)) bear(head, *found, *newest);
}

void JointMethod::update(Time now) {
  replay();
  for (std::size_t head = 0; head < searches_.size(); ++head) {
    look_for(head, now);
    go_on(head);
  }
  replay();
  for (std::size_t head = 0; head < searches_.size(); ++head) {
    const HeadTrack& track = newest_heads()[head];
    if (!track.state) continue;
    searches_[head].last = track;
    if (sure(head)) searches_[head].sure = entries_.back().seen.captured;
  }
}

// By the dots that each camera's newest report gave.
TrackingLevel JointMethod::level_now(std::size_t head) const {
  if (options_.position_only) return TrackingLevel::position;
  if (contradicted(head)) return TrackingLevel::held;
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
      information += dot->d_raw_d_pose.transpose() * dot->d_raw_d_pose /
                     (entry->seen.dot_sigma_px * entry->seen.dot_sigma_px);
    }
  }
  const TrackingLevel level = std::min(level_of(information), TrackingLevel::bearing);
  const Duration remembered = entries_.back().seen.captured - searches_[head].sure;
  return remembered > kRemembered ? TrackingLevel::bearing : level;
}

std::optional<PoseSample> JointMethod::pose(std::size_t head, Time photon) const {
  const HeadTrack& last = searches_[head].last;
  if (!last.state) return std::nullopt;
  const Duration unseen = photon - last.seen;
  const bool tracked = newest_heads()[head].state && unseen < kHeld + AheadOptions{}.limit;
  PoseSample sample =
      tracked ? predicted(*last.state, photon - last.state->time) : sample_of(*last.state);
  sample.object = static_cast<int>(head);
  sample.time = photon;
  sample.capture_time = last.seen;
  sample.level = tracked          ? level_now(head)
                 : unseen > kLost ? TrackingLevel::lost
                                  : TrackingLevel::held;
  return sample;
}

std::vector<CameraHealth> JointMethod::health() const {
  std::vector<CameraHealth> health;
  for (const Eye& eye : eyes_)
    health.push_back({.moved = eye.watch.moved(),
                      .device_time = eye.uses_device_time && eye.clock.locked(),
                      .masks = eye.statics.masks_px().size()});
  return health;
}

}  // namespace vindu
