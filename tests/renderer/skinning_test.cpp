// Where bones put vertices, by numbers: the blend, boxes that hold any pose, and meshes that are
// cut to pieces.
#include "renderer/skinning.h"

#include <gmock/gmock.h>

#include <random>

#include "renderer/chunks.h"
#include "tests/renderer/skinned_scenes.h"

namespace vindu {
namespace {

using namespace testing;

TEST(Skinned, IsBetweenWhereItsJointsPutIt) {
  const std::vector<Eigen::Matrix4f> joints = {moved_by(1, 0, 0),
                                               moved_by(0, 2, 0) * scaled_by(2, 2, 2)};
  const Eigen::Vector3f whole = skinned({1, 1, 1}, {{1}, {kFullWeight}}, joints);
  EXPECT_EQ(whole, Eigen::Vector3f(2, 4, 2));
  const Eigen::Vector3f quarter = skinned({1, 1, 1}, two_joints(0, 1, 0.75f), joints);
  EXPECT_TRUE(quarter.isApprox(Eigen::Vector3f(2, 1.75f, 1.25f), 1e-4f)) << quarter.transpose();
}

TEST(JointTransforms, TakeTheMeshToItsJointAndTheJointToTheWorld) {
  const Scene stalk = stalk_scene({});
  const auto joints = joint_transforms(stalk.joints, node_transforms(stalk, 0, -1));
  for (const Eigen::Matrix4f& world_from_mesh : joints)  // at rest as it was bound
    EXPECT_TRUE(world_from_mesh.isIdentity(1e-6f));
  const auto lifted = joint_transforms(stalk.joints, node_transforms(stalk, 0.5, 1));
  for (const Eigen::Matrix4f& world_from_mesh : lifted)
    EXPECT_TRUE(world_from_mesh.isApprox(moved_by(0, 0.25f, 0), 1e-6f));
}

TEST(BoundsInScene, OfASkinnedMeshAreWhereItsJointsAre) {
  const Box3f bounds = bounds_in_scene(stalk_scene({}));
  EXPECT_TRUE(bounds.isApprox(
      Box3f(Eigen::Vector3f(-0.15f, -0.8f, -0.15f), Eigen::Vector3f(0.15f, 0.4f, 0.15f)), 1e-5f));
}

/// Around the boxes, each moved by its joint.
Box3f around(const std::vector<JointBox>& boxes, const std::vector<Eigen::Matrix4f>& joints) {
  Box3f bounds;
  for (const JointBox& box : boxes)
    bounds.extend(moved(box.box_in_mesh, joints[static_cast<std::size_t>(box.joint)]));
  return bounds;
}

TEST(JointBoxes, HoldEveryVertexAtAnyTime) {
  Scene stalk = stalk_scene({});
  cut_into_chunks(stalk, 30);
  ASSERT_GT(stalk.meshes.size(), 4u);
  for (const Mesh& mesh : stalk.meshes) {
    const std::vector<JointBox> boxes = joint_boxes(stalk, mesh);
    for (double t_s = 0; t_s < 2; t_s += 0.05) {
      const auto joints = joint_transforms(stalk.joints, node_transforms(stalk, t_s));
      const Box3f bounds = around(boxes, joints);
      const Box3f with_rounding(bounds.min().array() - 1e-5f, bounds.max().array() + 1e-5f);
      for (std::uint32_t i = mesh.first_index; i < mesh.first_index + mesh.index_count; ++i) {
        const std::uint32_t vertex = stalk.indices[i];
        ASSERT_TRUE(with_rounding.contains(
            skinned(stalk.vertices[vertex].position_in_node, stalk.influences[vertex], joints)))
            << t_s;
      }
    }
  }
}

TEST(JointBoxes, HoldEveryVertexHoweverWildTheJoints) {
  std::mt19937 random(4);
  std::normal_distribution<float> some;
  const Scene stalk = stalk_scene({});
  const std::vector<JointBox> boxes = joint_boxes(stalk, stalk.meshes[0]);
  for (int pose = 0; pose < 200; ++pose) {
    std::vector<Eigen::Matrix4f> joints(2, Eigen::Matrix4f::Identity());
    for (Eigen::Matrix4f& joint : joints)
      joint.topRows<3>() = joint.topRows<3>().unaryExpr([&](float) { return some(random); });
    const Box3f bounds = around(boxes, joints);
    const Box3f with_rounding(bounds.min().array() - 1e-5f, bounds.max().array() + 1e-5f);
    for (std::size_t v = 0; v < stalk.vertices.size(); ++v)
      ASSERT_TRUE(with_rounding.contains(
          skinned(stalk.vertices[v].position_in_node, stalk.influences[v], joints)));
  }
}

TEST(JointBoxes, LeaveOutJointsThatMoveNothing) {
  const Scene stalk = stalk_scene({});
  Mesh foot = stalk.meshes[0];
  foot.index_count = 6;  // of its lowest ring
  const std::vector<JointBox> boxes = joint_boxes(stalk, foot);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].joint, 0);
}

TEST(Chunks, KeepJointsWithTheirVertices) {
  const Scene whole = stalk_scene({});
  Scene cut = whole;
  cut_into_chunks(cut, 20);
  ASSERT_EQ(cut.influences.size(), cut.vertices.size());
  for (const Mesh& mesh : cut.meshes) EXPECT_TRUE(mesh.skinned);
  for (std::size_t v = 0; v < cut.vertices.size(); ++v) {
    const auto same = std::ranges::find_if(whole.vertices, [&](const Vertex& vertex) {
      return vertex.position_in_node == cut.vertices[v].position_in_node &&
             vertex.uv == cut.vertices[v].uv;
    });
    ASSERT_NE(same, whole.vertices.end());
    const auto at = static_cast<std::size_t>(same - whole.vertices.begin());
    EXPECT_EQ(cut.influences[v].weights, whole.influences[at].weights);
  }
}

}  // namespace
}  // namespace vindu
