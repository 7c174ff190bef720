// The emulated Wiimote, seen from outside its seam (bytes, times) and, for the sensor, from inside.
#include "simulator/emulated_wiimote.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "simulator/emulated_room.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr std::array<std::uint8_t, 3> kStream = {0x12, 0x04, 0x33};
constexpr std::array<std::uint8_t, 3> kButtonsOnly = {0x12, 0x00, 0x30};
const Rigid3 kMiddle{Quat::Identity(), {0, 1.75, 2.1}};

CameraConfig camera_behind() {
  CameraConfig config;
  config.room_from_camera = look_at({-1, 2.3, 5}, {0, 1.65, 2});
  return config;
}

Rigid3 turned(double yaw_deg, const Vec3& place) {
  return {Quat(Eigen::AngleAxisd(radians(yaw_deg), Vec3::UnitY())), place};
}

int dots_in(const SensorState& state) {
  return static_cast<int>(std::ranges::count_if(state.slots, [](const auto& s) { return !!s; }));
}

TEST(EmulatedSensor, rounds_the_projection_to_whole_units) {
  const CameraConfig config = camera_behind();
  const HeadConfig head;
  const CameraModel camera(config);
  EmulatedSensor sensor(config, head, 0, 1);
  const SensorState state = sensor.look(kMiddle);
  ASSERT_EQ(dots_in(state), 3);
  for (const Vec3& led : head.leds_in_head) {
    const Vec2 exact_px = *camera.project(camera.camera_from_room() * (kMiddle * led));
    const bool found = std::ranges::any_of(state.slots, [&](const auto& dot) {
      return dot && std::abs(dot->x_px - exact_px.x()) <= 0.5 &&
             std::abs(dot->y_px - exact_px.y()) <= 0.5;
    });
    EXPECT_TRUE(found);
  }
}

TEST(EmulatedSensor, shows_dots_of_the_usual_size_at_the_usual_distance) {
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 0, 1);
  const SensorState state = sensor.look(kMiddle);
  for (std::size_t slot = 0; slot < 3; ++slot) {
    ASSERT_TRUE(state.slots[slot]);
    EXPECT_GE(state.slots[slot]->size, 2);
    EXPECT_LE(state.slots[slot]->size, 4);
  }
}

TEST(EmulatedSensor, scatters_dots_by_the_given_sigma) {
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 2.0, 1);
  double sum = 0, sum2 = 0;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    const double x_px = sensor.look(kMiddle).slots[0]->x_px;
    sum += x_px, sum2 += x_px * x_px;
  }
  const double variance = sum2 / kSamples - (sum / kSamples) * (sum / kSamples);
  EXPECT_NEAR(variance, 2.0 * 2.0 + 1.0 / 12, 0.4);  // rounding adds 1/12
}

TEST(EmulatedSensor, loses_leds_that_shine_elsewhere_or_behind_the_head) {
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 0, 1);
  EXPECT_EQ(dots_in(sensor.look(kMiddle)), 3);
  EXPECT_EQ(dots_in(sensor.look(turned(60, kMiddle.translation))), 2);
  EXPECT_EQ(dots_in(sensor.look(turned(180, kMiddle.translation))), 0);
}

TEST(EmulatedSensor, loses_leds_outside_the_picture) {
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 0, 1);
  EXPECT_EQ(dots_in(sensor.look({Quat::Identity(), {-1.5, 1.75, 2.1}})), 0);
  EXPECT_EQ(dots_in(sensor.look({Quat::Identity(), {0, 0.4, 2.1}})), 0);
}

TEST(EmulatedSensor, reports_only_the_four_brightest) {
  const CameraConfig config = camera_behind();
  HeadConfig head;  // the first LED is the farthest from the camera, so the faintest
  head.leds_in_head = {
      {0.02, 0.05, -0.08}, {-0.09, 0, 0}, {0.09, 0, 0}, {0, 0.06, 0}, {0, 0, 0.02}};
  EmulatedSensor sensor(config, head, 0, 1);
  const SensorState state = sensor.look(kMiddle);
  ASSERT_EQ(dots_in(state), 4);
  const CameraModel camera(config);
  const Vec2 faintest_px =
      *camera.project(camera.camera_from_room() * (kMiddle * head.leds_in_head[0]));
  for (const auto& dot : state.slots)
    EXPECT_GT((Vec2(dot->x_px, dot->y_px) - faintest_px).norm(), 3);
}

TEST(EmulatedSensor, keeps_a_dot_in_its_slot_while_it_is_seen) {
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 0, 1);
  SensorState before = sensor.look(kMiddle);
  int fewest = 3;
  for (double yaw_deg = 0; yaw_deg < 150; yaw_deg += 1) {  // aside, and back again
    const double there_and_back_deg = yaw_deg < 75 ? yaw_deg : 150 - yaw_deg;
    const SensorState now = sensor.look(turned(there_and_back_deg, kMiddle.translation));
    for (std::size_t slot = 0; slot < 4; ++slot) {
      if (!before.slots[slot] || !now.slots[slot]) continue;
      EXPECT_LE(std::abs(now.slots[slot]->x_px - before.slots[slot]->x_px), 3) << yaw_deg;
    }
    fewest = std::min(fewest, dots_in(now));
    before = now;
  }
  EXPECT_LT(fewest, 3);
  EXPECT_EQ(dots_in(before), 3);
}

