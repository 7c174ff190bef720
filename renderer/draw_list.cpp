#include "renderer/draw_list.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace vindu {
std::vector<Batch> batches_of(const GpuScene& scene, std::span<const GpuScene::Draw* const> draws,
                              bool keep_order) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> batch_of(scene.group_count(), kNone);  // of each group
  std::vector<Batch> batches;
  for (const GpuScene::Draw* draw : draws) {
    std::size_t& batch = batch_of[draw->group];
    if (batch == kNone || (keep_order && batch + 1 != batches.size())) {
      batch = batches.size();
      batches.push_back({.first = draw, .counts = {}, .offsets = {}});
    }
    const auto offset = static_cast<std::uintptr_t>(draw->mesh.first_index) * sizeof(std::uint32_t);
    batches[batch].counts.push_back(static_cast<GLsizei>(draw->mesh.index_count));
    batches[batch].offsets.push_back(reinterpret_cast<const void*>(offset));
  }
  return batches;
}

bool casts_shadow(const GpuScene::Draw& draw) {
  return is_lit(draw) && draw.alpha_mode != AlphaMode::blend;
}

bool sees_lit(const View& view, const GpuScene& scene) {
  return std::ranges::any_of(scene.coarsest_seen_by(view),
                             [](const GpuScene::Draw* draw) { return is_lit(*draw); });
}

}  // namespace vindu
