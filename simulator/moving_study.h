// Moving heads: a motion, a radio link and a row of Wiimotes, and the eye errors of the joint
// method, of the same filter with the best of many fixed process noises, and of the thesis' method,
// all from the same reports.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "simulator/single_frame.h"
#include "simulator/trial.h"

namespace vindu {

enum class HeadMoves { still, sways, walks, starts_and_stops };
std::string_view name_of(HeadMoves moves);

/// good: each Wiimote has an adapter of its own. The others are of two on one adapter, as in the
/// thesis' Table 5.1: whole, with 5 % of the reports lost, and with a false dot in 10 % of the
/// pictures.
enum class Link { good, bursts, loss, false_dots };
std::string_view name_of(Link link);

struct MovingStudyOptions {
  HeadMoves moves = HeadMoves::sways;
  double peak_m_s = 0.57;  ///< the head turns with 132 degrees a second for each; still: ignored
  Link link = Link::bursts;
  Duration photon_lag = std::chrono::milliseconds(30);
  CameraRow row;
  HeadConfig head;
  double noise_px = 0.5;  ///< before rounding
  double length_s = 20;   ///< that is measured; a still head has eight places in it
  std::uint64_t seed = 1;
};

/// With three LEDs and two cameras.
struct ThesisErrors {
  TrialErrors all;      ///< each frame in the best of its ways that the dots allow
  TrialErrors six_dof;  ///< of the frames that it tracks with six degrees of freedom, alone
};

struct MovingStudy {
  TrialErrors joint;
  TrialErrors best_fixed;  ///< of filters that know one motion: the one that this motion suits best
  double best_noise_m2_s5 = 0;  ///< its density
  std::optional<ThesisErrors> thesis;
};

MovingStudy study_moving(const MovingStudyOptions& options);

}  // namespace vindu
