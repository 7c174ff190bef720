// Exact values: models of known numbers, written here, come out of the importer with these numbers
// in the scene's own conventions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "renderer/import.h"
#include "renderer/import_geometry.h"
#include "renderer/import_materials.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using test::gltf_quad;
using test::GltfParts;
using test::TemporaryFolder;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ImportResult imported(const std::string& name, std::string_view bytes) {
  const TemporaryFolder folder;
  return import_scene(folder.write(name, bytes));
}

Scene gltf_scene(const GltfParts& parts) { return imported("quad.gltf", gltf_quad(parts)).scene; }

Material gltf_material(const std::string& json) {
  return gltf_scene({.material = json}).materials.at(0);
}

const Vertex* vertex_at(const Scene& scene, const Eigen::Vector3f& position) {
  const auto found = std::ranges::find_if(scene.vertices, [&](const Vertex& vertex) {
    return vertex.position_in_node.isApprox(position);
  });
  return found == scene.vertices.end() ? nullptr : &*found;
}

std::string texture_member() {
  return R"(, "images": [{"uri": "data:image/png;base64,)" + test::base64(test::two_pixel_png()) +
         R"("}], "textures": [{"source": 0}])";
}

constexpr const char* kThreeCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A triangle of this material.
ImportResult obj_with_material(const std::string& mtl) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl paint\n" + mtl);
  const std::vector<std::uint8_t> png = test::two_pixel_png();
  folder.write("Maps/Paint.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  return import_scene(folder.write("a.obj", std::string("mtllib a.mtl\n") + kThreeCorners +
                                                "vt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n"));
}

/// A triangle in FBX's text form; its third vertex is 2 units along the file's z.
std::string fbx_triangle(const std::string& settings) {
  return R"(; FBX 7.3.0 project file
FBXHeaderExtension: {
  FBXHeaderVersion: 1003
  FBXVersion: 7300
}
GlobalSettings: {
  Version: 1000
  Properties70: {
)" + settings +
         R"(
  }
}
Objects: {
  Geometry: 1, "Geometry::", "Mesh" {
    Vertices: *9 {
      a: 0,0,0,1,0,0,0,0,2
    }
    PolygonVertexIndex: *3 {
      a: 0,1,-3
    }
    GeometryVersion: 124
  }
  Model: 2, "Model::triangle", "Mesh" {
    Version: 232
  }
}
Connections: {
  C: "OO",2,0
  C: "OO",1,2
}
)";
}

TEST(ImportGltf, TakesOverGeometryAndTree) {
  const Scene scene = gltf_scene({.node_more = R"(, "translation": [3, 4, 5])"});

  EXPECT_EQ(scene.name, "quad");
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.vertices.size(), 4u);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].index_count, 6u);
  EXPECT_EQ(scene.nodes[0].parent, -1);
  const Box3f bounds = bounds_in_scene(scene);
  EXPECT_TRUE(bounds.min().isApprox(Eigen::Vector3f(3, 4, 5)));
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(4, 5, 5)));
  for (const Vertex& vertex : scene.vertices)
    EXPECT_TRUE(vertex.normal_in_node.isApprox(Eigen::Vector3f::UnitZ()));
}

TEST(ImportGltf, IsInMetres) { EXPECT_EQ(gltf_scene({}).metres_per_unit, 1.0); }

TEST(ImportGltf, UpperLeftOfTheTextureIsZeroZero) {
  const Scene scene = gltf_scene({});

  const Vertex* upper_left = vertex_at(scene, {0, 1, 0});
  const Vertex* lower_right = vertex_at(scene, {1, 0, 0});

  ASSERT_TRUE(upper_left && lower_right);
  EXPECT_EQ(upper_left->uv, Eigen::Vector2f(0, 0));
  EXPECT_EQ(lower_right->uv, Eigen::Vector2f(1, 1));
}

TEST(ImportGltf, FactorsAreTakenAsTheyAre) {
  const Material material = gltf_material(R"({"name": "brass", "doubleSided": true,
      "emissiveFactor": [0.5, 0.25, 0.125],
      "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 0.8],
                               "metallicFactor": 0.75, "roughnessFactor": 0.25}})");

  EXPECT_EQ(material.name, "brass");
  EXPECT_TRUE(material.base_colour.isApprox(Eigen::Vector4f(0.2f, 0.4f, 0.6f, 0.8f)));
  EXPECT_FLOAT_EQ(material.metallic, 0.75f);
  EXPECT_FLOAT_EQ(material.roughness, 0.25f);
  EXPECT_TRUE(material.emissive.isApprox(Eigen::Vector3f(0.5f, 0.25f, 0.125f)));
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);  // whatever the factor's alpha
  EXPECT_EQ(material.texture(TextureRole::base_colour).image, -1);
  EXPECT_FALSE(material.unlit);
}

