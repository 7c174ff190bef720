#include "simulator/trial.h"

#include <algorithm>
#include <cmath>

#include "simulator/emulated_room.h"
#include "tracker/joint/rotation.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

Site site_of(const TrialOptions& options) {
  Site site;
  site.cameras = options.cameras;
  site.heads = {options.head};
  return site;
}

/// The emulated Wiimotes and the driver that reads them.
class Cameras {
 public:
  Cameras(const TrialOptions& options, Clock& clock)
      : room_(site_of(options), clock,
              {.body = helmet_body(options.head, options.room_from_head),
               .wiimote = options.wiimote}) {
    for (std::size_t i = 0; i < options.cameras.size(); ++i)
      readers_.emplace_back(room_.connect(i), static_cast<int>(i));
  }

  template <class Take>
  void drain(Time now, Take take) {
    for (WiimoteReader& reader : readers_)
      while (const auto seen = reader.next(now)) take(*seen);
  }

 private:
  EmulatedRoom room_;
  std::vector<WiimoteReader> readers_;
};

double eye_sigma_m(const PoseSample& pose, const Vec3& eye_in_head) {
  Eigen::Matrix<double, 3, 6> d_eye_d_pose;
  d_eye_d_pose << Mat3::Identity(), -cross_matrix(pose.room_from_head.rotation * eye_in_head);
  return std::sqrt((d_eye_d_pose * pose.covariance * d_eye_d_pose.transpose()).trace());
}

TrialFrame judged(const std::optional<PoseSample>& pose, const TrialOptions& options, Time photon) {
  TrialFrame frame{.photon = photon};
  if (!pose) return frame;
  const Rigid3 truth = options.room_from_head(photon);
  frame.level = pose->level;
  frame.eye_in_room = pose->room_from_head * options.head.eye_in_head;
  frame.eye_error_m = (frame.eye_in_room - truth * options.head.eye_in_head).norm();
  frame.eye_sigma_m = eye_sigma_m(*pose, options.head.eye_in_head);
  frame.turn_error_rad = pose->room_from_head.rotation.angularDistance(truth.rotation);
  return frame;
}

double rms(double sum_of_squares, std::size_t count) {
  return count ? std::sqrt(sum_of_squares / static_cast<double>(count)) : 0;
}

}  // namespace

TrialErrors errors_of(const std::vector<TrialFrame>& frames) {
  std::vector<double> eyes_m;
  double eye2 = 0, turn2 = 0;
  std::array<double, 4> levels{};
  for (const TrialFrame& frame : frames) {
    if (frame.level >= TrackingLevel::held) continue;
    eyes_m.push_back(frame.eye_error_m);
    eye2 += frame.eye_error_m * frame.eye_error_m;
    turn2 += frame.turn_error_rad * frame.turn_error_rad;
    levels[static_cast<std::size_t>(frame.level)] += 1 / static_cast<double>(frames.size());
  }
  if (eyes_m.empty()) return {};
  std::ranges::sort(eyes_m);
  const auto p95 = static_cast<std::size_t>(0.95 * static_cast<double>(eyes_m.size() - 1));
  return {.found = static_cast<double>(eyes_m.size()) / static_cast<double>(frames.size()),
          .eye_rms_m = rms(eye2, eyes_m.size()),
          .eye_p95_m = eyes_m[p95],
          .eye_max_m = eyes_m.back(),
          .turn_rms_rad = rms(turn2, eyes_m.size()),
          .levels = levels};
}

std::vector<std::vector<TrialFrame>> run_trial(const TrialOptions& options,
                                               const std::vector<TrackingConfig>& methods) {
  ManualClock clock;
  Cameras cameras(options, clock);
  std::vector<Tracker> trackers;
  for (const TrackingConfig& method : methods)
    trackers.emplace_back(options.cameras, std::vector{options.head}, Rigid3{}, method);
  std::vector<JointMethod> filters;
  for (const MotionNoise& noise : options.fixed_noises)
    filters.emplace_back(options.cameras, std::vector{options.head},
                         JointOptions{.fixed_noise = noise});
  std::vector<std::vector<TrialFrame>> frames(methods.size() + filters.size());
  const Time begin = Time{} + options.warm_up, end = begin + options.length;
  for (std::int64_t tick = 1; clock.now() < end; ++tick) {
    clock.sleep_until(Time{from_seconds(static_cast<double>(tick) / options.rate_hz)});
    const Time now = clock.now(), photon = now + options.photon_lag;
    cameras.drain(now, [&](const Observation& seen) {
      for (Tracker& tracker : trackers) tracker.absorb(seen);
      for (JointMethod& filter : filters) filter.absorb(seen);
    });
    for (std::size_t i = 0; i < trackers.size(); ++i) {
      const auto pose = trackers[i].track(now, photon);
      if (now >= begin) frames[i].push_back(judged(pose, options, photon));
    }
    for (std::size_t i = 0; i < filters.size(); ++i) {
      filters[i].update(now);
      if (now >= begin)
        frames[trackers.size() + i].push_back(judged(filters[i].pose(0, photon), options, photon));
    }
  }
  return frames;
}

std::vector<Observation> observations_of(const TrialOptions& options) {
  ManualClock clock;
  Cameras cameras(options, clock);
  std::vector<Observation> all;
  const Time end = Time{} + options.warm_up + options.length;
  while (clock.now() < end) {
    clock.sleep_until(clock.now() + std::chrono::milliseconds(1));
    cameras.drain(clock.now(), [&](const Observation& seen) { all.push_back(seen); });
  }
  return all;
}

std::function<Rigid3(Time)> swaying(const Vec3& middle_in_room, double peak_m_s,
                                    double peak_rad_s) {
  return [=](Time time) {
    const double t = seconds(time.time_since_epoch());
    const auto sine = [&](double rate_hz, double phase) {
      return std::sin(2 * kPi * rate_hz * t + phase) / (2 * kPi * rate_hz);
    };
    // Speeds add up to the peak where all sines pass zero together.
    const Vec3 way(0.75 * sine(0.43, 0) + 0.2 * sine(0.9, 1), 0.25 * sine(0.71, 2),
                   0.55 * sine(0.37, 0.5));
    const Vec3 turn(0.35 * sine(0.53, 1.3), 0.85 * sine(0.47, 0.2), 0.25 * sine(0.61, 2.1));
    const Quat rotation = Eigen::AngleAxisd(peak_rad_s * turn.y(), Vec3::UnitY()) *
                          Eigen::AngleAxisd(peak_rad_s * turn.x(), Vec3::UnitX()) *
                          Eigen::AngleAxisd(peak_rad_s * turn.z(), Vec3::UnitZ());
    return Rigid3{rotation, middle_in_room + peak_m_s * way};
  };
}

}  // namespace vindu
