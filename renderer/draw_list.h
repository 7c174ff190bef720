// Which of a scene's meshes a view draws, in which order, and joined into as few calls as possible.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "renderer/gpu_scene.h"
#include "renderer/view.h"

namespace vindu {

struct DrawCount {
  int draws = 0;
  int culled = 0;
  std::uint64_t triangles = 0;         ///< of all draws
  std::uint64_t culled_triangles = 0;  ///< of the culled ones

  DrawCount& operator+=(const DrawCount& other);
};

/// Draws of one node and material, all skinned or none, in one call.
struct Batch {
  const GpuScene::Draw* first = nullptr;
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;

  /// The program and everything that `first` needs must be bound.
  void draw() const {
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        static_cast<GLsizei>(counts.size()));
  }
};

/// What is solid (opaque or masked), nearest first; or what is blended, farthest first.
std::vector<Batch> batches_in_view(const View& view, const GpuScene& scene, bool blended,
                                   DrawCount& count);

/// Solid surfaces that are lit throw shadows. An unlit one has its light baked in, or is a sky.
bool casts_shadow(const GpuScene::Draw& draw);
inline bool is_lit(const GpuScene::Draw& draw) { return !(draw.kind & kUnlit); }

/// Something of the scene that the view sees is lit.
bool sees_lit(const View& view, const GpuScene& scene);

/// Joins draws to batches of their like, in the order of each batch's first.
class BatchList {
 public:
  /// `keep_order`: a draw joins only the last batch.
  explicit BatchList(const GpuScene& scene, bool keep_order = false)
      : keep_order_(keep_order), batch_of_(scene.group_count(), kNone) {}

  void add(const GpuScene::Draw& draw);
  std::vector<Batch> take() { return std::move(batches_); }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  bool keep_order_;
  std::vector<std::size_t> batch_of_;  // of each group of draws
  std::vector<Batch> batches_;
};

}  // namespace vindu
