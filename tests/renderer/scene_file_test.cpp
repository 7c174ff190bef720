// Packed scenes: what is written comes back, and what is damaged does not.
#include "renderer/scene_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>

#include "core/error.h"
#include "renderer/scene_archive.h"

namespace vindu {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

Scene small_scene() {
  Scene scene;
  scene.name = "a";
  scene.vertices.resize(3);
  scene.vertices[1].position_in_node = {1, 2, 3};
  scene.vertices[1].uv_1 = {0.25f, 0.75f};
  scene.vertices[2].colour = {1, 2, 3, 4};
  scene.indices = {0, 1, 2};
  scene.meshes = {{0, 3, 0, Box3f(Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 2, 3)), true}};
  scene.joints.resize(2);
  scene.joints[1] = {1, 2 * Eigen::Matrix4f::Identity()};
  scene.influences.assign(3, {{1, 0, 0, 0}, {60000, kFullWeight - 60000, 0, 0}});
  scene.meshes.push_back(scene.meshes.front());
  scene.meshes[0].replaced_by = 0;
  scene.meshes[1].made_by = 0;
  scene.coarsenings = {{scene.meshes[0].bounds_in_node, 0.5f}};
  scene.textures = {Image::filled(2, 3, {9, 8, 7, 6})};
  Material material{.name = "red", .roughness = 0.25f};
  material.texture(TextureRole::normal) = {.image = 0, .uv_set = 1, .wrap_v = Wrap::clamp};
  material.double_sided = true;
  scene.materials = {material};
  scene.nodes = {{.name = "root", .meshes = {0}}, {.name = "arm", .parent = 0, .meshes = {}}};
  scene.animations = {
      {"wave",
       2.5,
       {{1, {{0.5, Eigen::Vector3f(1, 0, 0)}}, {{1, Eigen::Quaternionf(0, 1, 0, 0)}}, {}}}}};
  scene.colours = ColourCoding::srgb;
  scene.metres_per_unit = 0.01;
  return scene;
}

PackedScene small_packed() {
  PackedScene packed = pack(small_scene());
  packed.sources = {{"/models/a.obj", 120, std::string(64, 'a')}};
  packed.warnings = {"a texture is not there"};
  return packed;
}

std::string bytes_in(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator(stream), {}};
}

