// The camera logic of the emulated Wiimote: what the sensitivity does to size, place and choice.
#include "tracker/wiimote/emulator_camera.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::Eq;
using ::testing::Optional;

constexpr double kFrom3m = 1.0 / 9;

struct Sensitivity {
  std::array<std::uint8_t, 9> block_1;
  std::array<std::uint8_t, 2> block_2;
};
constexpr Sensitivity kLevel1 = {{2, 0, 0, 0x71, 1, 0, 0x64, 0, 0xfe}, {0xfd, 5}};
constexpr Sensitivity kLevel3 = {{2, 0, 0, 0x71, 1, 0, 0xaa, 0, 0x64}, {0x63, 3}};
constexpr Sensitivity kLevel4 = {{2, 0, 0, 0x71, 1, 0, 0xc8, 0, 0x36}, {0x35, 3}};
constexpr Sensitivity kLevel5 = {{7, 0, 0, 0x71, 1, 0, 0x72, 0, 0x20}, {0x1f, 3}};
constexpr Sensitivity kMarcan = {{0, 0, 0, 0, 0, 0, 0x90, 0, 0xc0}, {0x40, 0}};
constexpr Sensitivity kMaximum = {{0, 0, 0, 0, 0, 0, 0xff, 0, 0x0c}, {0, 0}};

EmulatedCamera camera_with(const Sensitivity& sensitivity) {
  EmulatedCamera camera;
  camera.set_power(true);
  camera.write(0x00, sensitivity.block_1);
  camera.write(0x1a, sensitivity.block_2);
  return camera;
}

std::optional<SensorDot> dot_of(const Sensitivity& sensitivity, const SensorSpot& spot) {
  return camera_with(sensitivity).track(std::array{spot})[0];
}

/// All of whose light is that of a cluster 3 m away.
std::vector<SensorSpot> spots_at(std::initializer_list<std::array<double, 2>> places) {
  std::vector<SensorSpot> spots;
  for (const auto& [x_px, y_px] : places) spots.push_back({x_px, y_px, kFrom3m});
  return spots;
}

TEST(EmulatedCamera, shows_a_cluster_at_3_m_with_size_3_at_levels_3_and_4_and_larger_at_more_gain) {
  EXPECT_EQ(dot_of(kLevel3, {100, 100, kFrom3m})->size, 3);
  EXPECT_EQ(dot_of(kLevel4, {100, 100, kFrom3m})->size, 3);
  EXPECT_EQ(dot_of(kMaximum, {100, 100, kFrom3m})->size, 4);
}

TEST(EmulatedCamera, rounds_places_to_whole_units) {
  EXPECT_THAT(dot_of(kLevel4, {100.4, 200.6, kFrom3m}), Optional(SensorDot{100, 201, 3}));
  EXPECT_THAT(dot_of(kLevel4, {-0.4, 767.4, kFrom3m}), Optional(SensorDot{0, 767, 3}));
  EXPECT_THAT(dot_of(kLevel4, {1023.6, 100, kFrom3m}), Eq(std::nullopt));
}

TEST(EmulatedCamera, falls_back_to_the_grid_of_its_pixels_when_it_gets_too_little_light) {
  const SensorSpot faint{101.9, 207.9, 1.0 / 25};
  EXPECT_THAT(dot_of(kLevel4, faint), Optional(SensorDot{102, 208, 2}));
  EXPECT_THAT(dot_of(kMarcan, faint), Optional(SensorDot{100, 204, 1}));  // in steps of 8
}

TEST(EmulatedCamera, drops_blobs_that_are_smaller_than_the_block_allows) {
  const SensorSpot faint{100, 100, 1.0 / 20};
  EXPECT_TRUE(dot_of(kMarcan, faint));
  EXPECT_FALSE(dot_of(kLevel1, faint));
}

TEST(EmulatedCamera, drops_blobs_that_are_larger_than_the_block_allows) {
  const SensorSpot lamp{100, 100, 2.5};
  EXPECT_TRUE(dot_of(kLevel4, lamp));
  EXPECT_FALSE(dot_of(kLevel5, lamp));
}

TEST(EmulatedCamera, keeps_each_dot_in_its_slot_while_it_is_seen) {
  EmulatedCamera camera = camera_with(kLevel4);
  camera.track(spots_at({{100, 100}, {300, 100}, {500, 100}}));
  camera.track(spots_at({{520, 100}, {320, 100}}));
  EXPECT_THAT(camera.track(spots_at({{700, 300}, {340, 100}, {540, 100}})),
              ElementsAre(SensorDot{700, 300, 3}, SensorDot{340, 100, 3}, SensorDot{540, 100, 3},
                          std::nullopt));
}

TEST(EmulatedCamera, lets_a_reflection_win_a_slot_when_the_gain_makes_all_equally_bright) {
  std::vector<SensorSpot> spots = spots_at({{100, 500}, {200, 510}, {300, 520}, {400, 530}});
  spots.push_back({600, 20, 0.9 * kFrom3m});  // a reflection, in a row that is read first
  const SensorDot shown_by_maximum{600, 20, 4};
  EXPECT_THAT(
      camera_with(kLevel4).track(spots),
      ::testing::Not(::testing::Contains(Optional(::testing::Field(&SensorDot::x_px, 600)))));
  EXPECT_THAT(camera_with(kMaximum).track(spots), ::testing::Contains(Optional(shown_by_maximum)));
}

TEST(EmulatedCamera, does_not_answer_without_power_or_beyond_its_registers) {
  EmulatedCamera camera;
  std::array<std::uint8_t, 2> two{};
  EXPECT_FALSE(camera.write(0x30, two));
  EXPECT_FALSE(camera.read(0x30, two));
  camera.set_power(true);
  EXPECT_TRUE(camera.read(0xfe, two));
  EXPECT_FALSE(camera.read(0xff, two));
}

}  // namespace
}  // namespace vindu
