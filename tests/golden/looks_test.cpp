// What materials and light look like: fifteen scenes that are made here, each from three eyes,
// beside the pictures that were looked at and accepted (tests/golden/look-*.png: the three side by
// side).
#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/site.h"
#include "renderer/import.h"
#include "renderer/placement.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"
#include "tests/golden/compare.h"
#include "tests/golden/shapes.h"

namespace vindu {
namespace {

using namespace testing;
using testing::complaint_about;

constexpr SizePx kPicture_px{320, 180};
const std::vector<Vec3> kEyes = {{0, 0.1, 1.5}, {-0.8, 0.3, 1.1}, {0.6, -0.15, 0.8}};

class Looks : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { surface_ = make_headless_surface(); }
  static void TearDownTestSuite() { surface_.reset(); }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

 private:
  static inline std::unique_ptr<Surface> surface_;
};

/// 1.6 x 0.9 m.
Wall screen() { return single_screen(1.6, 0.9, kPicture_px.width, kPicture_px.height); }

/// The same pixels on 4 x 2 tiles.
Wall eight_tiles() {
  return expand_wall({.columns = 4,
                      .rows = 2,
                      .width_m = 1.6,
                      .height_m = 0.9,
                      .tile_width_px = kPicture_px.width / 4,
                      .tile_height_px = kPicture_px.height / 2,
                      .mount = {}},
                     {}, {});
}

/// From all eyes, side by side.
Image pictures_of(const Scene& scene, const Wall& wall, const Navigation& navigation = {}) {
  WallRenderer renderer(wall, 1, Look{});
  renderer.show(pack(scene));
  Image all =
      Image::filled(kPicture_px.width * static_cast<int>(kEyes.size()), kPicture_px.height, {});
  for (std::size_t i = 0; i < kEyes.size(); ++i) {
    renderer.draw({.eye_in_wall = kEyes[i], .navigation = navigation});
    paste(renderer.picture().read(), static_cast<int>(i) * kPicture_px.width, 0, all);
  }
  return all;
}

std::string complaint_about(const Scene& scene, const std::string& name) {
  return testing::complaint_about(pictures_of(scene, screen()), "look-" + name);
}

/// A model whose text is given, imported and fitted to the screen.
std::string complaint_about_model(const std::vector<std::pair<std::string, std::string>>& files,
                                  const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("vindu-look-" + name);
  std::filesystem::create_directories(folder);
  for (const auto& [file, text] : files) std::ofstream(folder / file, std::ios::binary) << text;
  const Scene scene = import_scene((folder / files.front().first).string()).scene;
  std::filesystem::remove_all(folder);
  return testing::complaint_about(
      pictures_of(scene, screen(), place_scene(pack(scene), Placement::fit, screen()).navigation),
      "look-" + name);
}

/// A shape's vertices and faces as an OBJ file's lines; `first` counts on from shape to shape.
std::string obj_lines(const Shape& shape, const Eigen::Vector3f& place, float size, int& first) {
  std::ostringstream text;
  for (const Vertex& vertex : shape.vertices) {
    const Eigen::Vector3f p =
        (1e4f * (place + size * vertex.position_in_node)).array().round() / 1e4f;  // a closed seam
    text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << "\nvt " << vertex.uv.x() << ' '
         << 1 - vertex.uv.y() << '\n';
  }
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    text << 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = first + static_cast<int>(shape.indices[i + k]);
      text << ' ' << corner << '/' << corner;
    }
    text << '\n';
  }
  first += static_cast<int>(shape.vertices.size());
  return text.str();
}

std::string png_bytes(const Image& image) {
  const std::string file = ::testing::TempDir() + "/vindu-look.png";
  write_png(image, file);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::filesystem::remove(file);
  return bytes;
}

