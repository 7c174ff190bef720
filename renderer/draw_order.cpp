#include <algorithm>

#include "renderer/gpu_scene.h"

namespace vindu {
namespace {

using Keyed = std::pair<double, const GpuScene::Draw*>;

std::vector<const GpuScene::Draw*> sorted(std::vector<Keyed>& keyed) {
  std::ranges::stable_sort(keyed, {}, &Keyed::first);
  std::vector<const GpuScene::Draw*> draws;
  draws.reserve(keyed.size());
  for (const auto& [key, draw] : keyed) draws.push_back(draw);
  return draws;
}

}  // namespace

/// From the coarsest level to finer ones, where it is not fine enough: what a scene has in more
/// detail than is shown costs nothing. Neither errors nor bounds grow on this way, so what is fine
/// has nothing below it that is not.
template <class Fine>
std::vector<const GpuScene::Draw*> GpuScene::chosen_where(Fine fine) const {
  enum : char { kUnknown, kFine, kCoarse };
  std::vector<char> known(coarsenings_.size(), kUnknown);
  std::vector<int> too_coarse;
  std::vector<const Draw*> chosen;
  const auto consider = [&](int index) {
    const Draw& draw = draws_[index];
    if (draw.made_by >= 0 && known[draw.made_by] == kUnknown) {
      known[draw.made_by] = fine(coarsenings_[draw.made_by]) ? kFine : kCoarse;
      if (known[draw.made_by] == kCoarse) too_coarse.push_back(draw.made_by);
    }
    if (draw.made_by < 0 || known[draw.made_by] == kFine) chosen.push_back(&draw);
  };
  for (const int index : coarsest_) consider(index);
  while (!too_coarse.empty()) {
    const PosedCoarsening& posed = coarsenings_[too_coarse.back()];
    too_coarse.pop_back();
    for (const int index : posed.finer) consider(index);
  }
  return chosen;
}

std::vector<const GpuScene::Draw*> GpuScene::coarsest() const {
  std::vector<const Draw*> draws;
  for (const int index : coarsest_) draws.push_back(&draws_[index]);
  return draws;
}

const Box3f& GpuScene::extent_in_world(const Draw& coarsest) const {
  return coarsest.made_by < 0 ? bounds_in_world(coarsest)
                              : coarsenings_[coarsest.made_by].bounds_in_world;
}

std::vector<const GpuScene::Draw*> GpuScene::draws_within(double error_m) const {
  return chosen_where([&](const PosedCoarsening& posed) { return posed.error_m <= error_m; });
}

const GpuScene::Order& GpuScene::order_for(const Vec3& eye_in_world, const DetailNeed& need) const {
  if (cached_order_ && cached_order_->moves == moves_ &&
      cached_order_->eye_in_world == eye_in_world && cached_order_->need == need)
    return *cached_order_;
  const Eigen::Vector3f eye = eye_in_world.cast<float>();
  std::vector<Keyed> solid, blended;
  const auto fine = [&](const PosedCoarsening& posed) {
    return fine_enough(need, eye_in_world, posed.bounds_in_world, posed.error_m);
  };
  for (const Draw* draw : chosen_where(fine)) {
    const Box3f& box = bounds_in_world(*draw);
    // Blended ones by their middle, so that what is behind shines through; solid ones by their
    // nearest point, so that little is drawn twice.
    if (draw->alpha_mode == AlphaMode::blend)
      blended.emplace_back(-(box.center() - eye).norm(), draw);
    else
      solid.emplace_back(box.exteriorDistance(eye), draw);
  }
  cached_order_ = Order{eye_in_world, need, moves_, sorted(solid), sorted(blended)};
  return *cached_order_;
}

}  // namespace vindu
