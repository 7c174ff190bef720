// Vindu's own tracking: every dot of every camera, at the time it was captured, corrects one filter
// per head; what comes late is put where it belongs and the rest is done again. Heads that are not
// tracked are looked for, and tracked ones are checked against what a fresh look would find. Only
// reports and their arrivals come in.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "core/site.h"
#include "tracker/joint/acquisition.h"
#include "tracker/joint/association.h"
#include "tracker/joint/camera_watch.h"
#include "tracker/joint/capture_clock.h"
#include "tracker/joint/disagreement.h"
#include "tracker/joint/dot_sizes.h"
#include "tracker/joint/quorum.h"
#include "tracker/joint/static_dots.h"

namespace vindu {

struct JointOptions {
  /// position: the heads' rotation is taken as facing the wall; one LED in two cameras is enough.
  bool position_only = false;
  double dot_sigma_px = 0.6;  ///< of a Wiimote's dots: rounding and half a unit of noise
  std::optional<MotionNoise> fixed_noise = {};  ///< to compare with: a filter that knows one motion
};

/// What the tracker knows of a camera beside its dots.
struct CameraHealth {
  bool moved = false;        ///< its dots do not fit what the others see
  bool device_time = false;  ///< its own clock is known; else arrivals are used
  std::size_t masks = 0;     ///< reflections that are ignored
  double aside_px = 0;       ///< of three or more: its dots, from where the others tell
};

/// Bound to one thread at a time.
class JointMethod {
 public:
  /// Throws Error for more than 16 cameras.
  JointMethod(std::span<const CameraConfig> cameras, std::span<const HeadConfig> heads,
              const JointOptions& options = {});

  JointMethod(JointMethod&&) = default;
  JointMethod& operator=(JointMethod&&) = default;

  /// Arrivals of one camera must not go back. Cheap: the work is done when somebody asks.
  void absorb(const Observation& observation);

  /// Where head number `head` will be at `photon`, as known after an update, since which nothing
  /// was absorbed; the capture time is that of the newest dot it rests on. Level held or lost when
  /// no dot has been seen for long. Empty until the head was found for the first time.
  std::optional<PoseSample> pose(std::size_t head, Time photon) const;

  /// Takes in what was absorbed, looks for heads that are lost, checks the others.
  void update(Time now);

  std::vector<CameraHealth> health() const;
  /// By how much the cameras contradict each other, beyond what their dots' noise explains, and
  /// nobody can say which is wrong: raw pixels, one sigma; 0 where they agree.
  double disagreement_px() const {
    return std::max(disagreement_.sigma_px(), quorum_.undecided_px());
  }
  /// By which share heads look larger than their LEDs are apart where the cameras' rays meet; that
  /// of the camera with the most, of two or more. Poses of cameras, lenses or LEDs are wrong then.
  double heads_look_larger() const;
  /// Whether two cameras have seen dots enough for seconds that are no head's, whatever is allowed
  /// for.
  bool nothing_fits() const;

 private:
  struct Entry {
    TimedDots seen;
    Time other_time{};  // of capture, by the clock that is not in use
    Association association;
    std::vector<std::pair<std::size_t, HeadState>> births;  // of heads found here
    std::vector<HeadTrack> after;
    bool judged = false;
  };

  struct Eye {  // one camera's
    CaptureClock clock;
    bool uses_device_time = true;
    StaticDots statics{};
    DotSizes sizes{};
    CameraWatch watch{};
  };

  /// A search, and the newest report of those that it rests on.
  struct Look {
    HeadSearch search;
    int camera = 0;
    Time captured{};
    Time common{};                    ///< that the reports' captures are near to
    std::optional<Rigid3> tracked{};  ///< where the head was by then
    double slack_px = 0;              ///< that its dots were given for what cameras contradict
    bool tolerant = false;            ///< that was more than cameras were known to contradict
    bool hurried = false;  ///< something speaks against where it is tracked, or it is not
  };

