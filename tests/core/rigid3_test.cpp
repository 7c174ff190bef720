// Rigid transforms and the thesis' angles.
#include "core/rigid3.h"

#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearMatrix;
using testing::IsNearPoint;
using testing::IsNearRigid;
using testing::Random;

TEST(Rigid3, ComposesAsAdjacentFramesMeet) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 room_from_head = random.rigid(), head_from_led = random.rigid();
    const Vec3 x_in_led = random.vector(2);
    EXPECT_THAT((room_from_head * head_from_led) * x_in_led,
                IsNearPoint(room_from_head * (head_from_led * x_in_led), 1e-12));
  }
}

TEST(Rigid3, InverseUndoes) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 room_from_head = random.rigid();
    EXPECT_THAT(inverse(room_from_head) * room_from_head, IsNearRigid(Rigid3{}, 1e-12));
    EXPECT_THAT(room_from_head * inverse(room_from_head), IsNearRigid(Rigid3{}, 1e-12));
  }
}

TEST(Rigid3, MatrixMapsPointsAsTheTransformDoes) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 wall_from_scene = random.rigid();
    const Vec3 x_in_scene = random.vector(2);
    const double scale = random.between(0.1, 10);
    const Vec4 mapped = matrix_of(wall_from_scene, scale) * x_in_scene.homogeneous();
    EXPECT_THAT(mapped.head<3>(), IsNearPoint(wall_from_scene * (scale * x_in_scene), 1e-12));
    EXPECT_DOUBLE_EQ(mapped.w(), 1);
  }
}

TEST(Rigid3, InterpolatesFromEndToEndAtConstantSpeed) {
  const Rigid3 from{Quat(Eigen::AngleAxisd(0.2, Vec3::UnitY())), {1, 0, 0}};
  const Rigid3 to{Quat(Eigen::AngleAxisd(1.0, Vec3::UnitY())), {3, 2, 0}};
  EXPECT_THAT(interpolate(from, to, 0), IsNearRigid(from, 1e-15));
  EXPECT_THAT(interpolate(from, to, 1), IsNearRigid(to, 1e-15));
  const Rigid3 quarter{Quat(Eigen::AngleAxisd(0.4, Vec3::UnitY())), {1.5, 0.5, 0}};
  EXPECT_THAT(interpolate(from, to, 0.25), IsNearRigid(quarter, 1e-12));
}

TEST(Rigid3, InterpolatesTheShortWayWhateverTheQuaternionsSign) {
  const Quat turned(Eigen::AngleAxisd(0.6, Vec3::UnitX()));
  const Rigid3 to{Quat(-turned.coeffs()), Vec3::Zero()};
  const Rigid3 half{Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX())), Vec3::Zero()};
  EXPECT_THAT(interpolate(Rigid3{}, to, 0.5), IsNearRigid(half, 1e-12));
}

TEST(Rigid3, FromAMatrixIsThatRotation) {
  Random random(4);
  const Mat3 rotation = random.rotation().toRotationMatrix();
  EXPECT_THAT(Rigid3::from(rotation, Vec3::Zero()).rotation.toRotationMatrix(),
              IsNearMatrix(rotation, 1e-14));
}

TEST(ThesisWorld, IsRightHandedWithUpAndIntoTheWallAsInRoom) {
  const Mat3 rotation = room_from_thesis_world();
  EXPECT_DOUBLE_EQ(rotation.determinant(), 1);
  EXPECT_THAT(rotation * Vec3::UnitX(), IsNearPoint(Vec3(1, 0, 0), 0));
  EXPECT_THAT(rotation * Vec3::UnitZ(), IsNearPoint(Vec3(0, 1, 0), 0));   // up
  EXPECT_THAT(rotation * Vec3::UnitY(), IsNearPoint(Vec3(0, 0, -1), 0));  // into the wall
}

// Thesis 3.4: about Z, then the turned X, then the twice turned Y. A quarter turn about Z carries x
// to y; the X axis that pitch turns about is then the world's y.
TEST(ThesisRotation, TurnsAboutTheAxesThatTurnWithIt) {
  const double quarter = radians(90);
  EXPECT_THAT(thesis_rotation(quarter, 0, 0) * Vec3::UnitX(), IsNearPoint(Vec3(0, 1, 0), 1e-15));
  EXPECT_THAT(thesis_rotation(quarter, quarter, 0) * Vec3::UnitX(),
              IsNearPoint(Vec3(0, 1, 0), 1e-15));
  EXPECT_THAT(thesis_rotation(quarter, quarter, 0) * Vec3::UnitZ(),
              IsNearPoint(Vec3(1, 0, 0), 1e-15));
  EXPECT_THAT(thesis_rotation(quarter, quarter, quarter) * Vec3::UnitY(),
              IsNearPoint(Vec3(0, 0, 1), 1e-15));
}

TEST(Angles, ConvertBothWays) {
  EXPECT_DOUBLE_EQ(radians(180), kPi);
  EXPECT_DOUBLE_EQ(degrees(radians(-37)), -37);
}

TEST(Matchers, TakeNaNForAFailure) {
  const Vec3 nowhere(std::nan(""), 0, 0);
  const Rigid3 lost{Quat::Identity(), nowhere};
  const Mat3 nothing = Mat3::Constant(std::nan(""));
  EXPECT_THAT(nowhere, ::testing::Not(IsNearPoint(Vec3::Zero(), 1e9)));
  EXPECT_THAT(lost, ::testing::Not(IsNearRigid(Rigid3{}, 1e9)));
  EXPECT_THAT(nothing, ::testing::Not(IsNearMatrix(Mat3::Identity().eval(), 1e9)));
}

}  // namespace
}  // namespace vindu
