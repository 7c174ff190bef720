#include "tracker/camera_placement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/random.h"

namespace vindu {
namespace {

constexpr int kMostStarts = 10, kFewestStarts = 3;
constexpr int kStartsTimesCameras = 60;  // more cameras take longer each
constexpr std::size_t kRefined = 3;      // the best of them
constexpr int kMostExchanges = 8;
constexpr std::size_t kCoarsePoses = 180;  // that the exchange looks at, about
constexpr double kFirstStep_m = 0.4;       // of the refinement
constexpr double kLastStep_m = 0.04;
constexpr int kMostRounds = 12;
constexpr double kNearestAim_m = 0.2;
constexpr double kHardlyBetter = 1e-6;  // of worth

/// A camera on a rail.
struct Mount {
  std::size_t rail = 0;
  double along = 0;  // 0 to 1
  Vec3 aim_in_room = Vec3::Zero();
};

using Poses = std::vector<Rigid3>;
using Sights = std::vector<Sight>;  // one a pose

/// Cameras and what each sees.
struct Team {
  std::vector<Mount> mounts;
  std::vector<Sights> sights;
  double worth = 0;
};

/// Poses come with so many headings and heights a place; a stride that shares no factor with their
/// number takes some of each.
std::size_t stride_over(std::size_t poses) {
  std::size_t stride = std::max<std::size_t>(1, poses / kCoarsePoses);
  while (std::gcd(stride, std::size_t{30}) != 1) ++stride;
  return stride;
}

/// What all cameras but one see, and what each pose is worth by that alone.
struct Others {
  Sights sights;
  std::vector<double> worths;
};

Sights all_but(const Team& team, std::size_t camera) {
  Sights sum(team.sights.front().size());
  for (std::size_t other = 0; other < team.sights.size(); ++other)
    for (std::size_t i = 0; other != camera && i < sum.size(); ++i) sum[i] += team.sights[other][i];
  return sum;
}

class Search {
 public:
  Search(const PlacementTask& task, const DotNoise& noise, const SearchProgress& progress)
      : task_(task), noise_(noise), progress_(progress) {
    const std::size_t stride = stride_over(task.poses.size());
    for (std::size_t i = 0; i < task.poses.size(); i += stride) coarse_.push_back(task.poses[i]);
    for (std::size_t rail = 0; rail < task.rails.size(); ++rail) add_candidates(rail);
    if (candidates_.empty())
      throw Error({"every place to mount at is a point to aim at", "camera placement",
                   "mount the cameras higher"});
  }

  std::vector<CameraConfig> place(int count) {
    const int starts = std::clamp(kStartsTimesCameras / count, kFewestStarts, kMostStarts);
    std::vector<Team> teams;
    for (int start = 0; start < starts; ++start) {
      teams.push_back(start == 0 ? greedy(count) : any(count, static_cast<std::uint64_t>(start)));
      exchange_all(teams.back());
      tell(0.7 * (start + 1) / starts);
    }
    std::ranges::stable_sort(teams, std::greater(), &Team::worth);
    teams.resize(kRefined);
    for (std::size_t i = 0; i < teams.size(); ++i) {
      refine(teams[i]);
      tell(0.7 + 0.3 * static_cast<double>(i + 1) / kRefined);
    }
    return cameras_of(*std::ranges::max_element(teams, {}, &Team::worth));
  }

 private:
  void tell(double share) const {
    if (progress_) progress_(std::min(1.0, share));
  }

  /// Named from left to right.
  std::vector<CameraConfig> cameras_of(const Team& team) const {
    std::vector<CameraConfig> cameras;
    for (const Mount& mount : team.mounts) cameras.push_back(camera_of(mount));
    std::ranges::stable_sort(cameras, {}, [](const CameraConfig& camera) {
      return camera.room_from_camera.translation.x();
    });
    for (std::size_t i = 0; i < cameras.size(); ++i)
      cameras[i].name = "plan-" + std::to_string(i + 1);
    return cameras;
  }

  Vec3 place_of(const Mount& mount) const {
    const Rail& rail = task_.rails[mount.rail];
    return rail.from_in_room + mount.along * (rail.to_in_room - rail.from_in_room);
  }

  /// Whether there is a direction to look in.
  bool can_look(const Mount& mount) const {
    return (mount.aim_in_room - place_of(mount)).norm() > kNearestAim_m;
  }

  CameraConfig camera_of(const Mount& mount) const {
    CameraConfig camera = task_.camera;
    camera.room_from_camera = look_at(place_of(mount), mount.aim_in_room);
    return camera;
  }

