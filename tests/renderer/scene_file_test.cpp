// Packed scenes: what is written comes back, and what is damaged does not.
#include "renderer/scene_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "core/error.h"

namespace vindu {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

PackedScene small_scene() {
  PackedScene packed;
  packed.sources = {{"/models/a.obj", 120, std::string(64, 'a')}};
  packed.imported.warnings = {"a texture is not there"};
  Scene& scene = packed.imported.scene;
  scene.name = "a";
  scene.vertices.resize(3);
  scene.vertices[1].position_in_node = {1, 2, 3};
  scene.vertices[2].colour = {1, 2, 3, 4};
  scene.indices = {0, 1, 2};
  scene.meshes = {{0, 3, 0, Box3f(Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 2, 3)), true}};
  scene.skin.joints.resize(2);
  scene.skin.joints[1] = {1, 2 * Eigen::Matrix4f::Identity()};
  scene.skin.influences.assign(3, {{1, 0, 0, 0}, {60000, kFullWeight - 60000, 0, 0}});
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
    write_scene_file(small_scene(), file_);
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
  const PackedScene packed = read_scene_file(file_);
  EXPECT_EQ(packed.sources[0].path, "/models/a.obj");
  EXPECT_EQ(packed.sources[0].bytes, 120u);
  EXPECT_EQ(packed.imported.warnings, small_scene().imported.warnings);
  const Scene& scene = packed.imported.scene;
  EXPECT_EQ(scene.vertices[1].position_in_node, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(scene.vertices[2].colour, (Rgba8{1, 2, 3, 4}));
  EXPECT_EQ(scene.textures[0], small_scene().imported.scene.textures[0]);
  EXPECT_EQ(scene.materials[0].texture(TextureRole::normal).wrap_v, Wrap::clamp);
  EXPECT_TRUE(scene.materials[0].double_sided);
  EXPECT_EQ(scene.nodes[1].parent, 0);
  EXPECT_TRUE(scene.meshes[0].skinned);
  EXPECT_EQ(scene.skin.joints[1].node, 1);
  EXPECT_EQ(scene.skin.joints[1].joint_from_mesh, 2 * Eigen::Matrix4f::Identity());
  EXPECT_EQ(scene.skin.influences[2].weights[0], 60000);
  EXPECT_EQ(scene.meshes[0].replaced_by, 0);
  EXPECT_EQ(scene.meshes[1].made_by, 0);
  EXPECT_EQ(scene.coarsenings[0].error_in_node, 0.5f);
  EXPECT_EQ(scene.coarsenings[0].bounds_in_node.max(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(scene.animations[0].channels[0].rotations[0].value.x(), 1);
  EXPECT_EQ(scene.colours, ColourCoding::srgb);
  EXPECT_EQ(scene.metres_per_unit, 0.01);
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
  EXPECT_THROW(write_scene_file(small_scene(), folder_ + "/none/a.vscene"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST(FaultOf, NamesWhatCannotBeDrawn) {
  const auto fault_after = [](auto change) {
    Scene scene = small_scene().imported.scene;
    change(scene);
    return fault_of(scene);
  };
  EXPECT_EQ(fault_after([](Scene&) {}), "");
  EXPECT_THAT(fault_after([](Scene& scene) { scene.indices[1] = 3; }), HasSubstr("vertex"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[0].first_index = 3; }),
              HasSubstr("triangles"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[0].index_count = 0xfffffffd; }),
              HasSubstr("triangles"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[0].material = -1; }),
              HasSubstr("material"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[0].made_by = 1; }), HasSubstr("levels"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[0].made_by = -2; }), HasSubstr("levels"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[1].replaced_by = 7; }),
              HasSubstr("levels"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.meshes[1].replaced_by = 0; }),
              HasSubstr("levels"));  // of itself
  EXPECT_THAT(fault_after([](Scene& scene) { scene.nodes[1].parent = 1; }), HasSubstr("parent"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.nodes[1].meshes = {4}; }), HasSubstr("mesh"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.textures[0].width_px = 5; }),
              HasSubstr("texture"));
  EXPECT_THAT(fault_after([](Scene& scene) {
                scene.materials[0].texture(TextureRole::base_colour).image = 1;
              }),
              HasSubstr("texture"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.animations[0].channels[0].node = 2; }),
              HasSubstr("animation"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.joints[1].node = 2; }), HasSubstr("joint"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.joints[1].joint_from_mesh(0, 3) = NAN; }),
              HasSubstr("joint"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.joints.resize(kMaxJoints + 1); }),
              HasSubstr("joints"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.influences.pop_back(); }),
              HasSubstr("joints"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.influences.clear(); }), HasSubstr("joint"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.influences[1].joints[3] = 2; }),
              HasSubstr("joint"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.skin.influences[1].weights[0] = 59999; }),
              HasSubstr("joint"));
  EXPECT_THAT(fault_after([](Scene& scene) { scene.nodes.clear(); }), HasSubstr("node"));
}

}  // namespace
}  // namespace vindu
