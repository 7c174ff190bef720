// What tests that draw have in common: a context without a display for each suite, no OpenGL error
// left behind by any test, and a simple stage: a screen of 2 x 2 m whose pictures are easy to
// reckon.
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <vector>

#include "renderer/scene_renderer.h"
#include "renderer/surface.h"

namespace vindu::testing {

/// One context for all tests of a suite.
class GlTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { surface_ = make_headless_surface(); }
  static void TearDownTestSuite() { surface_.reset(); }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

 private:
  static inline std::unique_ptr<Surface> surface_;
};

/// A screen from -1 to 1 in x and y, at z = 0.
inline TileCorners stage() { return {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}; }

constexpr SizePx kStage_px{64, 64};

/// What an eye (0, 0, 2) sees of the scene through the stage. Things at z = 0 appear at their own
/// coordinates: x from -1 to 1 is column 0 to 63, y from 1 to -1 row 0 to 63.
inline Image draw_on_stage(const Scene& scene, Style style, const Vec3& eye_in_world = {0, 0, 2},
                           const Mat4& world_from_scene = Mat4::Identity()) {
  GpuScene gpu_scene = uploaded(pack(scene), Look{style});
  gpu_scene.pose(world_from_scene, 0);
  const SceneRenderer renderer(style);
  Canvas canvas(kStage_px, Look{style});
  Picture picture(kStage_px, style);
  const GpuScene* scenes[] = {&gpu_scene};
  canvas.begin();
  renderer.draw(*tile_view(stage(), eye_in_world), scenes);
  canvas.resolve(picture);
  return picture.read();
}

/// Same in red, green and blue to within `tolerance` levels.
MATCHER_P2(IsNearColour, expected, tolerance, "") {
  const Rgba8 wanted = expected;
  int difference = 0;
  for (int part = 0; part < 3; ++part)
    difference = std::max(difference, std::abs(int{arg[part]} - int{wanted[part]}));
  *result_listener << "which is (" << int{arg[0]} << ", " << int{arg[1]} << ", " << int{arg[2]}
                   << ")";
  return difference <= tolerance;
}

constexpr Rgba8 kBlack{0, 0, 0, 255};
constexpr Rgba8 kWhite{255, 255, 255, 255};
constexpr Rgba8 kRed{255, 0, 0, 255};
constexpr Rgba8 kGreen{0, 255, 0, 255};
constexpr Rgba8 kBlue{0, 0, 255, 255};

}  // namespace vindu::testing
