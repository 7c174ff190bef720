#include "tracker/camera_placement.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace vindu {
namespace {

constexpr int kMostExchanges = 8;
constexpr double kFirstStep_m = 0.4;  // of the refinement
constexpr double kLastStep_m = 0.04;
constexpr double kHardlyBetter = 1e-6;  // of worth

/// A camera on a rail.
struct Mount {
  std::size_t rail = 0;
  double along = 0;  // 0 to 1
  Vec3 aim_in_room = Vec3::Zero();
};

using Sights = std::vector<Sight>;  // one a pose

class Search {
 public:
  Search(const PlacementTask& task, const DotNoise& noise, const Progress& progress)
      : task_(task), noise_(noise), progress_(progress) {
    for (std::size_t rail = 0; rail < task.rails.size(); ++rail) add_candidates(rail);
  }

  std::vector<CameraConfig> place(int count) {
    const double rounds = 2.0 * count + 1;
    for (int i = 0; i < count; ++i) {
      chosen_.push_back({});
      seen_.emplace_back(task_.poses.size());
      exchange(chosen_.size() - 1, 0);
      tell((i + 1) / rounds);
    }
    for (int round = 0; round < kMostExchanges && exchange_all(); ++round)
      tell((count + 1.0 + count * round / kMostExchanges) / rounds);
    refine();
    std::vector<CameraConfig> cameras;
    for (const Mount& mount : chosen_) cameras.push_back(camera_of(mount));
    name_from_left_to_right(cameras);
    return cameras;
  }

 private:
  void tell(double share) const {
    if (progress_) progress_(share);
  }

  static void name_from_left_to_right(std::vector<CameraConfig>& cameras) {
    std::ranges::stable_sort(cameras, {}, [](const CameraConfig& camera) {
      return camera.room_from_camera.translation.x();
    });
    for (std::size_t i = 0; i < cameras.size(); ++i)
      cameras[i].name = "plan-" + std::to_string(i + 1);
  }

  CameraConfig camera_of(const Mount& mount) const {
    const Rail& rail = task_.rails[mount.rail];
    const Vec3 place = rail.from_in_room + mount.along * (rail.to_in_room - rail.from_in_room);
    CameraConfig camera = task_.camera;
    camera.room_from_camera = look_at(place, mount.aim_in_room);
    return camera;
  }

  Sights sights_of(const Mount& mount) const {
    const Onlooker onlooker(camera_of(mount));
    Sights sights;
    sights.reserve(task_.poses.size());
    for (const Rigid3& pose : task_.poses)
      sights.push_back(onlooker.look(task_.head, pose, noise_));
    return sights;
  }

  void add_candidates(std::size_t rail) {
    const double length_m = (task_.rails[rail].to_in_room - task_.rails[rail].from_in_room).norm();
    const int steps = static_cast<int>(std::ceil(length_m / task_.spacing_m));
    for (int step = 0; step <= steps; ++step)
      for (const Vec3& aim : task_.aims_in_room) {
        candidates_.push_back({rail, steps ? static_cast<double>(step) / steps : 0, aim});
        candidate_sights_.push_back(sights_of(candidates_.back()));
      }
  }

  double worth_with(const Sights& others, const Sights& own) const {
    double sum = 0;
    for (std::size_t i = 0; i < others.size(); ++i) {
      Sight sight = others[i];
      sight += own[i];
      sum += worth(bound_of(sight), task_.good_eye_m);
    }
    return sum / static_cast<double>(others.size());
  }

  Sights all_but(std::size_t camera) const {
    Sights sum(task_.poses.size());
    for (std::size_t other = 0; other < seen_.size(); ++other)
      for (std::size_t i = 0; other != camera && i < sum.size(); ++i) sum[i] += seen_[other][i];
    return sum;
  }