TEST(ImportGltf, DefaultsAreThoseOfTheSpecification) {
  const Material material = gltf_material("{}");

  EXPECT_EQ(material.base_colour, Eigen::Vector4f::Ones());
  EXPECT_FLOAT_EQ(material.metallic, 1);
  EXPECT_FLOAT_EQ(material.roughness, 1);
  EXPECT_TRUE(material.emissive.isZero());
  EXPECT_FALSE(material.double_sided);
}

TEST(ImportGltf, AlphaModes) {
  const Material mask = gltf_material(R"({"alphaMode": "MASK", "alphaCutoff": 0.25})");
  EXPECT_EQ(mask.alpha_mode, AlphaMode::mask);
  EXPECT_FLOAT_EQ(mask.alpha_cutoff, 0.25f);

  EXPECT_EQ(gltf_material(R"({"alphaMode": "BLEND"})").alpha_mode, AlphaMode::blend);
  EXPECT_EQ(gltf_material(R"({"alphaMode": "OPAQUE"})").alpha_mode, AlphaMode::opaque);
}

TEST(ImportGltf, UnlitMaterialsStayUnlit) {
  const GltfParts parts = {.material = R"({"extensions": {"KHR_materials_unlit": {}}})",
                           .more = R"(, "extensionsUsed": ["KHR_materials_unlit"])"};

  EXPECT_TRUE(gltf_scene(parts).materials.at(0).unlit);
}

TEST(ImportGltf, VertexColoursAreLinear) {
  EXPECT_THAT(gltf_scene({.vertex_colours = true}).vertices,
              Each(::testing::Field(&Vertex::colour, Rgba8{128, 64, 255, 255})));
  EXPECT_THAT(gltf_scene({}).vertices,
              Each(::testing::Field(&Vertex::colour, Rgba8{255, 255, 255, 255})));
}

TEST(ImportGltf, EmbeddedTextureIsDecoded) {
  const Scene scene =
      gltf_scene({.material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                  .more = texture_member()});

  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials.at(0).texture(TextureRole::base_colour).image, 0);
  EXPECT_EQ(scene.textures[0].width_px, 2);
  EXPECT_EQ(scene.textures[0].at(1, 0), (Rgba8{0, 255, 0, 128}));
}

/// Base colour, and each of the other four pictures with what belongs to it.
constexpr const char* kAllTextures = R"({
    "emissiveFactor": [1, 0.5, 0.25], "emissiveTexture": {"index": 0},
    "normalTexture": {"index": 0, "scale": 0.5},
    "occlusionTexture": {"index": 0, "strength": 0.75},
    "pbrMetallicRoughness": {"roughnessFactor": 0.5, "baseColorTexture": {"index": 0},
                             "metallicRoughnessTexture": {"index": 0}}})";

TEST(ImportGltf, AllFivePicturesAreTakenOver) {
  const Scene scene = gltf_scene({.material = kAllTextures, .more = texture_member()});

  const Material& material = scene.materials.at(0);
  EXPECT_EQ(scene.textures.size(), 1u);  // it is one picture
  for (const TextureUse& use : material.textures) EXPECT_GE(use.image, 0);
  EXPECT_FLOAT_EQ(material.roughness, 0.5f);
  EXPECT_FLOAT_EQ(material.metallic, 1);
  EXPECT_FLOAT_EQ(material.normal_scale, 0.5f);
  EXPECT_FLOAT_EQ(material.occlusion_strength, 0.75f);
  EXPECT_TRUE(material.emissive.isApprox(Eigen::Vector3f(1, 0.5f, 0.25f)));
}

TEST(ImportGltf, ANormalMapGivesTheVerticesTangents) {
  const Scene scene = gltf_scene({.material = kAllTextures, .more = texture_member()});

  for (const Vertex& vertex : scene.vertices) {
    EXPECT_TRUE(vertex.tangent_in_node.isApprox(Eigen::Vector3f::UnitX()));
    EXPECT_EQ(vertex.bitangent_sign, 1);
  }
}

TEST(ImportGltf, ASamplersWrappingIsThatOfTheTexture) {
  std::string textures = texture_member();
  textures.replace(textures.rfind("{\"source\": 0}"), 13, R"({"source": 0, "sampler": 0})");
  const Scene scene =
      gltf_scene({.material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                  .more = textures + R"(, "samplers": [{"wrapS": 33648, "wrapT": 33071}])"});

  const TextureUse& use = scene.materials.at(0).texture(TextureRole::base_colour);
  EXPECT_EQ(use.wrap_u, Wrap::mirror);
  EXPECT_EQ(use.wrap_v, Wrap::clamp);
}