// Roughness grows to the right; from the top: gold, half metal, red paint, white paint.
TEST_F(Looks, RoughnessAndMetalness) {
  Scene scene;
  for (int column = 0; column < 7; ++column) {
    const float roughness = static_cast<float>(column) / 6,
                x = 0.21f * static_cast<float>(column) - 0.63f;
    add(scene, sphere(), lit(1, 0.77f, 0.34f, roughness, 1), at(x, 0.32f, -0.2f, 0.09f));
    add(scene, sphere(), lit(0.9f, 0.9f, 0.92f, roughness, 0.5f), at(x, 0.105f, -0.2f, 0.09f));
    add(scene, sphere(), lit(0.7f, 0.06f, 0.05f, roughness, 0), at(x, -0.105f, -0.2f, 0.09f));
    add(scene, sphere(), lit(0.9f, 0.9f, 0.9f, roughness, 0), at(x, -0.32f, -0.2f, 0.09f));
  }
  EXPECT_EQ(complaint_about(scene, "spheres"), "");
}

// All bumps stand out and are lit from the upper left: picture, picture turned by a quarter,
// mirrored picture, mirrored node; then a ball, a ring, and the back of a plate, where they are
// dents.
TEST_F(Looks, NormalMaps) {
  Scene scene;
  Material bumpy = lit(0.75f, 0.72f, 0.66f, 0.35f);
  bumpy.texture(TextureRole::normal).image = add(scene, bumps(128, 4));
  Material quarter = bumpy, mirrored = bumpy, both_sides = bumpy;
  quarter.texture(TextureRole::normal).texture_from_uv << 0, 1, 0, -1, 0, 1;
  mirrored.texture(TextureRole::normal).texture_from_uv << -1, 0, 1, 0, 1, 0;
  both_sides.double_sided = true;
  add(scene, square(), bumpy, at(-0.6f, 0.22f, -0.1f, 0.18f));
  add(scene, square(), quarter, at(-0.2f, 0.22f, -0.1f, 0.18f));
  add(scene, square(), mirrored, at(0.2f, 0.22f, -0.1f, 0.18f));
  add(scene, square(), bumpy, at(0.6f, 0.22f, -0.1f, 0.18f) * scaled_by(-1, 1, 1));
  bumpy.texture(TextureRole::normal).texture_from_uv << 3, 0, 0, 0, 2, 0;
  add(scene, sphere(), bumpy, at(-0.5f, -0.2f, -0.2f, 0.2f));
  bumpy.metallic = 1;
  add(scene, torus(0.35f), bumpy,
      at(0, -0.2f, -0.2f, 0.15f) * turned(60, Eigen::Vector3f::UnitX()));
  add(scene, square(), both_sides,
      at(0.5f, -0.2f, -0.1f, 0.18f) * turned(180, Eigen::Vector3f::UnitY()));
  EXPECT_EQ(complaint_about(scene, "normal-maps"), "");
}

// A plate and a ball: fields of polished copper and rough paint, with dirt in their corners.
TEST_F(Looks, MetallicRoughnessAndOcclusionTextures) {
  Scene scene;
  Material material = lit(1, 1, 1, 1, 1);
  material.texture(TextureRole::base_colour).image =
      add(scene, chequered(64, 16, {240, 160, 130, 255}, {60, 110, 140, 255}));
  material.texture(TextureRole::metallic_roughness).image =
      add(scene, chequered(64, 16, {0, 50, 255, 255}, {0, 200, 0, 255}));
  Image occlusion = discs(64, 2, {255, 255, 255, 255});
  for (Rgba8& pixel : occlusion.pixels)
    if (pixel[3] == 0) pixel = {70, 0, 0, 255};
  material.texture(TextureRole::occlusion).image = add(scene, occlusion);
  add(scene, square(), material, at(-0.4f, 0, -0.2f, 0.32f) * turned(-20, {1, 1, 0}));
  for (TextureUse& use : material.textures) use.texture_from_uv << 4, 0, 0, 0, 2, 0;
  add(scene, sphere(), material, at(0.4f, 0, -0.2f, 0.32f));
  EXPECT_EQ(complaint_about(scene, "metal-paint"), "");
}

