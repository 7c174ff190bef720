#include "tracker/joint/joint_method.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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
constexpr Duration kHeld = Milliseconds(250);
constexpr Duration kLost = std::chrono::seconds(2);
constexpr Duration kPuzzled = std::chrono::seconds(3);  // before cameras that were named are asked
constexpr double kHeadSpeed_px_s = 250;  // what pictures apart in time add to a dot's sigma

/// Few dots that are not one head's fit some pose as well, but seldom as closely as a head's.
bool fits_by_chance(const FoundHead& found) {
  return found.dots() < kManyDots && found.level == TrackingLevel::six_dof && !found.fits_closely();
}

/// Whether it is of fewer than six dots, beside more than half as many of nobody: where cameras
/// contradict each other, these fit by chance.
bool few_beside_many(const FoundHead& found) {
  std::ptrdiff_t all = 0;
  for (const auto& leds : found.led_of_dot) all += std::ssize(leds);
  const std::ptrdiff_t own = found.dots();
  return own < kManyDots && 2 * (all - own) > own;
}

/// Than the head is tracked by. Of cameras of which one stands aside, some dots fit by chance.
bool explains_more(const FoundHead& found, std::ptrdiff_t dots_tracked_by) {
  return found.dots() >= std::max(kManyDots, dots_tracked_by + 1);
}

/// The fewer dots agree, the more often they must, unless those of a tracked head agree even less.
/// One that is tracked there, by fewer dots, may be about to be tracked by them all.
int looks_needed(const FoundHead& found, bool contradicted, bool better) {
  if (better && !contradicted) return 10;
  return found.dots() >= kManyDots || contradicted ? 2 : 4;
}

/// Of one head, so long apart: as far as people walk and turn meanwhile.
bool same_pose(const Rigid3& a, const Rigid3& b, Duration apart) {
  constexpr double kWalks_m_s = 1, kTurns_rad_s = radians(200);
  const double apart_s = seconds(apart);
  return (a.translation - b.translation).norm() < 0.06 + kWalks_m_s * apart_s &&
         a.rotation.angularDistance(b.rotation) < radians(20) + kTurns_rad_s * apart_s;
}

}  // namespace

JointMethod::JointMethod(std::span<const CameraConfig> cameras, std::span<const HeadConfig> heads,
                         const JointOptions& options)
    : options_(options), quorum_(cameras.size()), base_(heads.size()), searches_(heads.size()) {
  if (cameras.size() > kMaxCameras)
    throw Error({"names " + std::to_string(cameras.size()) + " cameras", "[[camera]]",
                 "name " + std::to_string(kMaxCameras) + " at most"});
  association_.turns = !options.position_only;
  if (cameras.size() == 1) association_.leds_that_place = 3;
  association_.fixed_noise = options.fixed_noise;
  for (const CameraConfig& camera : cameras) {
    cameras_.emplace_back(camera);
    eyes_.push_back({.clock = CaptureClock(from_seconds(1e-3 * camera.lag_ms)),
                     .uses_device_time = camera.source != CameraSource::video,
                     .statics = StaticDots({}, camera.masks_px),
                     .sizes = DotSizes(camera.source)});
  }
  for (const HeadConfig& head : heads) leds_of_heads_.push_back(head.leds_in_head);
}

