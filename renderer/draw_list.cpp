#include "renderer/draw_list.h"

#include <algorithm>
#include <cstdint>

namespace vindu {
namespace {

/// Nothing of the box is inside the view: it lies wholly outside one of its planes. In clip space
/// -w <= x, y <= w and z <= w are half-spaces of the world, also for points behind the eye, so the
/// test holds for any off-axis frustum. The box's farthest point along a plane's normal decides.
bool outside(const Mat4& clip_from_world, const Box3f& box) {
  const Vec3 middle = box.center().cast<double>(), half = 0.5 * box.sizes().cast<double>();
  const auto beyond = [&](const Eigen::RowVector4d& plane) {
    return plane.head<3>().dot(middle) + plane[3] + plane.head<3>().cwiseAbs().dot(half) < 0;
  };
  const Eigen::RowVector4d w = clip_from_world.row(3);
  for (const int axis : {0, 1})
    if (beyond(w + clip_from_world.row(axis)) || beyond(w - clip_from_world.row(axis))) return true;
  return beyond(w - clip_from_world.row(2));
}

}  // namespace

DrawCount& DrawCount::operator+=(const DrawCount& other) {
  draws += other.draws;
  culled += other.culled;
  triangles += other.triangles;
  culled_triangles += other.culled_triangles;
  return *this;
}

void BatchList::add(const GpuScene::Draw& draw) {
  std::size_t& batch = batch_of_[draw.group];
  if (batch == kNone || (keep_order_ && batch + 1 != batches_.size())) {
    batch = batches_.size();
    batches_.push_back({.first = &draw, .counts = {}, .offsets = {}});
  }
  const auto offset = static_cast<std::uintptr_t>(draw.mesh.first_index) * sizeof(std::uint32_t);
  batches_[batch].counts.push_back(static_cast<GLsizei>(draw.mesh.index_count));
  batches_[batch].offsets.push_back(reinterpret_cast<const void*>(offset));
}

std::vector<Batch> batches_in_view(const View& view, const GpuScene& scene, bool blended,
                                   DrawCount& count) {
  BatchList batches(scene, blended);
  const GpuScene::Order& order = scene.order_for(view.eye_in_world, view.detail);
  for (const GpuScene::Draw* draw : blended ? order.blended : order.solid) {
    const bool culled = outside(view.clip_from_world, scene.bounds_in_world(*draw));
    const std::uint64_t triangles = draw->mesh.index_count / 3;
    count += {1, culled, triangles, culled ? triangles : 0};
    if (!culled) batches.add(*draw);
  }
  return batches.take();
}

bool casts_shadow(const GpuScene::Draw& draw) {
  return is_lit(draw) && draw.alpha_mode != AlphaMode::blend;
}

bool sees_lit(const View& view, const GpuScene& scene) {
  return std::ranges::any_of(scene.coarsest(), [&](const GpuScene::Draw* draw) {
    return is_lit(*draw) && !outside(view.clip_from_world, scene.extent_in_world(*draw));
  });
}

}  // namespace vindu
