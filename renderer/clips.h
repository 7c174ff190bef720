// A scene's animations as people name them: its clips, by name or by number from 1 on.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene.h"

namespace vindu {

/// FrameState::clip that plays none.
constexpr int kAtRest = -1;

/// In the order of Scene::animations.
std::vector<std::string> clip_names(const SceneOutline& scene);

/// "1 Walk, 2 Run"
std::string listed(const std::vector<std::string>& clips);

/// The index of the clip that `wish` names or numbers; kAtRest for "rest", unless a clip is called
/// that; the first one (or none, where there is none) for an empty wish. Throws Error that lists
/// the clips of `model`.
int find_clip(const std::vector<std::string>& clips, const std::string& wish,
              const std::string& model);

}  // namespace vindu
