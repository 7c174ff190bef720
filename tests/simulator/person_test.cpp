// The simulated person: repeatable, smooth, human, and where the cameras are.
#include "simulator/person.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);

Person walker(std::uint64_t seed = 1) {
  PersonOptions options;
  options.seed = seed;
  return Person(HeadConfig{}, room_from_wall_at(1.55, 0), options);
}

Vec3 velocity_m_s(const Person& person, Time time) {
  return (person.eye_in_wall(time + kStep) - person.eye_in_wall(time - kStep)) / seconds(2 * kStep);
}

TEST(Person, walks_the_same_way_for_the_same_seed_only) {
  const Person one = walker(5), same = walker(5), other = walker(6);
  const Time time{std::chrono::seconds(37)};
  EXPECT_EQ(one.eye_in_wall(time), same.eye_in_wall(time));
  EXPECT_GT((one.eye_in_wall(time) - other.eye_in_wall(time)).norm(), 0.01);
}

TEST(Person, moves_without_jumps_of_place_or_speed) {
  const Person person = walker();
  Vec3 before = velocity_m_s(person, Time{kStep});
  for (Time time{2 * kStep}; time < Time{std::chrono::seconds(400)}; time += 4 * kStep) {
    const Vec3 velocity = velocity_m_s(person, time);
    ASSERT_LT((velocity - before).norm(), 0.02) << seconds(time.time_since_epoch()) << " s";
    before = velocity;
  }
}

TEST(Person, walks_stops_and_keeps_to_a_human_pace) {
  const Person person = walker();
  double fastest_m_s = 0;
  int walking = 0, standing = 0;
  for (Time time{std::chrono::seconds(1)}; time < Time{std::chrono::seconds(400)};
       time += 20 * kStep) {
    const double speed_m_s = velocity_m_s(person, time).norm();
    fastest_m_s = std::max(fastest_m_s, speed_m_s);
    walking += speed_m_s > 0.15;
    standing += speed_m_s < 0.05;
  }
  RecordProperty("fastest_mm_s", static_cast<int>(1000 * fastest_m_s));
  EXPECT_GT(fastest_m_s, 0.4);
  EXPECT_LT(fastest_m_s, 0.7);
  EXPECT_GT(walking, 2000);
  EXPECT_GT(standing, 1000);
}

TEST(Person, stays_in_his_part_of_the_room_and_faces_the_wall) {
  const Person person = walker();
  const PersonOptions options;
  double mean_height_m = 0;
  int samples = 0;
  for (Time time{}; time < Time{std::chrono::seconds(400)}; time += 50 * kStep, ++samples) {
    const Rigid3 room_from_head = person.room_from_head(time);
    const Vec3 eye_in_room = room_from_head * HeadConfig{}.eye_in_head;
    mean_height_m += eye_in_room.y();
    const Vec3 swing_m(0.08, 0.05, 0.08);
    ASSERT_TRUE((eye_in_room.array() >= (options.least_eye_in_room - swing_m).array()).all());
    ASSERT_TRUE((eye_in_room.array() <= (options.largest_eye_in_room + swing_m).array()).all());
    ASSERT_LT((room_from_head.rotation * -Vec3::UnitZ()).z(), -0.5);  // within 60 degrees
  }
  EXPECT_NEAR(mean_height_m / samples, 1.65, 0.05);
}

TEST(Person, seen_in_wall_has_his_eye_where_the_head_has_it) {
  const HeadConfig head;
  const Rigid3 room_from_wall = room_from_wall_at(1.55, 10);
  const Person person(head, room_from_wall);
  const Time time{std::chrono::seconds(12)};
  const Vec3 eye_in_room = room_from_wall * person.eye_in_wall(time);
  EXPECT_LT((eye_in_room - person.room_from_head(time) * head.eye_in_head).norm(), 1e-12);
}

}  // namespace
}  // namespace vindu
