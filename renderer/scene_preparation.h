// A scene on its way to the GPU in short steps, while frames of another go on. Bound to the render
// thread.
#pragma once

#include <utility>

#include "renderer/gl/handle.h"
#include "renderer/gpu_scene.h"
#include "renderer/upload.h"

namespace vindu {

class ScenePreparation {
 public:
  /// Takes the memory. Throws Error when the GPU's does not suffice.
  ScenePreparation(PackedScene packed, const Look& look);

  /// Whether the last step has reached the GPU, so that frames do not wait behind many.
  bool free() const { return last_step_.passed(); }
  /// Some megabytes; true when all of the scene is there. Throws Error when the GPU's memory does
  /// not suffice.
  bool step();
  /// When step() was true.
  GpuScene take() { return std::move(scene_); }

 private:
  PackedScene packed_;
  Upload upload_;
  GpuScene scene_;
  gl::Fence last_step_;
};

}  // namespace vindu