// Embers in a dark ball, a lamp that is plainly one colour, a screen with an F.
TEST_F(Looks, Emission) {
  Scene scene;
  Material embers = lit(0.03f, 0.03f, 0.03f, 0.6f);
  embers.emissive = {1, 0.45f, 0.1f};
  embers.texture(TextureRole::emissive).image =
      add(scene, chequered(64, 4, {255, 255, 255, 255}, {20, 10, 5, 255}));
  embers.texture(TextureRole::emissive).texture_from_uv << 2, 0, 0, 0, 1, 0;
  add(scene, sphere(), embers, at(-0.48f, 0, -0.2f, 0.24f));
  Material lamp = lit(0, 0, 0, 0.2f);
  lamp.emissive = {1.6f, 1.4f, 1.0f};
  add(scene, torus(0.25f), lamp, at(0, 0, -0.2f, 0.17f) * turned(70, {1, 0, 0}));
  Material picture = lit(0.02f, 0.02f, 0.02f, 0.15f);
  picture.emissive = {1, 1, 1};
  picture.texture(TextureRole::emissive).image = add(scene, letter({120, 200, 255, 255}));
  add(scene, box(), picture, at(0.48f, 0, -0.3f, 0.22f) * turned(-25, {0, 1, 0}));
  add_floor(scene, -0.35f, lit(0.3f, 0.3f, 0.3f));
  EXPECT_EQ(complaint_about(scene, "emission"), "");
}

// Panes one behind the other that are given in no order, two that stand across, and a ball among
// them.
TEST_F(Looks, StackOfGlass) {
  Scene scene;
  const Eigen::Vector3f colours[] = {
      {1, 0.1f, 0.1f}, {0.1f, 0.9f, 0.2f}, {0.15f, 0.3f, 1}, {1, 0.8f, 0.1f}};
  for (const int i : {2, 0, 3, 1}) {
    const Eigen::Vector3f& c = colours[i];
    const auto step = static_cast<float>(i);
    add(scene, square(), glass(c.x(), c.y(), c.z(), 0.5f),
        at(-0.5f + 0.12f * step, -0.08f + 0.06f * step, -0.5f + 0.16f * step, 0.2f));
  }
  add(scene, sphere(), lit(0.85f, 0.85f, 0.85f, 0.4f), at(-0.28f, 0, -0.27f, 0.08f));
  add(scene, square(), glass(0.9f, 0.2f, 0.8f, 0.4f),
      at(0.5f, 0, -0.2f, 0.24f) * turned(75, {0, 1, 0}));
  add(scene, square(), glass(0.2f, 0.9f, 0.9f, 0.4f),
      at(0.3f, 0, -0.2f, 0.24f) * turned(60, {0, 1, 0}));
  add_floor(scene, -0.35f, lit(0.5f, 0.5f, 0.5f));
  EXPECT_EQ(complaint_about(scene, "glass-stack"), "");
}

// Closed bodies of glass, one within the other: far sides shine through near ones.
TEST_F(Looks, BodiesOfGlass) {
  Scene scene;
  add(scene, sphere(), glass(0.2f, 0.5f, 1, 0.35f), at(-0.4f, 0, -0.25f, 0.3f));
  add(scene, sphere(), lit(1, 0.6f, 0.1f, 0.3f, 1), at(-0.4f, 0, -0.25f, 0.12f));
  Material pane = glass(1, 1, 1, 1);
  pane.texture(TextureRole::base_colour).image =
      add(scene, chequered(64, 16, {255, 90, 60, 200}, {255, 255, 255, 50}));
  add(scene, box(), pane, at(0.4f, 0, -0.3f, 0.22f) * turned(30, {1, 1, 0}));
  EXPECT_EQ(complaint_about(scene, "glass-bodies"), "");
}

