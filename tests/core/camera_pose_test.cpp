// Where a camera of the site stands and looks: by a target, or by the thesis' angles.
#include "core/site.h"
#include "tests/core/matchers.h"
#include "tests/core/random_walls.h"

namespace vindu {
namespace {

using testing::IsNearPoint;
using testing::IsNearRotation;
using testing::Random;

Vec3 forward_of(const Rigid3& room_from_camera) {
  return room_from_camera.rotation * Vec3::UnitZ();
}
Vec3 right_of(const Rigid3& room_from_camera) { return room_from_camera.rotation * Vec3::UnitX(); }
Vec3 up_of(const Rigid3& room_from_camera) { return room_from_camera.rotation * -Vec3::UnitY(); }

TEST(LookAt, PutsTheTargetOnTheOpticalAxisAndTheImageUpright) {
  Random random(51);
  for (int i = 0; i < 100; ++i) {
    const Vec3 position = random.vector(5), target = random.vector(5);
    const Rigid3 room_from_camera = look_at(position, target);
    const Vec3 target_in_camera = inverse(room_from_camera) * target;
    EXPECT_THAT(target_in_camera, IsNearPoint(Vec3(0, 0, (target - position).norm()), 1e-12));
    EXPECT_NEAR(right_of(room_from_camera).y(), 0, 1e-12);
    EXPECT_GT(up_of(room_from_camera).y(), 0);
  }
}

TEST(LookAt, SeesTheRoomsRightOnItsRightWhenItFacesTheWall) {
  const Rigid3 room_from_camera = look_at({0, 1, 5}, {0, 1, 0});
  EXPECT_THAT(right_of(room_from_camera), IsNearPoint(Vec3(1, 0, 0), 1e-12));
  EXPECT_THAT(up_of(room_from_camera), IsNearPoint(Vec3(0, 1, 0), 1e-12));
}

TEST(LookAt, StraightUpOrDownSeesAsSomebodyWhoFacesTheWall) {
  const Rigid3 down = look_at({1, 3, 1}, {1, 0, 1}), up = look_at({1, 0, 1}, {1, 3, 1});
  EXPECT_THAT(forward_of(down), IsNearPoint(Vec3(0, -1, 0), 1e-12));
  EXPECT_THAT(right_of(down), IsNearPoint(Vec3(1, 0, 0), 1e-12));
  EXPECT_THAT(forward_of(up), IsNearPoint(Vec3(0, 1, 0), 1e-12));
  EXPECT_THAT(right_of(up), IsNearPoint(Vec3(1, 0, 0), 1e-12));
}

TEST(ThesisAngles, PitchNinetyLooksHorizontallyIntoTheWall) {
  const Rigid3 camera = camera_from_thesis_angles({0, 1, 4}, 0, radians(90), 0);
  EXPECT_THAT(forward_of(camera), IsNearPoint(Vec3(0, 0, -1), 1e-12));
  EXPECT_THAT(up_of(camera), IsNearPoint(Vec3(0, 1, 0), 1e-12));
  EXPECT_THAT(camera.translation, IsNearPoint(Vec3(0, 1, 4), 0));
}

TEST(ThesisAngles, PitchZeroLooksAtTheFloor) {
  EXPECT_THAT(forward_of(camera_from_thesis_angles(Vec3::Zero(), 0, 0, 0)),
              IsNearPoint(Vec3(0, -1, 0), 1e-12));
}

// Thesis figure 3.9: the camera at the back on the left, (-2.15, -4.60, 1.09) in the thesis' world,
// heading -37 degrees, looks to the right, into the room.
TEST(ThesisAngles, OfFigureThreeNineLookIntoTheRoom) {
  const Vec3 position_in_room = room_from_thesis_world() * Vec3(-2.15, -4.60, 1.09);
  EXPECT_THAT(position_in_room, IsNearPoint(Vec3(-2.15, 1.09, 4.60), 1e-12));
  const Rigid3 camera =
      camera_from_thesis_angles(position_in_room, radians(-37), radians(90), radians(0));
  EXPECT_THAT(forward_of(camera),
              IsNearPoint(Vec3(std::sin(radians(37)), 0, -std::cos(radians(37))), 1e-12));
  EXPECT_THAT(up_of(camera), IsNearPoint(Vec3(0, 1, 0), 1e-12));
}

// Roll turns about the twice turned Y, which at pitch 90 is the camera's up: it is a pan.
TEST(ThesisAngles, RollAtPitchNinetyTurnsAboutTheCamerasOwnUp) {
  const Rigid3 camera = camera_from_thesis_angles(Vec3::Zero(), 0, radians(90), radians(20));
  EXPECT_THAT(up_of(camera), IsNearPoint(Vec3(0, 1, 0), 1e-12));
  EXPECT_NEAR(degrees(std::acos(forward_of(camera).dot(Vec3(0, 0, -1)))), 20, 1e-9);
}

TEST(ThesisAngles, AgreeWithLookingAtAPoint) {
  Random random(52);
  for (int i = 0; i < 50; ++i) {
    const double heading = random.between(-3, 3), pitch = random.between(0.1, 3.0);
    const Rigid3 by_angles = camera_from_thesis_angles({1, 2, 3}, heading, pitch, 0);
    const Rigid3 by_target = look_at({1, 2, 3}, Vec3(1, 2, 3) + forward_of(by_angles));
    EXPECT_THAT(by_angles.rotation, IsNearRotation(by_target.rotation, 1e-9));
  }
}

}  // namespace
}  // namespace vindu
