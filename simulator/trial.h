// A trial of the tracker: a head that moves as it is told to, before emulated Wiimotes, and how far
// the eye that each method gives is from the true one when the light leaves the wall. Bytes and
// arrivals alone reach the tracker.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/site.h"
#include "simulator/emulated_wiimote.h"
#include "tracker/tracker.h"

namespace vindu {

struct TrialOptions {
  std::vector<CameraConfig> cameras;
  HeadConfig head;
  std::function<Rigid3(Time)> room_from_head;
  EmulatedWiimoteOptions wiimote{};  ///< each camera derives its own seed from this one
  Duration warm_up = std::chrono::seconds(3);
  Duration length = std::chrono::seconds(20);  ///< that is measured, after the warm-up
  double rate_hz = 60;
  Duration photon_lag = std::chrono::milliseconds(30);  ///< from a tick to its light
  std::vector<MotionNoise> fixed_noises = {};  ///< joint filters beside the methods, one for each
};

/// One frame of one method.
struct TrialFrame {
  Time photon{};
  TrackingLevel level = TrackingLevel::lost;
  double eye_error_m = 0;  ///< where the level is above held
  double eye_sigma_m = 0;  ///< what the pose's covariance says of the eye: root of the trace
  double turn_error_rad = 0;
  Vec3 eye_in_room = Vec3::Zero();
};

struct TrialErrors {
  double found = 0;  ///< share of the frames with a level above held
  double eye_rms_m = 0, eye_p95_m = 0, eye_max_m = 0;
  double turn_rms_rad = 0;
  std::array<double, 4> levels{};  ///< shares of the frames, by TrackingLevel down to bearing
};
TrialErrors errors_of(const std::vector<TrialFrame>& frames);

/// All methods see the same reports; their frames, in the order of `methods`, then of the filters
/// with fixed noise.
std::vector<std::vector<TrialFrame>> run_trial(const TrialOptions& options,
                                               const std::vector<TrackingConfig>& methods);

/// What the driver hands to a tracker in such a trial, in the order of arrival.
std::vector<Observation> observations_of(const TrialOptions& options);

/// To and fro in front of `middle_in_room` on sines of unlike rates, facing the wall; peaks of
/// speed and turning are those given.
std::function<Rigid3(Time)> swaying(const Vec3& middle_in_room, double peak_m_s, double peak_rad_s);

}  // namespace vindu