TEST(ImportGltf, APictureThatGlowsOnBlackIsUnlit) {
  const ImportResult result =
      imported("quad.gltf", gltf_quad({.material = R"({"pbrMetallicRoughness": {"baseColorFactor":
                                  [0, 0, 0, 1]}, "emissiveFactor": [1, 0.5, 1],
                                  "emissiveTexture": {"index": 0}})",
                                       .more = texture_member()}));

  const Material& material = result.scene.materials.at(0);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.base_colour, Eigen::Vector4f(1, 0.5f, 1, 1));
  EXPECT_EQ(material.texture(TextureRole::base_colour).image, 0);
  EXPECT_TRUE(material.emissive.isZero());
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST(ImportGltf, TextureTransformIsThatOfTheExtension) {
  const Scene scene = gltf_scene(
      {.material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
          {"KHR_texture_transform":
            {"offset": [0.5, -0.25], "rotation": 0.3, "scale": [2, 3]}}}}})",
       .more = texture_member() + R"(, "extensionsUsed": ["KHR_texture_transform"])"});

  // offset + [c s; -s c] * scale * uv, for uv = (0, 0), (1, 0) and (0, 1).
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  const UvTransform& texture_from_uv =
      scene.materials.at(0).texture(TextureRole::base_colour).texture_from_uv;
  const auto place = [&](float u, float v) -> Eigen::Vector2f {
    return texture_from_uv * Eigen::Vector3f(u, v, 1);
  };
  EXPECT_TRUE(place(0, 0).isApprox(Eigen::Vector2f(0.5f, -0.25f), 1e-5f));
  EXPECT_TRUE(place(1, 0).isApprox(Eigen::Vector2f(0.5f + 2 * c, -0.25f - 2 * s), 1e-5f));
  EXPECT_TRUE(place(0, 1).isApprox(Eigen::Vector2f(0.5f + 3 * s, -0.25f + 3 * c), 1e-5f));
}

TEST(ImportGltf, AnimationMovesAndTurnsItsNode) {
  const Scene scene = imported("quad.gltf", test::gltf_moving_quad()).scene;

  ASSERT_EQ(scene.animations.size(), 1u);
  EXPECT_NEAR(scene.animations[0].duration_s, 2, 1e-6);
  const int node = scene.animations[0].channels.at(0).node;
  const Eigen::Matrix4f scene_from_node = node_transforms(scene, 1)[node];
  EXPECT_NEAR(scene_from_node(0, 3), 1, 1e-5);
  EXPECT_NEAR(scene_from_node(0, 0), std::sqrt(0.5), 1e-5);  // 45 degrees
  EXPECT_NEAR(scene_from_node(2, 0), -std::sqrt(0.5), 1e-5);
}

TEST(ImportObj, DiffuseColourIsKeptAndMeantAsSrgb) {
  const Scene scene = obj_with_material("Kd 0.5 1 0\nKs 1 1 1\nNs 98\n").scene;
  const Material& material = scene.materials.at(0);

  EXPECT_EQ(scene.colours, ColourCoding::srgb);
  EXPECT_NEAR(material.base_colour.x(), 0.5, 1e-6);
  EXPECT_NEAR(material.base_colour.y(), 1, 1e-6);
  EXPECT_NEAR(material.base_colour.z(), 0, 1e-6);
  EXPECT_EQ(material.metallic, 0);
  EXPECT_NEAR(material.roughness, std::pow(0.02, 0.25), 1e-5);  // 2 / (98 + 2)
  EXPECT_TRUE(material.double_sided);
}

TEST(ImportObj, OpacityIsBlended) {
  const Material material = obj_with_material("Kd 1 1 1\nd 0.25\n").scene.materials.at(0);

  EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
  EXPECT_FLOAT_EQ(material.base_colour.w(), 0.25f);
}

TEST(ImportObj, WhatNobodyCouldSeeIsShownAndSaidSo) {
  const ImportResult result = obj_with_material("Kd 1 1 1\nd 0\n");

  EXPECT_EQ(result.scene.materials.at(0).alpha_mode, AlphaMode::opaque);
  EXPECT_FLOAT_EQ(result.scene.materials.at(0).base_colour.w(), 1);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("opacity 0")));
}