TEST(EmulatedSensor, feels_gravity_as_it_hangs) {
  CameraConfig level;
  level.room_from_camera = look_at({0, 1.65, 5}, {0, 1.65, 0});
  EmulatedSensor sensor(level, HeadConfig{}, 0, 1);
  const auto raw = sensor.look(kMiddle).acceleration_raw;
  EXPECT_EQ(raw, (std::array<int, 3>{0x200, 0x200, 0x268}));
}

TEST(EmulatedSensor, shows_a_lamp_in_the_room_only_when_it_is_bright_enough) {
  const std::vector<Glint> lamps = {{{0.2, 1.8, 1.0}, 2.0}, {{-0.4, 1.8, 1.0}, 0.1}};
  EmulatedSensor sensor(camera_behind(), HeadConfig{}, 0, 1, lamps);
  EXPECT_EQ(sensor.view(kMiddle).spots.size(), 5u);
  EXPECT_EQ(dots_in(sensor.look(kMiddle)), 4);
}

class EmulatedRoomTest : public ::testing::Test {
 protected:
  static Site site() { return read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml"); }
  HidRead read(HidDevice& device) { return device.read(buffer_, clock_.now()); }

  ManualClock clock_;
  EmulatedRoom room_{site(), clock_};
  std::array<std::uint8_t, 64> buffer_{};
};

TEST_F(EmulatedRoomTest, its_devices_are_silent_until_they_are_asked_for_the_stream) {
  const auto wiimote = room_.connect(0);
  clock_.sleep_until(Time{milliseconds(500)});
  EXPECT_EQ(read(*wiimote).status, HidStatus::nothing);
  EXPECT_TRUE(wiimote->write(kStream));
  EXPECT_EQ(read(*wiimote).status, HidStatus::nothing);  // nothing from before it was asked
  clock_.sleep_until(Time{milliseconds(540)});
  EXPECT_EQ(read(*wiimote).status, HidStatus::report);
  EXPECT_EQ(buffer_[0], 0x33);
  EXPECT_TRUE(wiimote->write(kButtonsOnly));
  clock_.sleep_until(Time{milliseconds(600)});
  while (read(*wiimote).status == HidStatus::report) {
  }
  clock_.sleep_until(Time{milliseconds(900)});
  EXPECT_EQ(read(*wiimote).status, HidStatus::nothing);
}

TEST_F(EmulatedRoomTest, a_device_delivers_a_hundred_reports_a_second) {
  const auto wiimote = room_.connect(0);
  wiimote->write(kStream);
  clock_.sleep_until(Time{std::chrono::seconds(10)});
  std::vector<Time> arrivals;
  for (HidRead got = read(*wiimote); got.status == HidStatus::report; got = read(*wiimote)) {
    if (buffer_[0] != 0x33) continue;
    EXPECT_EQ(got.size, 18u);
    arrivals.push_back(got.arrival);
  }
  EXPECT_NEAR(static_cast<double>(arrivals.size()), 1000, 3);
  for (std::size_t i = 2; i < arrivals.size(); ++i) {  // the first answers the request
    const double gap_ms = vindu::milliseconds(arrivals[i] - arrivals[i - 1]);
    ASSERT_TRUE(gap_ms > 9.4 && gap_ms < 10.6) << gap_ms;
  }
}

TEST_F(EmulatedRoomTest, its_devices_are_found_as_real_ones_are) {
  const auto found = room_.bus().list();
  ASSERT_EQ(found.size(), site().cameras.size());
  EXPECT_EQ(found[0].name, "Nintendo RVL-CNT-01");
  EXPECT_NE(found[0].address, found[1].address);
  EXPECT_NE(room_.bus().open(found[1].path), nullptr);
}

TEST_F(EmulatedRoomTest, its_devices_pause_in_turn_where_they_share_an_adapter) {
  EmulatedRoomOptions options;
  options.wiimote.link = two_on_one_adapter();
  options.wiimote.link.loss = 0;
  options.wiimote.one_adapter = true;
  const EmulatedRoom room(site(), clock_, options);
  std::map<Time, std::size_t> served_again;  // after each pause, and which
  const std::array wiimotes = {room.connect(0), room.connect(1)};
  for (const auto& wiimote : wiimotes) wiimote->write(kStream);
  clock_.sleep_until(Time{std::chrono::seconds(10)});
  for (std::size_t i = 0; i < wiimotes.size(); ++i)
    for (Time last = Time::max();;) {
      const HidRead got = read(*wiimotes[i]);
      if (got.status != HidStatus::report) break;
      if (last < got.arrival - milliseconds(15)) served_again[got.arrival] = i;
      last = got.arrival;
    }
  ASSERT_GT(served_again.size(), 300u);
  std::size_t before = served_again.begin()->second;
  for (const auto& [time, device] : served_again) {
    if (time == served_again.begin()->first) continue;
    ASSERT_EQ(device, 1 - before) << seconds(time.time_since_epoch());
    before = device;
  }
}

TEST_F(EmulatedRoomTest, a_camera_that_is_not_on_shows_no_dots) {
  EmulatedRoomOptions options;
  options.wiimote.camera_already_on = false;
  const EmulatedRoom room(site(), clock_, options);
  const auto wiimote = room.connect(0);
  wiimote->write(kStream);
  clock_.sleep_until(Time{milliseconds(100)});
  ASSERT_EQ(read(*wiimote).status, HidStatus::report);
  ASSERT_EQ(read(*wiimote).status, HidStatus::report);
  ASSERT_EQ(buffer_[0], 0x33);
  EXPECT_TRUE(std::all_of(buffer_.begin() + 6, buffer_.begin() + 18,
                          [](std::uint8_t byte) { return byte == 0xff; }));
}

}  // namespace
}  // namespace vindu
