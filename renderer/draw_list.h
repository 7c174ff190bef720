// Which of a scene's meshes a view draws, in which order, and joined into as few calls as possible.
#pragma once

#include <cstdint>
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

/// Joins the draw to its like: to any for solid ones, only to the last where order matters.
void add_to_batches(const GpuScene::Draw& draw, bool keep_order, std::vector<Batch>& batches);

}  // namespace vindu