void JointMethod::absorb(const Observation& observation) {
  assert(observation.camera >= 0 && static_cast<std::size_t>(observation.camera) < eyes_.size());
  const auto camera = static_cast<std::size_t>(observation.camera);
  Eye& eye = eyes_[camera];
  const CaptureTime device = eye.clock.capture_of(observation.arrival);
  const CaptureTime arrival = {observation.arrival - eye.clock.lag(), Milliseconds(2)};
  const CaptureTime& used = eye.uses_device_time ? device : arrival;
  Entry entry;
  entry.other_time = eye.uses_device_time ? arrival.time : device.time;
  entry.seen = {.camera = observation.camera,
                .captured = used.time,
                .time_sigma_s = seconds(used.sigma),
                .dot_sigma_px = std::hypot(options_.dot_sigma_px, disagreement_.sigma_px(),
                                           quorum_.doubt_px(camera)),
                .distrust = eye.watch.distrust(),
                .dots = {}};
  for (const Dot& dot : observation.dots) {
    entry.seen.masked[entry.seen.dots.size()] =
        eye.statics.masked(raw_px_of(dot)) || (all_tracked_ && eye.sizes.too_large(dot, used.time));
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
    options.farthest_px += 2 * disagreement_.sigma_px();
    TimedDots seen = entry.seen;
    if (stands_aside(camera)) seen.dots = {};
    entry.association = associate(seen, cameras_[camera], leds_of_heads_, entry.after, options);
    for (const auto& [head, state] : entry.births) {
      entry.after[head].state = state;
      HeadTrack& born = entry.after[head];
      born.seen = entry.seen.captured;
      born.seen_by.fill(born.seen);
      born.led_seen.fill(born.seen);
      born.surprise = 0;
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
CameraView JointMethod::view_of(const Entry& entry, std::size_t head, Duration apart,
                                double slack_px) const {
  const TimedDots& seen = entry.seen;
  CameraView view{
      .camera = seen.camera,
      .dots_px = {},
      .sigma_px = std::hypot(options_.dot_sigma_px, slack_px, kHeadSpeed_px_s * seconds(apart))};
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
  searches_[head].beaten = 0;
  replay_from_ = std::min(replay_from_, entry);
}

AcquisitionOptions JointMethod::acquisition_options(std::size_t head,
                                                    const std::optional<Rigid3>& believed,
                                                    double slack_px) const {
  AcquisitionOptions options;
  options.largest_rms_px += 1.5 * slack_px;
  options.believed = believed;
  // Three dots always fit some pose; where there is but one camera, that has to do.
  options.least_dots = cameras_.size() == 1 ? 3 : 4;
  if (known_by_facing(head)) {
    options.facing_sigma_rad.y() = radians(30);
    options.least_margin = 2;
  }
  if (!options_.position_only) return options;
  options.least_dots = 2;
  options.facing_sigma_rad.setConstant(1e-3);
  options.least_level = TrackingLevel::position;
  options.least_margin = 0;
  return options;
}

/// Doubtful is a head that surprises, or leaves dots of the cameras' newest reports to nobody:
/// few beside many of its own are lamps, unless a camera has nothing else.
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
    if (stands_aside(static_cast<std::size_t>(entry->seen.camera))) continue;
    const auto& accepted = entry->association.accepted;
    const auto unmasked = static_cast<std::ptrdiff_t>(entry->seen.dots.size()) -
                          std::ranges::count(entry->seen.masked, true);
    const auto left_here = std::max<std::ptrdiff_t>(0, unmasked - std::ssize(accepted));
    own += std::ranges::count(accepted, static_cast<int>(head), &AcceptedDot::head);
    left += left_here;
    nothing_else |= accepted.empty() && left_here >= 2;
  }
  if (track.surprise > kSurprising || nothing_else || searches_[head].beaten > 0) return kDoubt;
  if (own < kManyDots) return left > 0 ? kDoubt : kCheck;
  return kOwnPerLeft * left > own ? kDoubt : left > 0 ? kCheck : kCheckMany;
}

/// No frame pays for the whole look. One at a head that nothing speaks against has time; the others
/// end before their reports are forgotten, however long frames are.
std::size_t JointMethod::steps_of(const Look& look, Duration frame) {
  constexpr double kLeast = 64, kEndsAfter_s = 0.1;
  if (!look.hurried) return 1;
  const auto all = static_cast<double>(look.search.steps());
  return static_cast<std::size_t>(
      std::max(kLeast, std::ceil(all * std::min(1.0, seconds(frame) / kEndsAfter_s))));
}

// One that is tracked is looked for as well.
void JointMethod::look_for(std::size_t head, Time now) {
  if (entries_.empty()) return;
  Search& search = searches_[head];
  if (search.look && search.look->hurried && entry_of(*search.look)) return;
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
  const HeadTrack& track = entries_[newest].after[head];
  std::optional<Rigid3> tracked;
  if (track.state) tracked = track.state->room_from_head;
  // Of several cameras those that agree are right.
  const bool tolerant = may_contradict() && (!tracked || contradicted(head));
  const double slack_px =
      std::max(disagreement_.sigma_px(), tolerant ? search.failed.tried_px() : 0);
  std::vector<CameraView> views;
  for (const std::size_t i : entries)
    if (!stands_aside(static_cast<std::size_t>(entries_[i].seen.camera)))
      views.push_back(view_of(entries_[i], head,
                              std::chrono::abs(entries_[i].seen.captured - common), slack_px));
  search.look = Look{.search = HeadSearch(cameras_, std::move(views), leds_of_heads_[head],
                                          acquisition_options(head, tracked, slack_px)),
                     .camera = seen.camera,
                     .captured = seen.captured,
                     .common = common,
                     .tracked = tracked,
                     .slack_px = slack_px,
                     .tolerant = slack_px > disagreement_.sigma_px(),
                     .hurried = pause < kCheck || search.rumour};
}

void JointMethod::go_on(std::size_t head, Duration frame) {
  std::optional<Look>& look = searches_[head].look;
  if (!look || !look->search.advance(steps_of(*look, frame))) return;
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

/// Whether two cameras or more see as many dots as the head has LEDs: then it should be found.
bool JointMethod::dots_enough(const Look& look, std::size_t head) const {
  const std::size_t leds = leds_of_heads_[head].size();
  const auto all = [&](const CameraView& view) { return view.dots_px.size() >= leds; };
  return std::ranges::count_if(look.search.views(), all) >= 2;
}

/// Dots of the cameras' newest reports by which a head is tracked.
std::ptrdiff_t JointMethod::dots_tracked_by(std::size_t head) const {
  std::vector<bool> done(cameras_.size(), false);
  std::ptrdiff_t dots = 0;
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    const auto camera = static_cast<std::size_t>(entry->seen.camera);
    if (done[camera]) continue;
    done[camera] = true;
    dots +=
        std::ranges::count(entry->association.accepted, static_cast<int>(head), &AcceptedDot::head);
  }
  return dots;
}

JointMethod::Verdict JointMethod::verdict_on(const Look& look, std::size_t head,
                                             const std::optional<FoundHead>& found) const {
  Verdict verdict{.doubted = !look.tracked || contradicted(head)};
  verdict.fits = found && (options_.position_only || !fits_by_chance(*found)) &&
                 (!look.tolerant || found->dots() >= kManyDots);
  if (!verdict.fits) return verdict;
  const bool there = look.tracked && same_pose(found->fit.room_from_head, *look.tracked, {});
  // Of two cameras that contradict each other, a tolerant look is to find them all.
  const bool contrary = verdict.doubted && may_contradict() && !found->fits_closely();
  verdict.better = there && !contrary && explains_more(*found, dots_tracked_by(head));
  verdict.known =
      found->believed || (there && !verdict.better && !(look.tolerant && verdict.doubted));
  verdict.fits = verdict.known || !is_another(look, head, *found);
  return verdict;
}

// Looks in a row that find a head in one place are right: false dots do not repeat themselves.
bool JointMethod::confirmed(Search& search, const Rigid3& pose, Time captured, int looks) {
  constexpr Duration kUsual = Milliseconds(33);  // from one look to the next
  const bool again =
      search.rumour &&
      same_pose(pose, search.rumour->pose,
                std::max(Duration::zero(), captured - search.rumour->captured - kUsual));
  search.rumour = {pose, captured};
  search.confirmed = again ? search.confirmed + 1 : 1;
  return search.confirmed >= looks;
}

void JointMethod::conclude(std::size_t head) {
  Search& search = searches_[head];
  const Look& look = *search.look;
  search.beaten = look.search.believed_is_beaten() ? search.beaten + 1 : 0;
  const auto found = look.search.winner();
  const Verdict verdict = verdict_on(look, head, found);
  if (verdict.fits) judge_cameras(look.search.views(), *found);
  if (!look.tracked) weigh(look, head);
  if (!verdict.fits || verdict.known) {
    if (verdict.doubted)
      search.failed.add(dots_enough(look, head));
    else if (verdict.known)
      search.failed.forget();
    return search.rumour.reset();
  }
  const int looks = looks_needed(*found, look.tracked && verdict.doubted, verdict.better);
  if (!confirmed(search, found->fit.room_from_head, look.captured, looks)) return;
  const auto newest = entry_of(look);
  if (!newest) return;
  if (verdict.doubted && few_beside_many(*found))
    search.failed.add(dots_enough(look, head));
  else
    search.failed.forget();
  if (look.tolerant) disagreement_.found_with(look.slack_px);
  bear(head, *found, *newest);
}

void JointMethod::update(Time now) {
  const Duration frame = now - std::exchange(now_, now);
  replay();
  for (std::size_t head = 0; head < searches_.size(); ++head) {
    look_for(head, now);
    go_on(head, frame);
    replay();  // the next head is not found of the dots that this one was found of
  }
  weigh_tracked(now);
  all_tracked_ = std::ranges::all_of(
      newest_heads(), [](const HeadTrack& track) { return track.state.has_value(); });
  if (!puzzled()) puzzled_since_ = now;
  if (now - puzzled_since_ > kPuzzled) quorum_.forgive();
  for (std::size_t head = 0; head < searches_.size(); ++head) {
    const HeadTrack& track = newest_heads()[head];
    if (!track.state) continue;
    searches_[head].last = track;
    if (sure(head)) searches_[head].sure = entries_.back().seen.captured;
  }
}

std::optional<PoseSample> JointMethod::pose(std::size_t head, Time photon) const {
  assert(replay_from_ == entries_.size());
  const HeadTrack& last = searches_[head].last;
  if (!last.state) return std::nullopt;
  const Duration unseen = std::min(photon, now_ + AheadOptions{}.limit) - last.seen;
  const bool tracked = newest_heads()[head].state && unseen < kHeld + AheadOptions{}.limit;
  PoseSample sample =
      tracked ? predicted(*last.state, photon - last.state->time) : sample_of(*last.state);
  sample.object = static_cast<int>(head);
  sample.time = photon;
  sample.capture_time = last.seen;
  if (tracked) add_misfit(head, sample);
  sample.level = tracked          ? level_now(head)
                 : unseen > kLost ? TrackingLevel::lost
                                  : TrackingLevel::held;
  return sample;
}

}  // namespace vindu