  /// What a look found, beside what is tracked.
  struct Verdict {
    bool fits = false;     ///< it may be the head
    bool known = false;    ///< which is tracked there already
    bool better = false;   ///< there, but by fewer dots
    bool doubted = false;  ///< no head is tracked, or one that most dots contradict
  };
  struct Search;

  void insert(Entry entry);
  void replay();
  void judge(Entry& entry);
  void forget_old();
  void look_for(std::size_t head, Time now);
  void go_on(std::size_t head, Duration frame);
  static std::size_t steps_of(const Look& look, Duration frame);
  Verdict verdict_on(const Look& look, std::size_t head,
                     const std::optional<FoundHead>& found) const;
  static bool confirmed(Search& search, const Rigid3& pose, Time captured, int looks);
  void conclude(std::size_t head);
  std::optional<std::size_t> entry_of(const Look& look) const;
  Time common_time() const;
  std::vector<std::size_t> together(Time common) const;
  CameraView view_of(const Entry& entry, std::size_t head, Duration apart, double slack_px) const;
  bool may_contradict() const;
  void note_disagreement();
  bool moved(std::size_t camera) const;
  bool stands_aside(std::size_t camera) const;
  void weigh_tracked(Time now);
  void weigh(const Look& look, std::size_t head);
  bool puzzled() const;
  bool known_by_facing(std::size_t head) const;
  AcquisitionOptions acquisition_options(std::size_t head, const std::optional<Rigid3>& believed,
                                         double slack_px) const;
  std::ptrdiff_t dots_tracked_by(std::size_t head) const;
  bool may_be_another(const Look& look, std::size_t head, const FoundHead& found) const;
  double cost_alone(const CameraView& view, std::size_t head) const;
  bool pictures_another(const Look& look, std::size_t head, const FoundHead& found,
                        double by) const;
  bool is_another(const Look& look, std::size_t head, const FoundHead& found) const;
  bool dots_enough(const Look& look, std::size_t head) const;
  Duration pause_of_looks(std::size_t head) const;
  bool contradicted(std::size_t head) const;
  bool sure(std::size_t head) const;
  static bool bears(const Entry& entry, std::size_t head);
  void bear(std::size_t head, const FoundHead& found, std::size_t entry);
  Mat6 information_now(std::size_t head) const;
  void add_misfit(std::size_t head, PoseSample& sample) const;
  TrackingLevel level_now(std::size_t head) const;
  void judge_cameras(const std::vector<CameraView>& views, const FoundHead& found);
  const std::vector<HeadTrack>& newest_heads() const;

  JointOptions options_;
  AssociationOptions association_;
  std::vector<CameraModel> cameras_;
  std::vector<Eye> eyes_;
  std::vector<std::vector<Vec3>> leds_of_heads_;
  Disagreement disagreement_;  // of two cameras
  Quorum quorum_;              // of more
  Time weighed_{};             // when it was asked last
  Time puzzled_since_{};
  bool all_tracked_ = false;   // else somebody may be much nearer than the others
  std::deque<Entry> entries_;  // in order of capture
  std::size_t replay_from_ = 0;
  Time now_{};                   // of the last update
  std::vector<HeadTrack> base_;  // before the first entry
  struct Rumour {                // where a look found it
    Rigid3 pose;
    Time captured{};
  };
  struct Search {
    std::optional<Look> look{};      // that has begun
    Time looked{};                   // when the last one began
    Time seen = Time::min();         // capture of the newest report of that look
    std::optional<Rumour> rumour{};  // of the last look, unless it is tracked there
    int confirmed = 0;               // looks in a row that found it there
    int beaten = 0;                  // looks in a row that found better than what is tracked
    FailedLooks failed{};
    HeadTrack last{};  // that was tracked
    Time sure{};       // capture of the newest report when it was sure
  };
  std::vector<Search> searches_;
};

}  // namespace vindu