// Discs cut out of plates, near and far: their edges are smooth, the far ones do not vanish, their
// shadows have holes.
TEST_F(Looks, CutOutMasks) {
  Scene scene;
  Material leaves = lit(1, 1, 1, 0.7f);
  leaves.alpha_mode = AlphaMode::mask;
  leaves.double_sided = true;
  leaves.texture(TextureRole::base_colour).image = add(scene, discs(128, 8, {90, 170, 60, 255}));
  add(scene, square(), leaves, at(-0.45f, 0, 0, 0.3f) * turned(20, {0, 1, 0}));
  leaves.texture(TextureRole::base_colour).texture_from_uv << 6, 0, 0, 0, 6, 0;
  add(scene, square(), leaves, at(0.4f, 0.1f, -0.8f, 0.4f) * turned(-20, {0, 1, 0}));
  add_floor(scene, -0.35f, lit(0.7f, 0.65f, 0.6f));
  EXPECT_EQ(complaint_about(scene, "masks"), "");
}

// One key light from the upper left, before the wall: columns, a slab on thin legs, a hoop and
// rods.
TEST_F(Looks, ShadowsOfTheKeyLight) {
  Scene scene;
  const Material stone = lit(0.7f, 0.68f, 0.64f, 0.8f);
  add_floor(scene, -0.4f, stone);
  for (const float x : {-0.6f, -0.3f})
    add(scene, box(), lit(0.8f, 0.5f, 0.35f),
        moved_by(x, -0.15f, -0.5f) * scaled_by(0.05f, 0.25f, 0.05f));
  add(scene, box(), stone, moved_by(0.25f, -0.12f, -0.4f) * scaled_by(0.22f, 0.02f, 0.16f));
  for (const float x : {0.07f, 0.43f})
    for (const float z : {-0.52f, -0.28f})
      add(scene, box(), stone, moved_by(x, -0.27f, z) * scaled_by(0.006f, 0.13f, 0.006f));
  add(scene, sphere(), lit(0.75f, 0.1f, 0.1f, 0.3f), at(0.25f, -0.02f, -0.4f, 0.08f));
  add(scene, torus(0.12f), lit(0.9f, 0.7f, 0.3f, 0.25f, 1),
      at(-0.1f, -0.2f, -0.1f, 0.16f) * turned(80, {1, 0.3f, 0}));
  add(scene, square(), stone, at(0, 0.3f, -1.4f, 1));
  EXPECT_EQ(complaint_about(scene, "shadows"), "");
}

TEST_F(Looks, VertexColours) {
  Scene scene;
  Shape ball = sphere(), ring = torus(0.4f);
  for (Vertex& vertex : ball.vertices)
    for (std::size_t i = 0; i < 3; ++i)
      vertex.colour[i] = static_cast<std::uint8_t>(
          std::lround(127.5f + 127.5f * vertex.normal_in_node[static_cast<int>(i)]));
  for (Vertex& vertex : ring.vertices)
    vertex.colour = static_cast<int>(8 * vertex.uv.y()) % 2 ? Rgba8{230, 230, 230, 255}
                                                            : Rgba8{200, 40, 40, 255};
  scene.colours = ColourCoding::srgb;
  add(scene, ball, lit(1, 1, 1), at(-0.4f, 0, -0.25f, 0.3f));
  add(scene, ring, lit(1, 1, 1, 0.3f), at(0.4f, 0, -0.25f, 0.22f) * turned(50, {1, 0, 0.4f}));
  EXPECT_EQ(complaint_about(scene, "vertex-colours"), "");
}

// An OBJ file without materials and normals.
TEST_F(Looks, ModelWithoutMaterials) {
  int first = 1;
  std::string text = obj_lines(torus(0.3f), {0, 0, 0}, 1, first);
  text += obj_lines(sphere(), {0, 0.2f, 0}, 0.6f, first);
  text += obj_lines(box(), {0, -0.5f, 0}, 0.35f, first);
  EXPECT_EQ(complaint_about_model({{"plain.obj", text}}, "no-materials"), "");
}

