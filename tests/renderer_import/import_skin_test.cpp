// Bones of Assimp's meshes: which of them move a vertex by how much, what is left out, and real
// characters of several formats.
#include "renderer/import_skin.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "renderer/import.h"
#include "renderer/skinning.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Weight {
  unsigned vertex;
  float weight;
};

/// A mesh of so many vertices, and its bones; Assimp deletes what it holds.
class BonyMesh {
 public:
  explicit BonyMesh(unsigned vertices) { mesh_.mNumVertices = vertices; }

  BonyMesh& bone(const std::string& name, const std::vector<Weight>& weights, float offset_x = 0) {
    auto* bone = new aiBone;
    bone->mName = name;
    bone->mOffsetMatrix.a4 = offset_x;
    bone->mNumWeights = static_cast<unsigned>(weights.size());
    bone->mWeights = new aiVertexWeight[weights.size()];
    for (std::size_t i = 0; i < weights.size(); ++i)
      bone->mWeights[i] = {weights[i].vertex, weights[i].weight};
    bones_.push_back(bone);
    delete[] mesh_.mBones;
    mesh_.mBones = new aiBone*[bones_.size()];
    std::ranges::copy(bones_, mesh_.mBones);
    mesh_.mNumBones = static_cast<unsigned>(bones_.size());
    return *this;
  }
  const aiMesh& mesh() const { return mesh_; }

 private:
  aiMesh mesh_;
  std::vector<aiBone*> bones_;
};

class ImportSkin : public ::testing::Test {
 protected:
  static constexpr int kMeshNode = 9;

  std::vector<Influences> read(const BonyMesh& mesh) {
    return importer_.read(mesh.mesh(), kMeshNode);
  }
  /// By node, of kFullWeight.
  std::map<int, int> pulls(const Influences& influences) const {
    std::map<int, int> found;
    for (std::size_t i = 0; i < 4; ++i)
      if (influences.weights[i] > 0)
        found[joints_[influences.joints[i]].node] += influences.weights[i];
    return found;
  }
  std::vector<std::string> warnings() const {
    std::vector<std::string> said;
    importer_.warn(said);
    return said;
  }

  std::map<std::string, int> nodes_ = {{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}, {"e", 5}, {"f", 6}};
  std::vector<Joint> joints_;
  SkinImporter importer_{nodes_, joints_};
};

TEST_F(ImportSkin, NormalisesWeightsToTheWholeAndPutsTheStrongestFirst) {
  const auto found = read(BonyMesh(2).bone("a", {{0, 0.5f}, {1, 3}}).bone("b", {{0, 1.5f}}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(pulls(found[0])[1], 0.25 * kFullWeight, 1);
  EXPECT_NEAR(pulls(found[0])[2], 0.75 * kFullWeight, 1);
  EXPECT_GT(found[0].weights[0], found[0].weights[1]);
  EXPECT_EQ(pulls(found[1]), (std::map<int, int>{{1, kFullWeight}}));
  EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(ImportSkin, IsAWholeToTheLastUnitForAnyWeights) {
  for (float a = 0.001f; a < 1; a += 0.013f)
    for (const float b : {1e-30f, 0.1f, 1 / 3.0f, 1e30f}) {
      const auto found =
          read(BonyMesh(1).bone("a", {{0, a}}).bone("b", {{0, b}}).bone("c", {{0, a * b}}));
      int sum = 0;
      for (const std::uint16_t weight : found.at(0).weights) sum += weight;
      ASSERT_EQ(sum, kFullWeight) << a << ' ' << b;
    }
}

TEST_F(ImportSkin, KeepsTheFourStrongest) {
  const auto found = read(BonyMesh(1)
                              .bone("a", {{0, 0.1f}})
                              .bone("b", {{0, 0.3f}})
                              .bone("c", {{0, 0.05f}})
                              .bone("d", {{0, 0.2f}})
                              .bone("e", {{0, 0.15f}})
                              .bone("f", {{0, 0.2f}}));
  const double sum = 0.3 + 0.2 + 0.2 + 0.15;
  const auto kept = pulls(found.at(0));
  ASSERT_THAT(kept, ElementsAre(::testing::Key(2), ::testing::Key(4), ::testing::Key(5),
                                ::testing::Key(6)));
  EXPECT_NEAR(kept.at(2), 0.3 / sum * kFullWeight, 4);
  EXPECT_NEAR(kept.at(5), 0.15 / sum * kFullWeight, 4);
  EXPECT_THAT(warnings(), Contains(HasSubstr("1 vertices follow more than four bones")));
}

TEST_F(ImportSkin, LeavesOutWeightsThatAreNone) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinite = std::numeric_limits<float>::infinity();
  const auto found = read(BonyMesh(1)
                              .bone("a", {{0, nan}, {0, infinite}, {0, -1}, {7, 1}})
                              .bone("b", {{0, 0.5f}})
                              .bone("c", {{0, 0}}));
  EXPECT_EQ(pulls(found.at(0)), (std::map<int, int>{{2, kFullWeight}}));
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("4 weights of bones")));
}

