// The shader programs that draw surfaces: one for each kind, linked when it is first asked for.
// Bound to the render thread.
#pragma once

#include <map>
#include <string>

#include "renderer/canvas.h"
#include "renderer/gl/program.h"
#include "renderer/surface_kind.h"

namespace vindu {

class ScenePrograms {
 public:
  /// `fragment`: the shader behind scene.vert, "scene.frag".
  ScenePrograms(const char* fragment, const Look& look) : fragment_(fragment), look_(look) {}

  /// For measuring, all surfaces are unlit.
  const gl::Program& of(SurfaceKind kind) const;

 private:
  const char* fragment_;
  Look look_;
  mutable std::map<SurfaceKind, gl::Program> programs_;  // a cache
};

/// The lines "#define X" that a kind means in scene.vert and scene.frag.
std::string defines_of(SurfaceKind kind);

}  // namespace vindu
