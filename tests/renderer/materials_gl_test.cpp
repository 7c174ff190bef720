// What materials do to pixels: base colours byte for byte where they are measured, textures, vertex
// colours, alpha, and light.
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::Not;

class MaterialsGl : public GlTest {};

constexpr float level(int byte) { return static_cast<float>(byte) / 255; }

Scene textured(const Image& texture, Material material = plain(1, 1, 1)) {
  material.texture(TextureRole::base_colour).image = 0;
  Scene scene = square_scene(material);
  scene.textures.push_back(texture);
  return scene;
}

/// Upper row red, green; lower row blue, white; each quarter `side_px` wide.
Image quarters(int side_px) {
  Image image = Image::filled(2 * side_px, 2 * side_px, kWhite);
  paste(Image::filled(side_px, side_px, kRed), 0, 0, image);
  paste(Image::filled(side_px, side_px, kGreen), side_px, 0, image);
  paste(Image::filled(side_px, side_px, kBlue), 0, side_px, image);
  return image;
}

TEST_F(MaterialsGl, GivesBaseColoursByteForByteWhereTheyAreMeasured) {
  for (int byte = 0; byte < 256; ++byte) {
    Material material = plain(level(byte), level(255 - byte), level(byte / 2));
    material.unlit = false;
    const auto low = static_cast<std::uint8_t>(byte);
    const Rgba8 wanted{low, static_cast<std::uint8_t>(255 - byte),
                       static_cast<std::uint8_t>(byte / 2), 255};
    const Image image = draw_on_stage(square_scene(material), Style::unlit);
    ASSERT_EQ(image.at(10, 50), wanted) << byte;
  }
}

TEST_F(MaterialsGl, GivesVertexColoursByteForByteWhereTheyAreMeasured) {
  Scene scene = square_scene(plain(1, 1, 1));
  for (Vertex& vertex : scene.vertices) vertex.colour = {17, 130, 251, 255};
  EXPECT_THAT(draw_on_stage(scene, Style::unlit).pixels, Each(Rgba8{17, 130, 251, 255}));
}

TEST_F(MaterialsGl, GivesTexelsByteForByteWhereTheyAreMeasured) {
  const Image image = draw_on_stage(textured(Image::filled(8, 8, {3, 97, 201, 255})), Style::unlit);
  EXPECT_THAT(image.pixels, Each(Rgba8{3, 97, 201, 255}));
}

TEST_F(MaterialsGl, MultipliesBaseColourVertexColourAndTexel) {
  Scene scene = textured(Image::filled(4, 4, {200, 100, 255, 255}), plain(.5f, 1, .2f));
  for (Vertex& vertex : scene.vertices) vertex.colour = {255, 51, 255, 255};
  EXPECT_THAT(draw_on_stage(scene, Style::unlit).at(32, 32),
              IsNearColour(Rgba8{100, 20, 51, 255}, 1));
}

TEST_F(MaterialsGl, ShowsTexturesTheRightWayUp) {
  for (const Style style : {Style::lit, Style::unlit}) {
    const Image image = draw_on_stage(textured(quarters(32)), style);
    EXPECT_THAT(image.at(8, 8), IsNearColour(kRed, 0));
    EXPECT_THAT(image.at(56, 8), IsNearColour(kGreen, 0));
    EXPECT_THAT(image.at(8, 56), IsNearColour(kBlue, 0));
    EXPECT_THAT(image.at(56, 56), IsNearColour(kWhite, 0));
  }
}

TEST_F(MaterialsGl, RepeatsTextures) {
  Scene scene = textured(quarters(16));
  for (Vertex& vertex : scene.vertices) vertex.uv += Eigen::Vector2f(0.5f, -3);
  const Image image = draw_on_stage(scene, Style::unlit);
  EXPECT_THAT(image.at(8, 8), IsNearColour(kGreen, 0));
  EXPECT_THAT(image.at(56, 8), IsNearColour(kRed, 0));
}

// Decoded when read, encoded when written: an unlit texture comes out as it is in the file.
TEST_F(MaterialsGl, TakesTexturesAsSrgb) {
  const Image image = draw_on_stage(textured(Image::filled(8, 8, {60, 128, 210, 255})), Style::lit);
  EXPECT_THAT(image.at(32, 32), IsNearColour(Rgba8{60, 128, 210, 255}, 1));
}

// Far away a chequered texture has the light of its mean, 188, and not the mean of its bytes, 128.
TEST_F(MaterialsGl, ShrinksTexturesByTheirLight) {
  Image chequered = Image::filled(256, 256, kBlack);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      if ((x + y) % 2) chequered.at(x, y) = kWhite;
  const Image image = draw_on_stage(textured(chequered), Style::lit);
  EXPECT_THAT(image.at(32, 32), IsNearColour(Rgba8{188, 188, 188, 255}, 2));
}

