// How materials of older formats become metallic-roughness ones, and what a material asks of its
// shader.
#include <gtest/gtest.h>

#include "renderer/import.h"
#include "renderer/surface_kind.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

/// A triangle of this material; paint.png is beside it.
Scene obj_scene(const std::string& mtl) {
  const test::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl paint\n" + mtl);
  const std::vector<std::uint8_t> png = test::two_pixel_png();
  folder.write("paint.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  return import_scene(folder.write("a.obj",
                                   "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                   "usemtl paint\nf 1/1 2/1 3/1\n"))
      .scene;
}

TEST(LegacyMaterials, StayOpaqueWithoutAPictureOfHoles) {
  const Material material = obj_scene("Kd 1 1 1\nmap_Kd paint.png\n").materials.at(0);

  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(material.metallic, 0);
  EXPECT_EQ(material.texture(TextureRole::metallic_roughness).image, -1);
}

TEST(LegacyMaterials, StayOpaqueWhereThePictureOfHolesIsMissing) {
  const Material material =
      obj_scene("Kd 1 1 1\nmap_Kd paint.png\nmap_d missing.png\n").materials.at(0);

  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
}

TEST(LegacyMaterials, GlowByTheirPictureEvenWithoutAColour) {
  const Material material = obj_scene("Kd 1 1 1\nmap_Ke paint.png\n").materials.at(0);

  EXPECT_EQ(material.emissive, Eigen::Vector3f::Ones());
  EXPECT_GE(material.texture(TextureRole::emissive).image, 0);
  EXPECT_FALSE(material.unlit);
}

TEST(SurfaceKind, NamesTheTexturesThatThereAre) {
  Material material;
  EXPECT_EQ(kind_of(material), 0u);
  material.texture(TextureRole::normal).image = 0;
  material.texture(TextureRole::emissive) = {.image = 1, .uv_set = 1};
  EXPECT_EQ(kind_of(material),
            textured(TextureRole::normal) | textured(TextureRole::emissive) | kSecondUv);
}

TEST(SurfaceKind, OfWhatIsUnlitHasTheBaseColourAlone) {
  Material material;
  material.unlit = true;
  material.alpha_mode = AlphaMode::mask;
  material.texture(TextureRole::base_colour).image = 0;
  material.texture(TextureRole::normal) = {.image = 1, .uv_set = 1};
  EXPECT_EQ(kind_of(material), textured(TextureRole::base_colour) | kUnlit | kMasked);
}

}  // namespace
}  // namespace vindu
