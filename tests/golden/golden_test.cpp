// Pictures that were looked at and accepted (tests/golden/*.png), drawn again: the show, models of
// several formats, and what is done with a wall's picture afterwards.
#include <gmock/gmock.h>

#include "core/site.h"
#include "renderer/chunks.h"
#include "renderer/eye_picture.h"
#include "renderer/import.h"
#include "renderer/placement.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"
#include "tests/golden/compare.h"

namespace vindu {
namespace {

using testing::complaint_about;

class Golden : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { surface_ = make_headless_surface(); }
  static void TearDownTestSuite() { surface_.reset(); }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

 private:
  static inline std::unique_ptr<Surface> surface_;
};

/// The Tromsø wall as one screen; its picture is quickly drawn and easily looked at.
Wall small_screen() { return single_screen(5.185, 2.238, 320, 138); }

FrameState seen_from(const Vec3& eye_in_wall, const Navigation& navigation = {}) {
  FrameState state;
  state.eye_in_wall = eye_in_wall;
  state.navigation = navigation;
  state.animation_time_s = 4;
  return state;
}

/// As the program shows it.
Scene show() {
  Scene scene = import_scene(find_asset("show/show.glb")).scene;
  cut_into_chunks(scene);
  return scene;
}

Image show_from(const Vec3& eye_in_wall, Style style = Style::lit) {
  WallRenderer wall(small_screen(), 1, Look{style});
  wall.show(pack(show()));
  wall.draw(seen_from(eye_in_wall));
  return wall.picture().read();
}

TEST_F(Golden, ShowFromTheMiddle) {
  EXPECT_EQ(complaint_about(show_from({0, 0.1, 2}), "show-middle"), "");
}

TEST_F(Golden, ShowFromTheLeft) {
  EXPECT_EQ(complaint_about(show_from({-1.8, 0.2, 1.2}), "show-left"), "");
}

TEST_F(Golden, ShowFromCloseToTheWall) {
  EXPECT_EQ(complaint_about(show_from({0.8, -0.3, 0.5}), "show-close"), "");
}

// One sample a pixel: an edge may move by a whole pixel.
TEST_F(Golden, ShowUnlit) {
  const Image image = show_from({0, 0.1, 2}, Style::unlit);
  EXPECT_EQ(complaint_about(image, "show-unlit", {.largest_levels = 255, .mean_levels = 0.1}), "");
}

TEST_F(Golden, WouldNoticeAnEyeThatIsTwoMillimetresAside) {
  const auto difference =
      testing::difference_of(show_from({0.002, 0.1, 2}), show_from({0, 0.1, 2}));
  ASSERT_TRUE(difference);
  EXPECT_GT(difference->mean_levels, 2 * testing::Tolerance{}.mean_levels);
}

/// A model of Debian's assimp-testmodels, fitted to a screen and seen from the right, above.
Image model(const std::string& name) {
  Scene scene = import_scene("/usr/share/assimp/models/" + name).scene;
  cut_into_chunks(scene);
  const Wall screen = single_screen(0.8, 0.6, 240, 180);
  WallRenderer wall(screen, 1, Look{Style::lit});
  wall.show(pack(scene));
  wall.draw(
      seen_from({0.35, 0.3, 0.9}, place_scene(pack(scene), Placement::fit, screen).navigation));
  return wall.picture().read();
}

TEST_F(Golden, TexturedColladaModel) {
  EXPECT_EQ(complaint_about(model("Collada/duck.dae"), "model-collada"), "");
}

TEST_F(Golden, TexturedObjModel) {
  EXPECT_EQ(complaint_about(model("OBJ/spider.obj"), "model-obj"), "");
}

TEST_F(Golden, MetallicRoughnessGltfModel) {
  EXPECT_EQ(
      complaint_about(model("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"), "model-gltf"),
      "");
}

TEST_F(Golden, PlyScan) { EXPECT_EQ(complaint_about(model("PLY/Wuson.ply"), "model-ply"), ""); }

/// A beast of 37 bones that runs and that walks, twice each.
TEST_F(Golden, SkinnedCharacterAtFourTimes) {
  Scene scene = import_scene("/usr/share/assimp/models/X/Testwuson.X").scene;
  cut_into_chunks(scene);
  const Wall screen = single_screen(1.6, 0.9, 320, 180);
  WallRenderer wall(screen, 1, Look{Style::lit});
  wall.show(pack(scene));
  Image all = Image::filled(4 * 320, 180, {});
  int x = 0;
  for (const auto& [clip, time_s] : {std::pair(0, 0.1), {0, 0.5}, {1, 0.4}, {1, 2.2}}) {
    FrameState state =
        seen_from({0.9, 0.4, 1.2}, place_scene(pack(scene), Placement::fit, screen).navigation);
    state.clip = clip;
    state.animation_time_s = time_s;
    wall.draw(state);
    paste(wall.picture().read(), x, 0, all);
    x += 320;
  }
  EXPECT_EQ(complaint_about(all, "model-skinned"), "");
}

/// For a projector behind the screen that hangs upright: mirrored, then turned.
TEST_F(Golden, ShowForAMirroredAndTurnedProjector) {
  WallRenderer wall(small_screen(), 1, Look{Style::lit});
  wall.show(pack(show()));
  wall.draw(seen_from({0, 0.1, 2}));
  wall.picture().make_mipmaps();
  const SizePx size{wall.layout().size.height, wall.layout().size.width};
  Picture display(size, Style::lit);
  glBindFramebuffer(GL_FRAMEBUFFER, display.framebuffer());
  glViewport(0, 0, size.width, size.height);
  wall.renderer().present(wall.picture(), {.mirror = true, .rotate_deg = 90});
  EXPECT_EQ(complaint_about(display.read(), "show-mirrored-turned"), "");
}

TEST_F(Golden, CurvedWallWithBezelsAsTheEyeSeesIt) {
  WallGrid grid{.columns = 7,
                .rows = 4,
                .width_m = 5.185,
                .height_m = 2.238,
                .tile_width_px = 64,
                .tile_height_px = 48,
                .bezel_x_mm = 25,
                .bezel_y_mm = 25,
                .curve_deg = 60,
                .mount = {}};
  WallRenderer wall(expand_wall(grid, {}, {}), 1, Look{Style::lit});
  wall.show(pack(show()));
  const Vec3 eye(-0.6, 0.2, 2.2);
  wall.draw(seen_from(eye));
  EXPECT_EQ(complaint_about(picture_from_eye(wall, eye, {320, 180}), "eye-curved-bezels"), "");
}

}  // namespace
}  // namespace vindu