  /// Puts one camera where it is worth most beside the others. False where it stays.
  bool exchange(std::size_t camera, double worth_now) {
    const Sights others = all_but(camera);
    double best = worth_now + kHardlyBetter;
    std::optional<std::size_t> better;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const double value = worth_with(others, candidate_sights_[i]);
      if (value > best) best = value, better = i;
    }
    if (!better) return false;
    chosen_[camera] = candidates_[*better];
    seen_[camera] = candidate_sights_[*better];
    return true;
  }

  bool exchange_all() {
    bool moved = false;
    for (std::size_t camera = 0; camera < chosen_.size(); ++camera)
      moved |= exchange(camera, worth_with(all_but(camera), seen_[camera]));
    return moved;
  }

  /// The four ways a mount can change by a step, both directions.
  std::vector<Mount> neighbours(const Mount& mount, double step_m) const {
    const Rail& rail = task_.rails[mount.rail];
    const double length_m = (rail.to_in_room - rail.from_in_room).norm();
    std::vector<Mount> all;
    for (const double by_m : {-step_m, step_m}) {
      Mount along = mount, across = mount, deep = mount;
      if (length_m > 0) along.along = std::clamp(mount.along + by_m / length_m, 0.0, 1.0);
      across.aim_in_room.x() += by_m;
      deep.aim_in_room.z() += by_m;
      all.insert(all.end(), {along, across, deep});
    }
    return all;
  }

  bool refine(std::size_t camera, double step_m) {
    const Sights others = all_but(camera);
    double best = worth_with(others, seen_[camera]) + kHardlyBetter;
    bool moved = false;
    for (const Mount& mount : neighbours(chosen_[camera], step_m)) {
      Sights sights = sights_of(mount);
      const double value = worth_with(others, sights);
      if (value <= best) continue;
      best = value;
      chosen_[camera] = mount;
      seen_[camera] = std::move(sights);
      moved = true;
    }
    return moved;
  }

  void refine() {
    constexpr int kMostRounds = 12;
    for (double step_m = kFirstStep_m; step_m >= kLastStep_m; step_m /= 2) {
      bool moved = true;
      for (int round = 0; moved && round < kMostRounds; ++round) {
        moved = false;
        for (std::size_t camera = 0; camera < chosen_.size(); ++camera)
          moved |= refine(camera, step_m);
      }
    }
    tell(1);
  }

  const PlacementTask& task_;
  const DotNoise& noise_;
  const Progress& progress_;
  std::vector<Mount> candidates_;
  std::vector<Sights> candidate_sights_;
  std::vector<Mount> chosen_;
  std::vector<Sights> seen_;  // by each chosen camera
};

}  // namespace

void PlacementTask::validate() const {
  if (poses.empty())
    throw Error({"there is nothing to cover", "camera placement", "give a larger walking area"});
  if (rails.empty() || aims_in_room.empty())
    throw Error({"there is nowhere to mount cameras, or nothing to aim at", "camera placement",
                 "give a larger room"});
}

bool covered(const PoseBound& bound, double good_eye_m) {
  return bound.level == TrackingLevel::six_dof && bound.eye_m <= good_eye_m;
}

double worth(const PoseBound& bound, double good_eye_m) {
  constexpr double kBearing = 0.05, kPosition = 0.2, kHybrid = 0.3, kSixDof = 0.6;
  if (bound.level == TrackingLevel::lost) return 0;
  if (bound.level == TrackingLevel::bearing) return kBearing;
  if (covered(bound, good_eye_m)) return 1 + 0.1 * (1 - bound.eye_m / good_eye_m);
  const double share = bound.level == TrackingLevel::six_dof  ? kSixDof
                       : bound.level == TrackingLevel::hybrid ? kHybrid
                                                              : kPosition;
  return std::max(kBearing, share * std::min(1.0, good_eye_m / bound.eye_m));
}

std::vector<CameraConfig> place_cameras(const PlacementTask& task, int count, const DotNoise& noise,
                                        const Progress& progress) {
  task.validate();
  return Search(task, noise, progress).place(count);
}

}  // namespace vindu