// Diffuse, specular and shininess; a tinted texture; half seen through; a picture of heights.
TEST_F(Looks, PhongMaterialsOfAnObjFile) {
  int first = 1;
  std::string text = "mtllib phong.mtl\n";
  const char* names[] = {"dull", "plastic", "polished", "wood", "jelly", "rivets"};
  for (int i = 0; i < 6; ++i) {
    const int line = i / 3;
    const auto column = static_cast<float>(i % 3), row = static_cast<float>(line);
    text += std::string("usemtl ") + names[i] + "\n" +
            obj_lines(sphere(), {2.4f * column, -2.4f * row, 0}, 1, first);
  }
  const std::string mtl =
      "newmtl dull\nKd 0.7 0.5 0.3\nKs 0 0 0\n"
      "newmtl plastic\nKd 0.1 0.4 0.7\nKs 0.5 0.5 0.5\nNs 40\n"
      "newmtl polished\nKd 0.6 0.05 0.05\nKs 1 1 1\nNs 900\n"
      "newmtl wood\nKd 1 0.8 0.6\nNs 10\nmap_Kd fields.png\n"
      "newmtl jelly\nKd 0.2 0.8 0.3\nKs 1 1 1\nNs 300\nd 0.5\n"
      "newmtl rivets\nKd 0.6 0.6 0.6\nKs 1 1 1\nNs 100\nmap_Bump -bm 1 heights.png\n";
  Image heights = discs(128, 8, {255, 255, 255, 255});
  for (Rgba8& pixel : heights.pixels) pixel = {pixel[3], pixel[3], pixel[3], 255};
  EXPECT_EQ(
      complaint_about_model(
          {{"phong.obj", text},
           {"phong.mtl", mtl},
           {"fields.png", png_bytes(chequered(64, 8, {230, 200, 150, 255}, {150, 100, 60, 255}))},
           {"heights.png", png_bytes(heights)}},
          "phong"),
      "");
}

// The same letter on a plate and on a box: as it is, mirrored by its node, turned within a mirrored
// parent.
TEST_F(Looks, MirroredNodes) {
  Scene scene;
  Material paper = lit(1, 1, 1, 0.4f);
  paper.texture(TextureRole::base_colour).image = add(scene, letter({240, 225, 190, 255}));
  paper.texture(TextureRole::normal).image = add(scene, bumps(64, 4));
  const Eigen::Matrix4f leaning = turned(30, {1, 1, 0}) * scaled_by(0.16f, 0.16f, 0.16f);
  add(scene, box(), paper, moved_by(-0.5f, 0, -0.25f) * leaning);
  add(scene, box(), paper, moved_by(0, 0, -0.25f) * scaled_by(-1, 1, 1) * leaning);
  scene.nodes.push_back(empty_node(moved_by(0.5f, 0, -0.25f) * scaled_by(1, -1, 1)));
  add(scene, box(), paper, leaning, static_cast<int>(scene.nodes.size()) - 1);
  add_floor(scene, -0.35f, lit(0.4f, 0.45f, 0.5f));
  EXPECT_EQ(complaint_about(scene, "mirrored-nodes"), "");
}

// Upper row: the letter repeated, mirrored, held at its edge; lower row: turned by a quarter, half
// as large, and by the second coordinates, which hold it twice.
TEST_F(Looks, TexturesRepeatMirrorTurnAndTakeTheSecondCoordinates) {
  Scene scene;
  Material material = lit(1, 1, 1, 0.9f);
  TextureUse& use = material.texture(TextureRole::base_colour);
  use.image = add(scene, letter({250, 210, 120, 255}));
  use.texture_from_uv << 2.5f, 0, -0.75f, 0, 2.5f, -0.75f;
  float x = -0.5f;
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    use.wrap_u = use.wrap_v = wrap;
    add(scene, square(), material, at(x, 0.21f, -0.05f, 0.19f));
    x += 0.5f;
  }
  use = {.image = use.image};
  use.texture_from_uv << 0, 1, 0, -1, 0, 1;
  add(scene, square(), material, at(-0.5f, -0.21f, -0.05f, 0.19f));
  use.texture_from_uv << 2, 0, 0, 0, 2, 0;
  add(scene, square(), material, at(0, -0.21f, -0.05f, 0.19f));
  use = {.image = use.image, .uv_set = 1};
  Shape twice = square();
  for (Vertex& vertex : twice.vertices) vertex.uv_1 = vertex.uv.cwiseProduct(Eigen::Vector2f(2, 1));
  add(scene, twice, material, at(0.5f, -0.21f, -0.05f, 0.19f));
  EXPECT_EQ(complaint_about(scene, "texture-uses"), "");
}