TEST_F(MaterialsGl, EncodesLinearColoursOfUnlitMaterialsToSrgb) {
  const Image image = draw_on_stage(square_scene(plain(.2158605f, .5f, 1)), Style::lit);
  EXPECT_THAT(image.at(32, 32), IsNearColour(Rgba8{128, 188, 255, 255}, 1));
}

TEST_F(MaterialsGl, ShowsColoursOfSrgbFilesAsTheyAreWritten) {
  Scene by_vertex = square_scene(plain(1, 1, 1));
  by_vertex.colours = ColourCoding::srgb;
  for (Vertex& vertex : by_vertex.vertices) vertex.colour = {9, 128, 251, 255};
  EXPECT_THAT(draw_on_stage(by_vertex, Style::lit).at(32, 32),
              IsNearColour(Rgba8{9, 128, 251, 255}, 1));

  Scene by_material = square_scene(plain(level(9), level(128), level(251)));
  by_material.colours = ColourCoding::srgb;
  EXPECT_THAT(draw_on_stage(by_material, Style::lit).at(32, 32),
              IsNearColour(Rgba8{9, 128, 251, 255}, 1));
}

TEST_F(MaterialsGl, LightsTrianglesOfTheWrongWindingByTheirNormals) {
  Material both = plain(.4f, .4f, .4f);
  both.unlit = false;
  both.double_sided = true;
  Scene wound_back = square_scene(both);
  for (std::size_t i = 0; i < wound_back.indices.size(); i += 3)
    std::swap(wound_back.indices[i], wound_back.indices[i + 1]);
  EXPECT_EQ(draw_on_stage(wound_back, Style::lit), draw_on_stage(square_scene(both), Style::lit));
}

/// The square of the stage in folds narrower than a pixel, whose sides look away from the viewer by
/// turns; all normals look at him.
Scene folded(float depth_m) {
  constexpr int kFolds = 400;
  Material both = plain(.4f, .4f, .4f);
  both.unlit = false;
  both.double_sided = true;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (int i = 0; i <= kFolds; ++i) {
    const float x_m = 2.0f * static_cast<float>(i) / kFolds - 1;
    for (const float y_m : {-1.0f, 1.0f})
      vertices.push_back({.position_in_node = {x_m, y_m, static_cast<float>(i % 2) * depth_m},
                          .normal_in_node = {0, 0, 1}});
    const auto at = static_cast<std::uint32_t>(2 * i);
    if (i < kFolds) indices.insert(indices.end(), {at, at + 2, at + 3, at, at + 3, at + 1});
  }
  Scene scene;
  scene.nodes.push_back({.name = "folds", .meshes = {add_mesh(scene, vertices, indices, both)}});
  return scene;
}

TEST_F(MaterialsGl, LightsTrianglesThinnerThanAPixelByTheirNormals) {
  const Image image = draw_on_stage(folded(0.02f), Style::lit);
  const Image flat = draw_on_stage(folded(0), Style::lit);
  for (int y = 2; y < 62; ++y)
    for (int x = 2; x < 62; ++x)
      ASSERT_THAT(image.at(x, y), IsNearColour(flat.at(x, y), 6)) << x << ", " << y;
}

TEST_F(MaterialsGl, LightsOtherMaterials) {
  Material lit = plain(.2f, .2f, .2f);
  lit.unlit = false;
  const Scene scene = square_scene(lit);
  const Rgba8 wall_facing = draw_on_stage(scene, Style::lit).at(32, 32);
  Eigen::Matrix4f facing_down = Eigen::Matrix4f::Identity();
  facing_down.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(0.9f, Eigen::Vector3f::UnitX()).toRotationMatrix();
  const Rgba8 floor_facing = draw_on_stage(square_scene(lit, facing_down), Style::lit).at(32, 32);
  EXPECT_GT(wall_facing[1], floor_facing[1] + 15);
}

TEST_F(MaterialsGl, LightsTheBackOfADoubleSidedSurfaceAsWhatFacesTheViewer) {
  Material both = plain(.4f, .4f, .4f);
  both.unlit = false;
  both.double_sided = true;
  Scene turned = square_scene(both, scaled_by(-1, 1, -1));
  EXPECT_EQ(draw_on_stage(turned, Style::lit), draw_on_stage(square_scene(both), Style::lit));
}