class SceneFile : public ::testing::Test {
 protected:
  SceneFile() {
    std::string pattern = (fs::temp_directory_path() / "vindu_scene_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    file_ = folder_ + "/a.vscene";
    write_scene_file(small_packed(), file_);
  }
  ~SceneFile() override { fs::remove_all(folder_); }

  std::string error_of(const std::string& bytes) const {
    const std::string file = folder_ + "/b.vscene";
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      read_scene_file(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::string folder_, file_;
};

TEST_F(SceneFile, BringsBackAllThatWasWritten) {
  const PackedScene packed = read_scene_file(file_), before = small_packed();
  EXPECT_EQ(packed.sources[0].path, "/models/a.obj");
  EXPECT_EQ(packed.sources[0].bytes, 120u);
  EXPECT_EQ(packed.warnings, before.warnings);
  EXPECT_EQ(packed.bounds_in_scene.max(), before.bounds_in_scene.max());
  EXPECT_EQ(packed.joint_boxes[0][1].joint, 1);
  EXPECT_EQ(packed.joint_boxes[0][1].box_in_mesh.max(), Eigen::Vector3f(1, 2, 3));
  const SceneOutline& scene = packed.scene;
  EXPECT_EQ(scene.materials[0].texture(TextureRole::normal).wrap_v, Wrap::clamp);
  EXPECT_TRUE(scene.materials[0].double_sided);
  EXPECT_EQ(scene.nodes[1].parent, 0);
  EXPECT_TRUE(scene.meshes[0].skinned);
  EXPECT_EQ(scene.joints[1].node, 1);
  EXPECT_EQ(scene.joints[1].joint_from_mesh, 2 * Eigen::Matrix4f::Identity());
  EXPECT_EQ(scene.meshes[0].replaced_by, 0);
  EXPECT_EQ(scene.meshes[1].made_by, 0);
  EXPECT_EQ(scene.coarsenings[0].error_in_node, 0.5f);
  EXPECT_EQ(scene.coarsenings[0].bounds_in_node.max(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(scene.animations[0].channels[0].rotations[0].value.x(), 1);
  EXPECT_EQ(scene.colours, ColourCoding::srgb);
  EXPECT_EQ(scene.metres_per_unit, 0.01);
}

TEST_F(SceneFile, BringsBackGeometryAndPicturesWhereTheyLie) {
  const PackedScene packed = read_scene_file(file_);
  const PackedGeometry& geometry = packed.geometry;
  EXPECT_EQ(geometry.vertices[1].position_in_node, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(geometry.colours[2], (Rgba8{1, 2, 3, 4}));
  EXPECT_EQ(geometry.details[1].uv_1, Eigen::Vector2f(0.25f, 0.75f));
  EXPECT_EQ(geometry.influences[2].weights[0], 60000);
  EXPECT_THAT(geometry.indices, ElementsAre(0, 1, 2));
  ASSERT_EQ(packed.textures.size(), 1u);
  EXPECT_FALSE(packed.textures[0].srgb);
  EXPECT_EQ(packed.textures[0].height_px, 3);
  EXPECT_THAT(packed.textures[0].pixels, Each(Rgba8{9, 8, 7, 6}));
  EXPECT_EQ(packed.textures[0].pixels.size(), 2u * 3 + 1);
}

TEST_F(SceneFile, StaysUsableWhenAnotherTakesItsPlace) {
  const PackedScene packed = read_scene_file(file_);
  Scene other = small_scene();
  other.vertices[1].position_in_node = {7, 7, 7};
  write_scene_file(pack(other), file_);
  EXPECT_EQ(packed.geometry.vertices[1].position_in_node, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(read_scene_file(file_).geometry.vertices[1].position_in_node, Eigen::Vector3f(7, 7, 7));
}

TEST_F(SceneFile, WritesTheSameBytesForTheSameScene) {
  write_scene_file(read_scene_file(file_), folder_ + "/again.vscene");
  EXPECT_EQ(bytes_in(file_), bytes_in(folder_ + "/again.vscene"));
}

TEST_F(SceneFile, RefusesWhatIsCutOffAnywhere) {
  const std::string whole = bytes_in(file_);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THAT(error_of(whole.substr(0, length)), HasSubstr("vindu pack")) << length;
}

TEST_F(SceneFile, RefusesAnyChangedByte) {
  const std::string whole = bytes_in(file_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x40);
    EXPECT_NE(error_of(changed), "") << at;
  }
}

TEST_F(SceneFile, RefusesAnotherFormatByName) {
  std::string other = bytes_in(file_);
  other[8] = 77;
  EXPECT_THAT(error_of(other), HasSubstr("another version"));
  EXPECT_THAT(error_of("glTF and more than thirty-two bytes of it"), HasSubstr("no packed scene"));
}

TEST_F(SceneFile, IsNotLeftBehindInPartWhereItCannotBeWritten) {
  EXPECT_THROW(write_scene_file(small_packed(), folder_ + "/none/a.vscene"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

/// What the checksum cannot know: bytes that were changed and summed anew.
TEST(SceneFrom, AnyBytesIsASceneThatCanBeDrawnOrAnError) {
  std::mt19937 random(7);
  SceneWriter writer;
  writer(small_packed());
  const std::vector<std::uint8_t> whole = writer.take();
  int errors = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> changed = whole;
    const std::size_t count = 1 + random() % 4;
    for (std::size_t byte = 0; byte < count; ++byte)
      changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
    try {
      const PackedScene packed = scene_from(changed, "a.vscene");
      EXPECT_EQ(fault_of(packed), "");
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 5'000);
}

std::string fault_after(const std::function<void(PackedScene&)>& change) {
  PackedScene packed = small_packed();
  change(packed);
  return fault_of(packed);
}

/// With another list in the place of one of its own.
template <class Value>
std::string fault_with(std::span<const Value> PackedGeometry::*list, std::vector<Value> other) {
  return fault_after([&](PackedScene& packed) { packed.geometry.*list = other; });
}

TEST(FaultOf, IsNoneOfAWholeScene) {
  EXPECT_EQ(fault_after([](PackedScene&) {}), "");
}

TEST(FaultOf, NamesTrianglesThatCannotBeDrawn) {
  const auto fault = [](const std::function<void(std::vector<Mesh>&)>& change) {
    return fault_after([&](PackedScene& packed) { change(packed.scene.meshes); });
  };
  EXPECT_THAT(fault_with(&PackedGeometry::indices, {0, 3, 2}), HasSubstr("vertex"));
  EXPECT_THAT(fault_with(&PackedGeometry::indices, {}), HasSubstr("triangles"));
  EXPECT_THAT(fault_with(&PackedGeometry::colours, {Rgba8{}}), HasSubstr("vertices"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[0].first_index = 3; }), HasSubstr("triangles"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[0].index_count = 0xfffffffd; }),
              HasSubstr("triangles"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[0].material = -1; }), HasSubstr("material"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[0].made_by = 1; }), HasSubstr("levels"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[0].made_by = -2; }), HasSubstr("levels"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[1].replaced_by = 7; }), HasSubstr("levels"));
  EXPECT_THAT(fault([](auto& meshes) { meshes[1].replaced_by = 0; }),
              HasSubstr("levels"));  // of itself
  EXPECT_THAT(fault_after([](PackedScene& packed) { packed.bounds_in_scene.max().x() = NAN; }),
              HasSubstr("size"));
}

TEST(FaultOf, NamesNodesAndAnimationsThatLeadNowhere) {
  const auto fault = [](const std::function<void(SceneOutline&)>& change) {
    return fault_after([&](PackedScene& packed) { change(packed.scene); });
  };
  EXPECT_THAT(fault([](auto& scene) { scene.nodes[1].parent = 1; }), HasSubstr("parent"));
  EXPECT_THAT(fault([](auto& scene) { scene.nodes[1].meshes = {4}; }), HasSubstr("mesh"));
  EXPECT_THAT(fault([](auto& scene) { scene.animations[0].channels[0].node = 2; }),
              HasSubstr("animation"));
  EXPECT_EQ(fault_of(pack(Scene{})), "there is no node");
}

TEST(FaultOf, NamesTexturesThatAreNotWhole) {
  EXPECT_THAT(fault_after([](PackedScene& packed) { packed.textures[0].width_px = 5; }),
              HasSubstr("texture"));
  EXPECT_THAT(fault_after([](PackedScene& packed) { packed.textures[0].srgb = true; }),
              HasSubstr("texture"));
  EXPECT_THAT(fault_after([](PackedScene& packed) {
                packed.scene.materials[0].texture(TextureRole::base_colour).image = 1;
              }),
              HasSubstr("texture"));
}

TEST(FaultOf, NamesSkinsThatHangOnNothing) {
  const auto fault = [](const std::function<void(std::vector<Joint>&)>& change) {
    return fault_after([&](PackedScene& packed) { change(packed.scene.joints); });
  };
  const Influences sound = small_scene().influences[0];
  Influences nowhere = sound, light = sound;
  nowhere.joints[3] = 2;
  light.weights[0] = 59999;
  EXPECT_THAT(fault([](auto& joints) { joints[1].node = 2; }), HasSubstr("joint"));
  EXPECT_THAT(fault([](auto& joints) { joints[1].joint_from_mesh(0, 3) = NAN; }),
              HasSubstr("joint"));
  EXPECT_THAT(fault([](auto& joints) { joints.resize(kMaxJoints + 1); }), HasSubstr("joints"));
  EXPECT_THAT(fault_with(&PackedGeometry::influences, {sound}), HasSubstr("vertices"));
  EXPECT_THAT(fault_with(&PackedGeometry::influences, {}), HasSubstr("joint"));
  EXPECT_THAT(fault_with(&PackedGeometry::influences, {sound, nowhere, sound}), HasSubstr("joint"));
  EXPECT_THAT(fault_with(&PackedGeometry::influences, {sound, light, sound}), HasSubstr("joint"));
  EXPECT_THAT(fault_after([](PackedScene& packed) { packed.joint_boxes[0][0].joint = 2; }),
              HasSubstr("joint"));
  EXPECT_THAT(fault_after([](PackedScene& packed) { packed.joint_boxes.pop_back(); }),
              HasSubstr("bounded"));
}

}  // namespace
}  // namespace vindu