TEST(ImportObj, TextureIsFoundInAnotherCaseAndFolder) {
  const ImportResult result = obj_with_material("Kd 1 1 1\nmap_Kd C:\\work\\paint.png\n");

  EXPECT_THAT(result.warnings, IsEmpty());
  ASSERT_EQ(result.scene.textures.size(), 1u);
  EXPECT_EQ(result.scene.materials.at(0).texture(TextureRole::base_colour).image, 0);
}

TEST(ImportObj, APictureOfHolesBecomesTheAlphaOfTheBaseColour) {
  const Scene scene = obj_with_material("Kd 1 1 1\nmap_d Maps/Paint.png\n").scene;

  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  const int image = material.texture(TextureRole::base_colour).image;
  ASSERT_GE(image, 0);
  EXPECT_EQ(scene.textures.at(image).at(0, 0), (Rgba8{255, 255, 255, 255}));
  EXPECT_EQ(scene.textures.at(image).at(1, 0), (Rgba8{255, 255, 255, 128}));
}

TEST(ImportObj, ABumpMapIsANormalMap) {
  const Scene scene = obj_with_material("Kd 1 1 1\nmap_Bump Maps/Paint.png\n").scene;

  EXPECT_GE(scene.materials.at(0).texture(TextureRole::normal).image, 0);
  for (const Vertex& vertex : scene.vertices) EXPECT_NEAR(vertex.tangent_in_node.norm(), 1, 1e-5);
}

TEST(ImportObj, DiffuseColourTintsTheTextureUnlessItIsBlack) {
  const Material tinted =
      obj_with_material("Kd 0.5 0.5 0.5\nmap_Kd Maps/Paint.png\n").scene.materials.at(0);
  const Material black =
      obj_with_material("Kd 0 0 0\nmap_Kd Maps/Paint.png\n").scene.materials.at(0);

  EXPECT_NEAR(tinted.base_colour.x(), 0.5, 1e-6);
  EXPECT_EQ(black.base_colour, Eigen::Vector4f::Ones());
}

TEST(ImportObj, MissingTextureIsAWarningAndTheColourRemains) {
  const ImportResult result = obj_with_material("Kd 1 0 0\nmap_Kd missing.png\n");

  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("missing.png")));
  EXPECT_EQ(result.scene.materials.at(0).texture(TextureRole::base_colour).image, -1);
  EXPECT_EQ(result.scene.materials.at(0).base_colour, Eigen::Vector4f(1, 0, 0, 1));
}

TEST(ImportObj, BrokenTextureIsAWarning) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd a.png\n");
  folder.write("a.png", "no picture");

  const ImportResult result = import_scene(folder.write(
      "a.obj", std::string("mtllib a.mtl\n") + kThreeCorners + "usemtl paint\nf 1 2 3\n"));

  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("a.png")));
  EXPECT_THAT(result.scene.textures, IsEmpty());
}

TEST(ImportObj, TexturesOverTheLimitAreLeftOut) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> png = test::two_pixel_png();
  const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
  folder.write("a.png", bytes);
  folder.write("b.png", bytes);
  folder.write("a.mtl", "newmtl a\nKd 1 1 1\nmap_Kd a.png\nnewmtl b\nKd 1 1 1\nmap_Kd b.png\n");
  const std::string file = folder.write("a.obj", std::string("mtllib a.mtl\n") + kThreeCorners +
                                                     "usemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
  ImportLimits limits;

  limits.texture_pixels = 4;
  EXPECT_EQ(import_scene(file, limits).scene.textures.size(), 2u);
  limits.texture_pixels = 3;
  const ImportResult result = import_scene(file, limits);
  EXPECT_EQ(result.scene.textures.size(), 1u);
  EXPECT_EQ(result.warnings.size(), 1u);
}

TEST(ImportObj, VertexColoursAreKeptAndMeantAsSrgb) {
  const ImportResult result =
      imported("a.obj", "v 0 0 0 0.5 1 0\nv 1 0 0 0.5 1 0\nv 0 1 0 0.5 1 0\nf 1 2 3\n");

  EXPECT_THAT(result.scene.vertices,
              Each(::testing::Field(&Vertex::colour, Rgba8{128, 255, 0, 255})));
  EXPECT_EQ(result.scene.materials.at(0).base_colour, Eigen::Vector4f::Ones());
}

