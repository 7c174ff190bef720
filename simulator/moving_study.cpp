#include "simulator/moving_study.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "core/wall.h"
#include "simulator/motions.h"
#include "simulator/person.h"

namespace vindu {
namespace {

constexpr int kPlaces = 8;  // of a still head

// Densities of jerk: factors of five, from what a head at rest is allowed to more than what one at
// 1.5 m/s is.
constexpr double kFixedNoises_m2_s5[] = {0.02, 0.1, 0.5, 2.5, 12, 60};

/// The turning part is in proportion: about the best for each motion.
std::vector<MotionNoise> fixed_noises() {
  constexpr double kTurn_rad2_m2 = 4;
  std::vector<MotionNoise> noises;
  for (const double density : kFixedNoises_m2_s5)
    noises.push_back({density * Mat3::Identity(), kTurn_rad2_m2 * density * Mat3::Identity()});
  return noises;
}

LinkOptions link_options(Link link) {
  if (link == Link::good) return {};
  LinkOptions options = two_on_one_adapter();
  options.loss = link == Link::loss ? 0.05 : 0;
  return options;
}

BodyMotion motion_of(const MovingStudyOptions& options, std::uint64_t seed) {
  constexpr double kTurn_rad_m = radians(75) / 0.57;
  const MotionPeaks peaks{options.peak_m_s, kTurn_rad_m * options.peak_m_s};
  switch (options.moves) {
    case HeadMoves::still:
      return resting(seed);
    case HeadMoves::sways:
      return swaying(kHeadPlace_in_room, peaks.move_m_s, peaks.turn_rad_s);
    case HeadMoves::starts_and_stops:
      return starting_and_stopping(peaks, seed);
    case HeadMoves::walks:
      break;
  }
  const Person person(options.head, room_from_wall_at(kDefaultCentreHeight_m, 0),
                      {.seed = seed, .peak_walk_m_s = options.peak_m_s});
  return [person](Time time) { return person.room_from_head(time); };
}

TrialOptions trial_of(const MovingStudyOptions& options, std::uint64_t seed) {
  TrialOptions trial;
  trial.cameras = cameras_of(options.row);
  trial.head = options.head;
  trial.room_from_head = motion_of(options, seed);
  trial.wiimote.seed = seed;
  trial.wiimote.noise_px = options.noise_px;
  trial.wiimote.false_dots = options.link == Link::false_dots ? 0.1 : 0;
  trial.wiimote.link = link_options(options.link);
  trial.length = from_seconds(options.length_s);
  trial.photon_lag = options.photon_lag;
  trial.fixed_noises = fixed_noises();
  if (options.moves != HeadMoves::still) return trial;
  trial.length /= kPlaces;
  trial.warm_up = std::chrono::seconds(2);
  return trial;
}

ThesisErrors thesis_errors(const std::vector<TrialFrame>& frames) {
  std::vector<TrialFrame> six_dof;
  std::ranges::copy_if(frames, std::back_inserter(six_dof), [](const TrialFrame& frame) {
    return frame.level == TrackingLevel::six_dof;
  });
  return {errors_of(frames), errors_of(six_dof)};
}

}  // namespace

std::string_view name_of(HeadMoves moves) {
  constexpr std::string_view names[] = {"still", "sways", "walks", "starts and stops"};
  return names[static_cast<int>(moves)];
}

std::string_view name_of(Link link) {
  constexpr std::string_view names[] = {"good", "bursts", "5 % lost", "10 % false"};
  return names[static_cast<int>(link)];
}

MovingStudy study_moving(const MovingStudyOptions& options) {
  const bool by_thesis = options.head.leds_in_head.size() == 3 && options.row.cameras == 2;
  std::vector<TrackingConfig> methods = {{.method = "joint"}};
  if (by_thesis) methods.push_back({.method = "thesis"});
  std::vector<std::vector<TrialFrame>> frames(methods.size() + std::size(kFixedNoises_m2_s5));
  const int trials = options.moves == HeadMoves::still ? kPlaces : 1;
  for (int i = 0; i < trials; ++i) {
    const auto run =
        run_trial(trial_of(options, options.seed + std::uint64_t{1000003} * i), methods);
    for (std::size_t m = 0; m < frames.size(); ++m)
      frames[m].insert(frames[m].end(), run[m].begin(), run[m].end());
  }
  MovingStudy study;
  study.joint = errors_of(frames[0]);
  if (by_thesis) study.thesis = thesis_errors(frames[1]);
  for (std::size_t i = 0; i < std::size(kFixedNoises_m2_s5); ++i) {
    const TrialErrors errors = errors_of(frames[methods.size() + i]);
    if (errors.found > 0 && (i == 0 || errors.eye_rms_m < study.best_fixed.eye_rms_m)) {
      study.best_fixed = errors;
      study.best_noise_m2_s5 = kFixedNoises_m2_s5[i];
    }
  }
  return study;
}

}  // namespace vindu
