// Real models: Debian's assimp-testmodels in the formats that people have, each with its number of
// triangles and of textures that can be decoded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "renderer/import.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

struct Known {
  const char* file;
  std::size_t triangles;
  std::size_t textures;
};

std::string test_name(const ::testing::TestParamInfo<Known>& info) {
  std::string name = info.param.file;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

/// Every index in range, every number finite, every normal of unit length.
void expect_sound(const Scene& scene) {
  for (const Vertex& vertex : scene.vertices) {
    ASSERT_TRUE(vertex.position_in_node.allFinite());
    ASSERT_TRUE(vertex.uv.allFinite());
    ASSERT_NEAR(vertex.normal_in_node.norm(), 1, 1e-3);
  }
  for (const std::uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_EQ(mesh.index_count % 3, 0u);
    EXPECT_LE(std::size_t{mesh.first_index} + mesh.index_count, scene.indices.size());
    EXPECT_LT(std::size_t(mesh.material), scene.materials.size());
  }
  for (const Material& material : scene.materials) {
    EXPECT_LT(material.texture(TextureRole::base_colour).image,
              static_cast<int>(scene.textures.size()));
    EXPECT_TRUE(material.base_colour.allFinite());
    EXPECT_TRUE(material.roughness >= 0 && material.roughness <= 1) << material.roughness;
    EXPECT_TRUE(material.metallic >= 0 && material.metallic <= 1) << material.metallic;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
    EXPECT_EQ(scene.nodes[i].parent < 0, i == 0);
  }
}

class RealModel : public ::testing::TestWithParam<Known> {};

TEST_P(RealModel, LoadsWhole) {
  const std::string file = test::test_model(GetParam().file);
  ASSERT_TRUE(std::filesystem::exists(file)) << "install assimp-testmodels";

  const Scene scene = import_scene(file).scene;

  EXPECT_EQ(scene.triangle_count(), GetParam().triangles);
  EXPECT_EQ(scene.textures.size(), GetParam().textures);
  expect_sound(scene);
  const float size = bounds_in_scene(scene).diagonal().norm();
  EXPECT_TRUE(size > 1e-3f && size < 1e5f) << size;
  for (const double t_s : {0.0, 0.7, 1e6})
    for (const Eigen::Matrix4f& transform : node_transforms(scene, t_s))
      ASSERT_TRUE(transform.allFinite());
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealModel,
    ::testing::Values(
        Known{"3DS/RotatingCube.3DS", 12, 0}, Known{"3DS/cube_with_diffuse_texture.3DS", 12, 1},
        Known{"3DS/fels.3ds", 768, 0}, Known{"3DS/test1.3ds", 108, 3}, Known{"3MF/box.3mf", 12, 0},
        Known{"AC/Wuson.ac", 3732, 0}, Known{"B3D/WusonBlitz.b3d", 3732, 0},
        Known{"BLEND/BlenderDefault_276.blend", 12, 0}, Known{"BLEND/Suzanne_248.blend", 3872, 0},
        Known{"Collada/COLLADA.dae", 6722, 0}, Known{"Collada/COLLADA_triangulate.dae", 6722, 0},
        Known{"Collada/Cinema4D.dae", 1296, 0}, Known{"Collada/ConcavePolygon.dae", 64, 0},
        Known{"Collada/anims_with_full_rotations_between_keys.DAE", 768, 0},
        Known{"Collada/box_nested_animation.dae", 12, 0}, Known{"Collada/cube_UTF8BOM.dae", 12, 0},
        Known{"Collada/cube_tristrips.dae", 12, 0}, Known{"Collada/cube_with_2UVs.DAE", 12, 0},
        Known{"Collada/duck.dae", 4212, 1}, Known{"Collada/duck.zae", 4212, 1},
        Known{"Collada/duck_nomanifest.zae", 4212, 1},
        Known{"Collada/duck_triangulate.dae", 4212, 1}, Known{"Collada/human.zae", 28796, 1},
        Known{"Collada/kwxport_test_vcolors.dae", 12, 3}, Known{"Collada/sphere.dae", 760, 0},
        Known{"Collada/sphere_triangulate.dae", 760, 0},
        Known{"Collada/teapot_instancenodes.DAE", 1024, 0}, Known{"Collada/teapots.DAE", 2976, 1},
        Known{"DXF/wuson.dxf", 3732, 0}, Known{"FBX/animation_with_skeleton.fbx", 2112, 0},
        Known{"FBX/box.fbx", 12, 0}, Known{"FBX/boxWithCompressedCTypeArray.FBX", 12, 0},
        Known{"FBX/boxWithUncompressedCTypeArray.FBX", 12, 0},
        Known{"FBX/box_orphant_embedded_texture.fbx", 12, 1},
        Known{"FBX/close_to_identity_transforms.fbx", 420, 0},
        Known{"FBX/cubes_nonames.fbx", 420, 0},
        Known{"FBX/cubes_with_mirroring_and_pivot.fbx", 420, 0},
        Known{"FBX/cubes_with_names.fbx", 420, 0},
        Known{"FBX/cubes_with_outofrange_float.fbx", 420, 0},
        Known{"FBX/embedded_ascii/box.FBX", 12, 1},
        Known{"FBX/embedded_ascii/box_embedded_texture_fragmented.fbx", 12, 1},
        Known{"FBX/global_settings.fbx", 1352, 0}, Known{"FBX/huesitos.fbx", 120, 0},
        Known{"FBX/maxPbrMaterial_metalRough.fbx", 12, 0},
        Known{"FBX/maxPbrMaterial_specGloss.fbx", 12, 0}, Known{"FBX/phong_cube.fbx", 12, 0},
        Known{"FBX/spider.fbx", 1368, 0}, Known{"IFC/AC14-FZK-Haus.ifc", 32588, 0},
        Known{"LWO/LWO2/hierarchy.lwo", 564, 0}, Known{"LWO/LWO2/uvtest.lwo", 32, 1},
        Known{"MD2/faerie.md2", 654, 0}, Known{"MD2/sydney.md2", 679, 0},
        Known{"MD5/SimpleCube.md5mesh", 12, 0}, Known{"MS3D/jeep1.ms3d", 2032, 1},
        Known{"OBJ/WusonOBJ.obj", 3732, 0}, Known{"OBJ/box.obj", 12, 0},
        Known{"OBJ/box_longline.obj", 944, 0}, Known{"OBJ/box_mat_with_spaces.obj", 12, 0},
        Known{"OBJ/box_without_lineending.obj", 12, 0}, Known{"OBJ/concave_polygon.obj", 64, 0},
        Known{"OBJ/cube_mtllib_after_g.obj", 12, 0}, Known{"OBJ/cube_usemtl.obj", 12, 0},
        Known{"OBJ/cube_with_vertexcolors.obj", 12, 0},
        Known{"OBJ/cube_with_vertexcolors_uni.obj", 12, 0}, Known{"OBJ/regr01.obj", 2710, 0},
        Known{"OBJ/spider.obj", 1368, 4}, Known{"OBJ/testmixed.obj", 12, 0},
        Known{"OFF/Cube.off", 12, 0}, Known{"PLY/Wuson.ply", 3732, 0}, Known{"PLY/cube.ply", 12, 0},
        Known{"PLY/cube_binary.ply", 12, 0}, Known{"PLY/cube_uv.ply", 12, 0},
        Known{"PLY/float-color.ply", 1, 0}, Known{"RAW/WithColor.raw", 2, 0},
        Known{"RAW/WithTexture.raw", 2, 0}, Known{"RAW/Wuson.raw", 3732, 0},
        Known{"STL/3DSMaxExport.STL", 2000, 0}, Known{"STL/Spider_ascii.stl", 1368, 0},
        Known{"STL/Spider_binary.stl", 1368, 0}, Known{"STL/Wuson.stl", 3732, 0},
        Known{"STL/sphereWithHole.stl", 285, 0}, Known{"STL/triangle.stl", 1, 0},
        Known{"STL/triangle_with_empty_solid.stl", 1, 0},
        Known{"STL/triangle_with_two_solids.stl", 2, 0}, Known{"X/anim_test.x", 840, 0},
        Known{"X/test.x", 12, 1}, Known{"X3D/ComputerKeyboard.x3d", 100, 0},
        Known{"X3D/HelloX3dTrademark.x3d", 1280, 0},
        Known{"glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12, 1},
        Known{"glTF/BoxTextured-glTF-MaterialsCommon/BoxTextured.gltf", 12, 1},
        Known{"glTF/BoxTextured-glTF/BoxTextured.gltf", 12, 1},
        Known{"glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", 2856, 1},
        Known{"glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 75730, 0},
        Known{"glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", 12, 0},
        Known{"glTF2/BoxTexcoords-glTF/boxTexcoords.gltf", 12, 1},
        Known{"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", 12, 1},
        Known{"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12, 1},
        Known{"glTF2/BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf", 12, 1},
        Known{"glTF2/BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", 12, 0},
        Known{"glTF2/BoxTextured-glTF/BoxTextured.gltf", 12, 1},
        Known{"glTF2/ClearCoat-glTF/ClearCoatTest.gltf", 37116, 5},
        Known{"glTF2/IncorrectVertexArrays/Cube.gltf", 46, 0},
        Known{"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", 11, 0},
        Known{"glTF2/cameras/Cameras.gltf", 2, 0},
        Known{"glTF2/draco/2CylinderEngine.gltf", 65311, 0},
        Known{"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 2, 0},
        Known{"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", 2, 0},
        Known{"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_06.gltf", 2, 0},
        Known{"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_11.gltf", 2, 0},
        Known{"glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 12, 0},
        Known{"glTF2/simple_skin/simple_skin.gltf", 8, 0},
        Known{"glTF2/textureTransform/TextureTransformTest.gltf", 18, 5}),
    test_name);

TEST(RealModels, DuckIsATexturedDuckInMetres) {
  const Scene duck = import_scene(test::test_model("Collada/duck.dae")).scene;

  EXPECT_EQ(duck.metres_per_unit, 1.0);
  EXPECT_NEAR(bounds_in_scene(duck).diagonal().y(), 1.54, 0.01);  // 154 of its centimetres
  ASSERT_EQ(duck.textures.size(), 1u);
  EXPECT_EQ(duck.textures[0].width_px, 512);
  const Rgba8 body = duck.textures[0].at(300, 300);
  EXPECT_TRUE(body[0] > 150 && body[1] > 100 && body[2] < 100)  // yellow
      << int(body[0]) << ' ' << int(body[1]) << ' ' << int(body[2]);
}

TEST(RealModels, InchesOfColladaAreScaledOnce) {
  const Scene cube = import_scene(test::test_model("Collada/cube_with_2UVs.DAE")).scene;

  EXPECT_EQ(cube.metres_per_unit, 1.0);
  EXPECT_NEAR(bounds_in_scene(cube).diagonal().x(), 2 * 0.0254, 1e-5);
}

TEST(RealModels, FbxThatIsZUpIsUpright) {
  const Scene box = import_scene(test::test_model("FBX/embedded_ascii/box.FBX")).scene;

  // Its pivot is at its foot: the box stands on y = 0.
  EXPECT_NEAR(bounds_in_scene(box).min().y(), 0, 1e-4);
}

TEST(RealModels, BlendersZIsUp) {
  const Scene human = import_scene(test::test_model("BLEND/HUMAN.blend")).scene;

  const Eigen::Vector3f size = bounds_in_scene(human).diagonal();
  EXPECT_GT(size.y(), 2 * size.x());
  EXPECT_GT(size.y(), 2 * size.z());
}

// Lies in the file's x and y; 2 of its units long, 1 wide.
std::string opengex_triangle(const std::string& metrics) {
  return metrics + R"(
GeometryNode $node1 {
  ObjectRef {ref {$geometry1}}
  Transform {float[16] {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}
}
GeometryObject $geometry1 {
  Mesh (primitive = "triangles") {
    VertexArray (attrib = "position") {float[3] {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}}
    VertexArray (attrib = "normal") {float[3] {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}
    IndexArray {unsigned_int32[3] {{0, 1, 2}}}
  }
}
)";
}

TEST(RealModels, OpenGexStatesItsUnitAndUp) {
  const test::TemporaryFolder folder;
  const auto imported = [&](const std::string& metrics) {
    return import_scene(folder.write("triangle.ogex", opengex_triangle(metrics))).scene;
  };
  const Scene inches = imported(
      "Metric (key = \"distance\") {float {0.0254}}\nMetric (key=\"up\") {string {\"y\"}}");
  EXPECT_NEAR(*inches.metres_per_unit, 0.0254, 1e-9);
  EXPECT_TRUE(bounds_in_scene(inches).diagonal().isApprox(Eigen::Vector3f(2, 1, 0)));
  const Scene plain = imported("");
  EXPECT_EQ(plain.metres_per_unit, 1.0);
  EXPECT_TRUE(bounds_in_scene(plain).diagonal().isApprox(Eigen::Vector3f(2, 0, 1)));
  const Scene x_up = imported("Metric (key = \"up\") {string {\"x\"}}");
  EXPECT_TRUE(bounds_in_scene(x_up).diagonal().isApprox(Eigen::Vector3f(1, 2, 0)));
}

// A dwarf and a goblet are taller than deep; a walker is longer than tall; a ground lies.
TEST(RealModels, OtherFormatsZIsUpToo) {
  const auto tall_by_deep = [](const char* file) {
    const Eigen::Vector3f size =
        bounds_in_scene(import_scene(test::test_model(file)).scene).diagonal();
    return size.y() / size.z();
  };
  EXPECT_GT(tall_by_deep("COB/dwarf.cob"), 1.1f);
  EXPECT_GT(tall_by_deep("SMD/holy_grailref.smd"), 1.3f);
  EXPECT_LT(tall_by_deep("Q3D/E-AT-AT.q3o"), 0.9f);
  EXPECT_LT(tall_by_deep("HMP/terrain.hmp"), 0.5f);
}

TEST(RealModels, ProjectedTexturesHaveCoordinates) {
  for (const char* mapping : {"planar_x", "cylindrical_x", "spherical_y"}) {
    const Scene earth = import_scene(test::test_model("LWO/LWO2/MappingModes/earth_" +
                                                      std::string(mapping) + ".lwo"))
                            .scene;
    Eigen::AlignedBox2f used;
    for (const Vertex& vertex : earth.vertices) used.extend(vertex.uv);
    EXPECT_GT(used.sizes().minCoeff(), 0.5f) << mapping;
  }
}

TEST(RealModels, EmbeddedTexturesAreDecoded) {
  for (const char* file :
       {"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", "FBX/embedded_ascii/box.FBX",
        "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", "MDL/MDL3 (3DGS A4)/minigun.MDL"}) {
    const Scene scene = import_scene(test::test_model(file)).scene;
    ASSERT_EQ(scene.textures.size(), 1u) << file;
    EXPECT_GT(scene.textures[0].width_px, 16) << file;
    EXPECT_FALSE(std::ranges::all_of(scene.textures[0].pixels, [&](const Rgba8& pixel) {
      return pixel == scene.textures[0].pixels.front();
    })) << file;
  }
}

TEST(RealModels, AnimatedNodesMove) {
  for (const char* file :
       {"Collada/anims_with_full_rotations_between_keys.DAE", "glTF2/simple_skin/simple_skin.gltf",
        "3DS/RotatingCube.3DS", "FBX/animation_with_skeleton.fbx"}) {
    const Scene scene = import_scene(test::test_model(file)).scene;
    ASSERT_THAT(scene.animations, Not(IsEmpty())) << file;
    const double duration_s = scene.animations[0].duration_s;
    const auto start = node_transforms(scene, 0);
    const auto later = node_transforms(scene, 0.3 * duration_s);
    EXPECT_FALSE(std::ranges::equal(start, later, [](const auto& a, const auto& b) {
      return a.isApprox(b, 1e-4f);
    })) << file;
  }
}

TEST(RealModels, LinesAndMorphTargetsAreWarnedOf) {
  const auto warnings = [](const char* file) {
    return import_scene(test::test_model(file)).warnings;
  };

  EXPECT_THAT(warnings("OBJ/testmixed.obj"),
              ::testing::Contains(::testing::HasSubstr("points and lines")));
  EXPECT_THAT(warnings("glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf"),
              ::testing::Contains(::testing::HasSubstr("morph")));
  EXPECT_THAT(warnings("OBJ/spider.obj"), IsEmpty());
}

TEST(RealModels, TheSameFileIsImportedTheSameWay) {
  const Scene first = import_scene(test::test_model("OBJ/spider.obj")).scene;
  const Scene second = import_scene(test::test_model("OBJ/spider.obj")).scene;

  EXPECT_EQ(first.indices, second.indices);
  EXPECT_EQ(first.textures, second.textures);
  EXPECT_TRUE(std::ranges::equal(first.vertices, second.vertices, [](const auto& a, const auto& b) {
    return a.position_in_node == b.position_in_node && a.normal_in_node == b.normal_in_node &&
           a.uv == b.uv && a.colour == b.colour;
  }));
}

}  // namespace
}  // namespace vindu