TEST(ImportObj, TextureCoordinatesCountFromTheLowerLeftInTheFile) {
  const Scene scene =
      imported("a.obj", std::string(kThreeCorners) + "vt 0.25 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
          .scene;

  EXPECT_TRUE(vertex_at(scene, {0, 0, 0})->uv.isApprox(Eigen::Vector2f(0.25f, 1)));
  EXPECT_TRUE(vertex_at(scene, {0, 1, 0})->uv.isApprox(Eigen::Vector2f(0, 0)));
}

TEST(ImportObj, DoesNotStateItsUnit) {
  EXPECT_EQ(imported("a.obj", std::string(kThreeCorners) + "f 1 2 3\n").scene.metres_per_unit,
            std::nullopt);
}

TEST(ImportObj, MissingNormalsAreComputed) {
  const Scene scene = imported("a.obj", std::string(kThreeCorners) + "f 1 2 3\n").scene;

  for (const Vertex& vertex : scene.vertices)
    EXPECT_TRUE(vertex.normal_in_node.isApprox(Eigen::Vector3f::UnitZ()));
}

TEST(ImportObj, NormalsAreMadeUnitVectorsAndBrokenOnesReplaced) {
  const Scene scene =
      imported("a.obj", std::string(kThreeCorners) + "vn 0 0 5\nvn 0 0 0\nf 1//1 2//1 3//2\n")
          .scene;

  ASSERT_EQ(scene.vertices.size(), 3u);
  for (const Vertex& vertex : scene.vertices)
    EXPECT_TRUE(vertex.normal_in_node.isApprox(Eigen::Vector3f::UnitZ()));
}

TEST(ImportObj, EqualVerticesAreOne) {
  const Scene scene = imported("a.obj",
                               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nv 1 1 0\n"
                               "f 1 2 3\nf 5 6 4\n")
                          .scene;

  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.vertices.size(), 4u);
}

TEST(ImportObj, PolygonsAreCutIntoTriangles) {
  const Scene scene =
      imported("a.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\n").scene;

  EXPECT_EQ(scene.triangle_count(), 3u);
  float area = 0;  // of the notched square: 4 minus a triangle of base 2 and height 1.5
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return scene.vertices[scene.indices[i + k]].position_in_node;
    };
    area += 0.5f * (corner(1) - corner(0)).cross(corner(2) - corner(0)).z();
  }
  EXPECT_NEAR(area, 2.5, 1e-5);
}

TEST(ImportPly, TrianglesThatAreNotFiniteAreLeftOut) {
  const ImportResult result = imported(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
      "0\n0 1 0\nnan 0 0\n3 0 1 2\n3 1 2 3\n");

  EXPECT_EQ(result.scene.triangle_count(), 1u);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("1 broken triangles")));
  EXPECT_TRUE(bounds_in_scene(result.scene).diagonal().allFinite());
}

TEST(ImportFbx, StatesCentimetresPerUnit) {
  const Scene inches =
      imported("a.fbx", fbx_triangle(R"(P: "UnitScaleFactor", "double", "Number", "",2.54)")).scene;

  ASSERT_TRUE(inches.metres_per_unit);
  EXPECT_NEAR(*inches.metres_per_unit, 0.0254, 1e-6);
  EXPECT_NEAR(bounds_in_scene(inches).diagonal().x(), 1, 1e-6);  // not scaled twice
}

TEST(ImportFbx, ZUpIsTurnedUpright) {
  const Scene scene = imported("a.fbx", fbx_triangle(R"(
    P: "UpAxis", "int", "Integer", "",2
    P: "UpAxisSign", "int", "Integer", "",1
    P: "FrontAxis", "int", "Integer", "",1
    P: "FrontAxisSign", "int", "Integer", "",-1
    P: "CoordAxis", "int", "Integer", "",0
    P: "CoordAxisSign", "int", "Integer", "",1)"))
                          .scene;

  const Box3f bounds = bounds_in_scene(scene);
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(1, 2, 0), 1e-5f)) << bounds.max();
}

TEST(ImportFbx, YUpStaysAsItIs) {
  const Box3f bounds = bounds_in_scene(
      imported("a.fbx", fbx_triangle(R"(P: "UpAxis", "int", "Integer", "",1)")).scene);

  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(1, 0, 2), 1e-5f)) << bounds.max();
}

TEST(LinearFromSrgb, IsTheStandardsCurve) {
  EXPECT_FLOAT_EQ(linear_from_srgb(0), 0);
  EXPECT_NEAR(linear_from_srgb(0.04f), 0.04 / 12.92, 1e-6);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404, 1e-4);
  EXPECT_FLOAT_EQ(linear_from_srgb(1), 1);
}

TEST(RoughnessFromShininess, FallsFromDullToPolished) {
  EXPECT_FLOAT_EQ(roughness_from_shininess(0), 1);
  EXPECT_NEAR(roughness_from_shininess(30), 0.5, 1e-6);
  EXPECT_GE(roughness_from_shininess(1e9f), 0.1f);
  EXPECT_LE(roughness_from_shininess(-5), 1);
}

}  // namespace
}  // namespace vindu
