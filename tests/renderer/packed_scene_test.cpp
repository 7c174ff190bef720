// What of a scene the GPU gets: exact where it counts, small where it does not.
#include "renderer/packed_scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "renderer/mipmaps.h"
#include "tests/renderer/skinned_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

double degrees_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3d x = a.cast<double>(), y = b.cast<double>();
  return std::atan2(x.cross(y).norm(), x.dot(y)) * 180 / M_PI;
}

TEST(PackedDirection, IsWithinAFewThousandthsOfADegree) {
  std::mt19937 random(3);
  std::normal_distribution<float> any;
  for (int i = 0; i < 100'000; ++i) {
    const Eigen::Vector3f direction(any(random), any(random), any(random));
    EXPECT_LT(degrees_between(unpack_direction(pack_direction(direction)), direction), 0.004);
  }
}

TEST(PackedDirection, IsExactAlongTheAxes) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      const Eigen::Vector3f direction = sign * Eigen::Vector3f::Unit(axis);
      EXPECT_EQ(unpack_direction(pack_direction(3 * direction)), direction);
    }
}

TEST(PackedDirection, OfNoLengthIsTowardsTheViewer) {
  EXPECT_EQ(unpack_direction(pack_direction(Eigen::Vector3f::Zero())), Eigen::Vector3f::UnitZ());
}

TEST(Pack, KeepsOnlyWhatMaterialsAskFor) {
  const PackedScene plain_square = pack(square_scene(plain(1, 0, 0)));
  EXPECT_THAT(plain_square.geometry.vertices, SizeIs(4));
  EXPECT_THAT(plain_square.geometry.uvs, IsEmpty());
  EXPECT_THAT(plain_square.geometry.colours, IsEmpty());
  EXPECT_THAT(plain_square.geometry.details, IsEmpty());
  Scene scene = square_scene(plain(1, 0, 0));
  scene.textures = {Image::filled(4, 4, {1, 2, 3, 4}), Image::filled(2, 2, {})};
  scene.materials[0].unlit = false;
  scene.materials[0].texture(TextureRole::normal).image = 0;
  scene.vertices[0].colour = {1, 2, 3, 255};
  const PackedScene packed = pack(scene);
  EXPECT_THAT(packed.geometry.uvs, SizeIs(4));
  EXPECT_THAT(packed.geometry.colours, SizeIs(4));
  EXPECT_THAT(packed.geometry.details, SizeIs(4));
  ASSERT_THAT(packed.textures, SizeIs(1));
  EXPECT_EQ(packed.textures[0].image, 0);
}

TEST(Pack, KeepsAPictureTwiceThatIsBothColourAndNot) {
  Scene scene = square_scene(Material{});
  scene.textures = {Image::filled(4, 4, {1, 2, 3, 4})};
  scene.materials[0].texture(TextureRole::base_colour).image = 0;
  scene.materials[0].texture(TextureRole::occlusion).image = 0;
  const PackedScene packed = pack(scene);
  ASSERT_THAT(packed.textures, SizeIs(2));
  EXPECT_NE(packed.textures[0].srgb, packed.textures[1].srgb);
}

TEST(Pack, SaysHowLargeTheSceneIsAndWhatItsJointsMove) {
  const Scene scene = stalk_scene(plain(1, 1, 1));
  const PackedScene packed = pack(scene);
  EXPECT_EQ(packed.bounds_in_scene.min(), bounds_in_scene(scene).min());
  EXPECT_EQ(packed.bounds_in_scene.max(), bounds_in_scene(scene).max());
  ASSERT_EQ(packed.joint_boxes.size(), scene.meshes.size());
  EXPECT_EQ(packed.joint_boxes[0].size(), joint_boxes(scene, scene.meshes[0]).size());
  EXPECT_EQ(fault_of(packed), "");
}

TEST(Mipmaps, HalveEachSideDownToOnePixel) {
  EXPECT_EQ(mipmap_pixels({5, 3}), 5u * 3 + 2 * 1 + 1 * 1);
  EXPECT_EQ(mipmap_pixels({1, 1}), 1u);
  EXPECT_EQ(mipmap_pixels({1, 4}), 4u + 2 + 1);
  const auto pixels = mipmaps_of(Image::filled(5, 3, {10, 20, 30, 40}), true);
  EXPECT_EQ(pixels.size(), mipmap_pixels({5, 3}));
  EXPECT_THAT(pixels, Each(Rgba8{10, 20, 30, 40}));
}

/// Black and white dots of a colour are half as much light: 188 of 255 in sRGB (IEC 61966-2-1).
TEST(Mipmaps, AverageColoursAsLightAndAllElseAsNumbers) {
  Image dots = Image::filled(2, 2, {0, 0, 0, 255});
  dots.at(0, 0) = dots.at(1, 1) = {255, 255, 255, 255};
  EXPECT_EQ(mipmaps_of(dots, true).back(), (Rgba8{188, 188, 188, 255}));
  EXPECT_EQ(mipmaps_of(dots, false).back(), (Rgba8{128, 128, 128, 255}));
}

TEST(Mipmaps, OfAHoleKeepTheColourOfItsRim) {
  Image leaf = Image::filled(2, 1, {0, 255, 0, 255});
  leaf.at(1, 0) = {255, 0, 255, 0};
  EXPECT_EQ(mipmaps_of(leaf, true).back(), (Rgba8{0, 255, 0, 128}));
}

}  // namespace
}  // namespace vindu