  Sights sights_of(const Mount& mount, const Poses& poses) const {
    const Onlooker onlooker(camera_of(mount));
    Sights sights;
    sights.reserve(poses.size());
    for (const Rigid3& pose : poses) sights.push_back(onlooker.look(task_.head, pose, noise_));
    return sights;
  }

  void add_candidates(std::size_t rail) {
    const double length_m = (task_.rails[rail].to_in_room - task_.rails[rail].from_in_room).norm();
    const int steps = static_cast<int>(std::ceil(length_m / task_.spacing_m));
    for (int step = 0; step <= steps; ++step)
      for (const Vec3& aim : task_.aims_in_room) {
        const Mount mount{rail, steps ? static_cast<double>(step) / steps : 0, aim};
        if (!can_look(mount)) continue;
        candidates_.push_back(mount);
        candidate_sights_.push_back(sights_of(candidates_.back(), coarse_));
      }
  }

  void add(Team& team, std::size_t candidate) const {
    team.mounts.push_back(candidates_[candidate]);
    team.sights.push_back(candidate_sights_[candidate]);
  }

  /// Each camera where it is worth most beside those before it.
  Team greedy(int count) const {
    Team team;
    for (int i = 0; i < count; ++i) {
      add(team, 0);
      team.worth = 0;
      exchange(team, team.mounts.size() - 1);
    }
    return team;
  }

  Team any(int count, std::uint64_t seed) const {
    Random random(seed);
    Team team;
    for (int i = 0; i < count; ++i)
      add(team,
          static_cast<std::size_t>(random.uniform(0, static_cast<double>(candidates_.size()))));
    team.worth = worth_with(others_of(team, 0), team.sights[0]);
    return team;
  }

  Others others_of(const Team& team, std::size_t camera) const {
    Others others{.sights = all_but(team, camera), .worths = {}};
    for (const Sight& sight : others.sights)
      others.worths.push_back(worth(bound_of(sight), task_.good_eye_m));
    return others;
  }

  /// A camera sees but a part of the room: where it sees no dot it changes nothing.
  double worth_with(const Others& others, const Sights& own) const {
    double sum = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i].dots == 0) {
        sum += others.worths[i];
        continue;
      }
      Sight sight = others.sights[i];
      sight += own[i];
      sum += worth(bound_of(sight), task_.good_eye_m);
    }
    return sum / static_cast<double>(own.size());
  }

  /// Puts one camera where it is worth most beside the others. False where it stays.
  bool exchange(Team& team, std::size_t camera) const {
    const Others others = others_of(team, camera);
    std::optional<std::size_t> better;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const double value = worth_with(others, candidate_sights_[i]);
      if (value > team.worth + kHardlyBetter) team.worth = value, better = i;
    }
    if (!better) return false;
    team.mounts[camera] = candidates_[*better];
    team.sights[camera] = candidate_sights_[*better];
    return true;
  }

  void exchange_all(Team& team) const {
    bool moved = true;
    for (int round = 0; moved && round < kMostExchanges; ++round) {
      moved = false;
      for (std::size_t camera = 0; camera < team.mounts.size(); ++camera)
        moved |= exchange(team, camera);
    }
  }

  /// The ways a mount can change by a step: along its rail, and its aim across and deep.
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

  bool refine(Team& team, std::size_t camera, double step_m) const {
    const Others others = others_of(team, camera);
    bool moved = false;
    for (const Mount& mount : neighbours(team.mounts[camera], step_m)) {
      if (!can_look(mount)) continue;
      Sights sights = sights_of(mount, task_.poses);
      const double value = worth_with(others, sights);
      if (value <= team.worth + kHardlyBetter) continue;
      team.worth = value;
      team.mounts[camera] = mount;
      team.sights[camera] = std::move(sights);
      moved = true;
    }
    return moved;
  }

  /// From here on all poses count.
  void refine(Team& team) const {
    for (std::size_t i = 0; i < team.mounts.size(); ++i)
      team.sights[i] = sights_of(team.mounts[i], task_.poses);
    team.worth = worth_with(others_of(team, 0), team.sights[0]);
    for (double step_m = kFirstStep_m; step_m >= kLastStep_m; step_m /= 2) {
      bool moved = true;
      for (int round = 0; moved && round < kMostRounds; ++round) {
        moved = false;
        for (std::size_t camera = 0; camera < team.mounts.size(); ++camera)
          moved |= refine(team, camera, step_m);
      }
    }
  }

  const PlacementTask& task_;
  const DotNoise& noise_;
  const SearchProgress& progress_;
  Poses coarse_;
  std::vector<Mount> candidates_;
  std::vector<Sights> candidate_sights_;  // of the coarse poses
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
                                        const SearchProgress& progress) {
  task.validate();
  assert(count > 0);
  return Search(task, noise, progress).place(count);
}

}  // namespace vindu