// Both sides of a bowl and of a plate are lit as what faces the viewer; one-sided ones have no
// back.
TEST_F(Looks, BothSides) {
  Scene scene;
  Shape half = sphere();
  half.indices.resize(half.indices.size() / 2);
  Material shell = lit(0.75f, 0.35f, 0.2f, 0.45f);
  const Eigen::Matrix4f open = turned(205, {1, 0, 0});
  add(scene, half, shell, at(-0.55f, 0, -0.2f, 0.2f) * open);
  shell.double_sided = true;
  add(scene, half, shell, at(-0.1f, 0, -0.2f, 0.2f) * open);
  add(scene, square(), shell, at(0.25f, 0, -0.2f, 0.15f) * turned(40, {0, 1, 0}));
  add(scene, square(), shell, at(0.6f, 0, -0.2f, 0.15f) * turned(220, {0, 1, 0}));
  add_floor(scene, -0.35f, lit(0.6f, 0.6f, 0.6f));
  EXPECT_EQ(complaint_about(scene, "both-sides"), "");
}

/// All that could show where tiles meet: lines as thin as a pixel, fields that run to the horizon,
/// edges of shadows, glass, masks and highlights.
Scene seam_stress() {
  Scene scene;
  Material fields = lit(1, 1, 1, 0.35f);
  fields.texture(TextureRole::base_colour).image =
      add(scene, chequered(64, 8, {235, 235, 235, 255}, {40, 60, 90, 255}));
  fields.texture(TextureRole::base_colour).texture_from_uv << 8, 0, 0, 0, 8, 0;
  add_floor(scene, -0.35f, fields);
  for (int i = -8; i <= 8; ++i)
    add(scene, box(), lit(0.9f, 0.3f, 0.1f),
        moved_by(0.093f * static_cast<float>(i), 0, -0.15f) * turned(7, {0, 0, 1}) *
            scaled_by(0.0022f, 0.34f, 0.0022f));
  add(scene, sphere(), lit(0.95f, 0.8f, 0.4f, 0.15f, 1), at(0.02f, 0.02f, -0.3f, 0.2f));
  add(scene, square(), glass(0.1f, 0.7f, 1, 0.4f), at(-0.38f, 0.02f, -0.05f, 0.2f));
  add(scene, square(), glass(1, 0.2f, 0.5f, 0.4f), at(-0.25f, 0.12f, -0.1f, 0.2f));
  Material mask = lit(1, 1, 1);
  mask.alpha_mode = AlphaMode::mask;
  mask.texture(TextureRole::base_colour).image = add(scene, discs(128, 10, {80, 190, 90, 255}));
  add(scene, square(), mask, at(0.42f, 0.03f, -0.1f, 0.22f));
  return scene;
}

TEST_F(Looks, SeamStress) {
  EXPECT_EQ(complaint_about(pictures_of(seam_stress(), eight_tiles()), "look-seams"), "");
}

TEST_F(Looks, TilesOfTheSeamStressAreOnePicture) {
  const Image joined = pictures_of(seam_stress(), eight_tiles()),
              one = pictures_of(seam_stress(), screen());
  const auto difference = difference_of(joined, one);
  ASSERT_TRUE(difference);
  std::printf("largest difference %d levels, mean %.5f\n", difference->largest_levels,
              difference->mean_levels);
  EXPECT_LE(difference->mean_levels, 0.01);
}

}  // namespace
}  // namespace vindu
