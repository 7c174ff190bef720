// The whole measurement of `vindu measure accuracy`: which geometries, motions and links, run side
// by side on the machine's processors, and how the outcome stands against the targets.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulator/moving_study.h"
#include "simulator/single_frame.h"

namespace vindu::app {

struct AccuracyOptions {
  int poses = 800;       ///< of each row of single frames
  double length_s = 12;  ///< of each moving row
  std::uint64_t seed = 1;
  bool quick = false;  ///< few rows, to see that all is well
};

/// Single frames of one geometry.
struct FrameRow {
  FrameStudyOptions options;
  FrameStudy study;

  /// Empty where no pose was found right.
  std::optional<double> over_bound() const {
    if (!(study.bound.eye_m > 0)) return std::nullopt;
    return study.joint.eye_m / study.bound.eye_m;
  }
};

/// One motion. The thesis' method has its own helmet and two cameras.
struct MovingRow {
  MovingStudyOptions options;
  MovingStudy study;
  std::optional<ThesisErrors> thesis;

  double over_fixed() const { return study.joint.eye_rms_m / study.best_fixed.eye_rms_m; }
  /// Over the frames alone that it tracks with six degrees of freedom.
  std::optional<double> over_thesis() const;
};

struct Accuracy {
  std::vector<FrameRow> frames = {};  ///< in full sight, then in partial sight
  std::vector<MovingRow> moving = {};
};

/// `progress` is told the share that is done, from any thread but never from two at once.
Accuracy measure_accuracy(const AccuracyOptions& options,
                          const std::function<void(double)>& progress);

/// What the tracker is to reach (and the row that is farthest from it).
struct AccuracyTarget {
  std::string what;
  double limit = 0;
  double worst = 0;
  std::string where = {};

  bool met() const { return worst <= limit; }
};
std::vector<AccuracyTarget> targets_of(const Accuracy& accuracy);

/// "3 m, base 2 m, 2 cameras, 3 LEDs"
std::string name_of(const FrameRow& row);
/// "sways 0.57 m/s, bursts, 30 ms, 2 cameras, 3 LEDs"
std::string name_of(const MovingRow& row);

}  // namespace vindu::app
