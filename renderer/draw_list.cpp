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

/// The draws of one kind, by distance from the eye: blended ones farthest first, by their middle,
/// so that what is behind shines through; solid ones nearest first, by their nearest point, so that
/// little is drawn twice. The eye decides, not the tile: neighbours agree.
std::vector<const GpuScene::Draw*> sorted_draws(const GpuScene& scene, const Vec3& eye_in_world,
                                                bool blended) {
  std::vector<std::pair<double, const GpuScene::Draw*>> found;
  for (const GpuScene::Draw& draw : scene.draws()) {
    if ((draw.alpha_mode == AlphaMode::blend) != blended) continue;
    const Box3f& box = scene.bounds_in_world(draw);
    const Eigen::Vector3f eye = eye_in_world.cast<float>();
    found.emplace_back(blended ? -(box.center() - eye).norm() : box.exteriorDistance(eye), &draw);
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, const GpuScene::Draw*>::first);
  std::vector<const GpuScene::Draw*> sorted;
  for (const auto& [distance, draw] : found) sorted.push_back(draw);
  return sorted;
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
  for (const GpuScene::Draw* draw : sorted_draws(scene, view.eye_in_world, blended)) {
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