TEST_F(ImportSkin, LeavesOutBonesThatNameNoNodeOrStandNowhere) {
  const auto found = read(BonyMesh(1)
                              .bone("ghost", {{0, 0.9f}})
                              .bone("a", {{0, 0.9f}}, std::nanf(""))
                              .bone("b", {{0, 0.1f}}));
  EXPECT_EQ(pulls(found.at(0)), (std::map<int, int>{{2, kFullWeight}}));
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("2 bones name no node")));
}

TEST_F(ImportSkin, HangsVerticesThatNoBoneMovesOnTheMeshsNode) {
  const auto found = read(BonyMesh(2).bone("a", {{0, 1}}, 5));
  EXPECT_EQ(pulls(found.at(1)), (std::map<int, int>{{kMeshNode, kFullWeight}}));
  EXPECT_TRUE(joints_[found[1].joints[0]].joint_from_mesh.isIdentity());
}

TEST_F(ImportSkin, IsNoneWhereNoBoneMovesAnything) {
  EXPECT_THAT(read(BonyMesh(3)), IsEmpty());
  EXPECT_THAT(read(BonyMesh(3).bone("ghost", {{0, 1}}).bone("a", {{1, 0}})), IsEmpty());
}

TEST_F(ImportSkin, SharesTheJointsOfMeshesThatAreBoundAlike) {
  read(BonyMesh(1).bone("a", {{0, 1}}, 2).bone("b", {{0, 1}}, 3));
  read(BonyMesh(1).bone("b", {{0, 1}}, 3).bone("a", {{0, 1}}, 4));
  ASSERT_EQ(joints_.size(), 3u);
  EXPECT_EQ(joints_[1].node, 2);
  EXPECT_EQ(joints_[1].joint_from_mesh(0, 3), 3);
}

TEST_F(ImportSkin, LeavesAMeshStillForWhichThereIsNoRoom) {
  joints_.resize(kMaxJoints - 1);
  EXPECT_EQ(read(BonyMesh(1).bone("a", {{0, 1}})).size(), 1u);
  EXPECT_THAT(read(BonyMesh(1).bone("b", {{0, 1}})), IsEmpty());
  EXPECT_EQ(joints_.size(), kMaxJoints);
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("1 meshes stand still")));
}

/// Of all vertices of skinned meshes at a time of a clip.
Box3f posed_bounds(const Scene& scene, double time_s, int clip = 0) {
  const auto joints = joint_transforms(scene.joints, node_transforms(scene, time_s, clip));
  Box3f bounds;
  for (const Mesh& mesh : scene.meshes)
    for (std::uint32_t i = 0; mesh.skinned && i < mesh.index_count; ++i) {
      const std::uint32_t vertex = scene.indices[mesh.first_index + i];
      bounds.extend(
          skinned(scene.vertices[vertex].position_in_node, scene.influences[vertex], joints));
    }
  return bounds;
}

