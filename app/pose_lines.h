// What a tracker finds, as lines of JSON: poses, gestures, presses of buttons, and cameras whose
// state changed. Used live and on recordings, so that both say the same.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/tracker_events.h"
#include "core/site.h"
#include "tracker/tracker.h"

namespace vindu::app {

class PoseLines {
 public:
  PoseLines(const Site& site, std::vector<LookTarget> targets);

  /// The lines that are new since the last frame. That was at `now`, and `followed` is the pose
  /// that the tracker gave; times are moved by `shift`. A pose is news when it rests on newer dots
  /// or its level changed; a camera of the wall file at first, and when what is said of it changed.
  std::vector<std::string> news(const Tracker& tracker, const std::optional<PoseSample>& followed,
                                Time now, Duration shift);

  /// Gestures of the last frame.
  const std::vector<GestureEvent>& events() const { return events_; }

 private:
  void add_poses(const Tracker& tracker, const std::optional<PoseSample>& followed, Duration shift,
                 std::vector<std::string>& lines);
  void add_misfit(const Tracker& tracker, Time now, Duration shift,
                  std::vector<std::string>& lines);
  void add_health(const Tracker& tracker, Time now, Duration shift,
                  std::vector<std::string>& lines);

  const Site& site_;
  HeadGestures gestures_;
  std::map<int, PoseSample> said_;
  std::vector<GestureEvent> events_;
  struct Health {  // of a camera, as it is said
    bool heard = false, moved = false, device_time = false;
    std::size_t masks = 0;
    double aside_px = 0;

    bool operator==(const Health&) const = default;
  };
  std::vector<std::optional<Health>> health_;
  struct Misfit {  // as it is said
    long disagreement_px = 0;
    long half_percents = 0;  // that heads look larger

    bool operator==(const Misfit&) const = default;
  } misfit_;
};

}  // namespace vindu::app
