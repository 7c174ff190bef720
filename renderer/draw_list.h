// A scene's draws, joined into as few calls as possible.
#pragma once

#include <span>
#include <vector>

#include "renderer/gpu_scene.h"

namespace vindu {

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

/// In their order. `keep_order`: a draw joins only the last batch.
std::vector<Batch> batches_of(const GpuScene& scene, std::span<const GpuScene::Draw* const> draws,
                              bool keep_order = false);

/// Solid surfaces that are lit throw shadows. An unlit one has its light baked in, or is a sky.
bool casts_shadow(const GpuScene::Draw& draw);
inline bool is_lit(const GpuScene::Draw& draw) { return !(draw.kind & kUnlit); }

/// Something of the scene that the view sees is lit.
bool sees_lit(const View& view, const GpuScene& scene);

}  // namespace vindu