// The example of the glTF tutorial: the strip's upper half turns by a quarter to the one side and
// back and to the other.
TEST(SkinnedModels, GltfsSimpleSkinTurnsItsUpperHalf) {
  const ImportResult result = import_scene(test::test_model("glTF2/simple_skin/simple_skin.gltf"));
  const Scene& scene = result.scene;
  EXPECT_THAT(result.warnings, IsEmpty());
  ASSERT_TRUE(scene.meshes.at(0).skinned);
  EXPECT_EQ(scene.influences.size(), scene.vertices.size());
  EXPECT_NEAR(posed_bounds(scene, 0).max().y(), 2, 1e-4);  // straight up
  const Box3f aside = posed_bounds(scene, 1.0), other = posed_bounds(scene, 4.0);
  EXPECT_NEAR(aside.max().y(), 1.5, 1e-3);  // a half of it lies on its side
  EXPECT_NEAR(other.max().y(), 1.5, 1e-3);
  EXPECT_NEAR(aside.min().x(), -1, 1e-3);
  EXPECT_NEAR(other.max().x(), 1, 1e-3);
}

// Each format's character stays in one piece and of its own size while it plays.
TEST(SkinnedModels, OfSeveralFormatsMoveAndStayInOnePiece) {
  for (const char* file : {"X/Testwuson.X", "X/BCN_Epileptic.X", "FBX/huesitos.fbx",
                           "FBX/animation_with_skeleton.fbx", "Collada/box_nested_animation.dae"}) {
    const Scene scene = import_scene(test::test_model(file)).scene;
    ASSERT_FALSE(scene.influences.empty()) << file;
    ASSERT_FALSE(scene.animations.empty()) << file;
    const Box3f start = posed_bounds(scene, 0);
    bool moves = false;
    for (int clip = 0; clip < static_cast<int>(scene.animations.size()); ++clip)
      for (int step = 0; step < 10; ++step) {
        const double time_s = scene.animations[clip].duration_s * step / 10;
        const Box3f bounds = posed_bounds(scene, time_s, clip);
        EXPECT_LT(bounds.diagonal().norm(), 3 * start.diagonal().norm()) << file;
        EXPECT_GT(bounds.diagonal().norm(), 0.3f * start.diagonal().norm()) << file;
        moves = moves || !bounds.isApprox(start, 1e-3f);
      }
    EXPECT_TRUE(moves) << file;
  }
}

// Assimp 5.2 lists Half-Life's bones as children of one node.
TEST(SkinnedModels, OfHalfLifeStandAsTheyWereBound) {
  const Scene scene = import_scene(test::test_model("MDL/MDL (HL1)/unnamed_bones.mdl")).scene;
  Box3f bound;
  const Eigen::Affine3f scene_from_root(scene.nodes[0].parent_from_node);
  for (const Vertex& vertex : scene.vertices)
    bound.extend(scene_from_root * vertex.position_in_node);
  EXPECT_TRUE(bounds_in_scene(scene).isApprox(bound, 1e-3f));
}

TEST(SkinnedModels, HaveWholeWeightsAndKnownJointsThroughout) {
  for (const char* file : {"X/Testwuson.X", "X/anim_test.x", "FBX/animation_with_skeleton.fbx",
                           "MD5/SimpleCube.md5mesh"}) {
    const Scene scene = import_scene(test::test_model(file)).scene;
    ASSERT_EQ(scene.influences.size(), scene.vertices.size()) << file;
    for (const Influences& influences : scene.influences) {
      int sum = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        sum += influences.weights[i];
        ASSERT_LT(influences.joints[i], scene.joints.size());
      }
      ASSERT_EQ(sum, kFullWeight);
    }
  }
}

}  // namespace
}  // namespace vindu
