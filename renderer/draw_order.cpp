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

template <class Fine>
std::vector<const GpuScene::Draw*> GpuScene::chosen_where(Fine fine) const {
  std::vector<char> is_fine;
  is_fine.reserve(coarsenings_.size());
  for (const PosedCoarsening& posed : coarsenings_) is_fine.push_back(fine(posed));
  std::vector<const Draw*> chosen;
  for (const Draw& draw : draws_)
    if ((draw.made_by < 0 || is_fine[draw.made_by]) &&
        (draw.replaced_by < 0 || !is_fine[draw.replaced_by]))
      chosen.push_back(&draw);
  return chosen;
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
