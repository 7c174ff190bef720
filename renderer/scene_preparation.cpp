#include "renderer/scene_preparation.h"

namespace vindu {
namespace {

/// One or two milliseconds, over PCI Express 3 as within a CPU's memory.
constexpr std::size_t kStepBytes = 4 << 20;

}  // namespace

ScenePreparation::ScenePreparation(PackedScene packed, const Look& look)
    : packed_(std::move(packed)), scene_(packed_, look, upload_) {}

bool ScenePreparation::step() {
  upload_.advance(kStepBytes);
  last_step_ = gl::Fence::here();
  if (!upload_.done()) return false;
  check_gpu_memory(packed_.scene.name);
  return true;
}

}  // namespace vindu