TEST_F(MaterialsGl, AddsWhatGlows) {
  Material glowing = plain(0, 0, 0);
  glowing.unlit = false;
  const Rgba8 dark = draw_on_stage(square_scene(glowing), Style::lit).at(32, 32);
  glowing.emissive = {.5f, 0, 0};
  const Rgba8 bright = draw_on_stage(square_scene(glowing), Style::lit).at(32, 32);
  EXPECT_GT(bright[0], dark[0] + 80);
  EXPECT_NEAR(bright[1], dark[1], 12);
}

TEST_F(MaterialsGl, CutsHolesWhereAMaskSaysSo) {
  Material masked = plain(1, 1, 1);
  masked.alpha_mode = AlphaMode::mask;
  masked.alpha_cutoff = 0.4f;
  Image texture = Image::filled(64, 64, {255, 0, 0, 90});  // 90 / 255 is below the cutoff
  paste(Image::filled(32, 64, {255, 0, 0, 110}), 0, 0, texture);
  Scene scene = textured(texture, masked);
  add_square(scene, plain(0, 0, 1), moved_by(0, 0, -.1f) * scaled_by(2, 2, 1));
  const Image image = draw_on_stage(scene, Style::unlit);
  EXPECT_THAT(image.at(10, 32), IsNearColour(kRed, 0));
  EXPECT_THAT(image.at(54, 32), IsNearColour(kBlue, 0));
}

TEST_F(MaterialsGl, IgnoresAlphaOfOpaqueMaterials) {
  EXPECT_THAT(draw_on_stage(square_scene(plain(0, 1, 0, .1f)), Style::unlit).at(32, 32),
              IsNearColour(kGreen, 0));
}

/// Red and green glass, half seen through, red at z = 0.2 and green at -0.2, before a black
/// nothing.
Scene two_glasses(bool red_first) {
  Scene scene;
  for (const bool red : {red_first, !red_first}) {
    Material glass = plain(red ? 1 : 0, red ? 0 : 1, 0, .5f);
    glass.alpha_mode = AlphaMode::blend;
    glass.double_sided = true;
    add_square(scene, glass, moved_by(0, 0, red ? .2f : -.2f) * scaled_by(3, 3, 1));
  }
  return scene;
}

// The nearer glass covers half of the farther one: 1/2 and 1/4 of their light.
TEST_F(MaterialsGl, BlendsFromFarToNearWhateverTheirOrder) {
  for (const bool red_first : {true, false})
    EXPECT_THAT(draw_on_stage(two_glasses(red_first), Style::unlit).at(32, 32),
                IsNearColour(Rgba8{128, 64, 0, 255}, 1));
}

TEST_F(MaterialsGl, BlendsFromFarToNearAlsoFromTheOtherSide) {
  Mat4 half_turn = Mat4::Identity();
  half_turn.diagonal() = Vec4(-1, 1, -1, 1);
  for (const bool red_first : {true, false})
    EXPECT_THAT(
        draw_on_stage(two_glasses(red_first), Style::unlit, {0, 0, 2}, half_turn).at(32, 32),
        IsNearColour(Rgba8{64, 128, 0, 255}, 1));
}

TEST_F(MaterialsGl, BlendsLightAndNotBytesWhereItIsLit) {
  Material glass = plain(1, 1, 1, .5f);
  glass.alpha_mode = AlphaMode::blend;
  Scene scene = square_scene(glass);
  add_square(scene, plain(0, 0, 0), moved_by(0, 0, -.1f) * scaled_by(2, 2, 1));
  EXPECT_THAT(draw_on_stage(scene, Style::lit).at(32, 32),
              IsNearColour(Rgba8{188, 188, 188, 255}, 1));
}

TEST_F(MaterialsGl, HidesGlassBehindAnOpaqueSurface) {
  Scene scene = two_glasses(true);
  add_square(scene, plain(0, 0, 1), moved_by(0, 0, 0) * scaled_by(2, 2, 1));
  EXPECT_THAT(draw_on_stage(scene, Style::unlit).at(32, 32),
              IsNearColour(Rgba8{128, 0, 128, 255}, 1));
}

TEST_F(MaterialsGl, LeavesTheBackgroundToSeeWhereNothingIs) {
  Scene scene = square_scene(plain(1, 1, 1), scaled_by(.25f, .25f, 1));
  const Image lit = draw_on_stage(scene, Style::lit);
  EXPECT_THAT(lit.at(5, 5), Not(IsNearColour(kBlack, 3)));
  EXPECT_GT(lit.at(5, 5)[2], lit.at(5, 60)[2]);  // a sky above a darker floor
  EXPECT_EQ(draw_on_stage(scene, Style::unlit).at(5, 5), kBlack);
}

}  // namespace
}  // namespace vindu
