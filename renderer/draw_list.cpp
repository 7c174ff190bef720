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

bool alike(const GpuScene::Draw& a, const GpuScene::Draw& b) {
  return a.node == b.node && a.mesh.material == b.mesh.material && a.mesh.skinned == b.mesh.skinned;
}

}  // namespace

DrawCount& DrawCount::operator+=(const DrawCount& other) {
  draws += other.draws;
  culled += other.culled;
  triangles += other.triangles;
  culled_triangles += other.culled_triangles;
  return *this;
}

void add_to_batches(const GpuScene::Draw& draw, bool keep_order, std::vector<Batch>& batches) {
  const auto begin = keep_order && !batches.empty() ? batches.end() - 1 : batches.begin();
  auto batch = std::find_if(begin, batches.end(),
                            [&](const Batch& other) { return alike(*other.first, draw); });
  if (batch == batches.end())
    batch = batches.insert(batch, {.first = &draw, .counts = {}, .offsets = {}});
  const auto offset = static_cast<std::uintptr_t>(draw.mesh.first_index) * sizeof(std::uint32_t);
  batch->counts.push_back(static_cast<GLsizei>(draw.mesh.index_count));
  batch->offsets.push_back(reinterpret_cast<const void*>(offset));
}

std::vector<Batch> batches_in_view(const View& view, const GpuScene& scene, bool blended,
                                   DrawCount& count) {
  std::vector<Batch> batches;
  const GpuScene::Order& order = scene.order_for(view.eye_in_world, view.detail);
  for (const GpuScene::Draw* draw : blended ? order.blended : order.solid) {
    const bool culled = outside(view.clip_from_world, scene.bounds_in_world(*draw));
    const std::uint64_t triangles = draw->mesh.index_count / 3;
    count += {1, culled, triangles, culled ? triangles : 0};
    if (!culled) add_to_batches(*draw, blended, batches);
  }
  return batches;
}

bool casts_shadow(const GpuScene::Draw& draw) {
  return is_lit(draw) && draw.alpha_mode != AlphaMode::blend;
}

bool sees_lit(const View& view, const GpuScene& scene) {
  return std::ranges::any_of(scene.draws(), [&](const GpuScene::Draw& draw) {
    return is_lit(draw) && !outside(view.clip_from_world, scene.bounds_in_world(draw));
  });
}

}  // namespace vindu
