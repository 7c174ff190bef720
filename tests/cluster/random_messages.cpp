#include "tests/cluster/random_messages.h"

#include <algorithm>

namespace vindu::testing {
namespace {

std::uint64_t id(Random& random) { return 1 + static_cast<std::uint64_t>(random.uniform(0, 1e15)); }
Vec3 point(Random& random) {
  return {random.normal(3), random.normal(3), random.uniform(-1e9, 1e9)};
}
Quat turn(Random& random) {
  return Quat(random.normal(1), random.normal(1), random.normal(1), random.normal(1)).normalized();
}
Time time(Random& random) { return Time(Duration(static_cast<long>(random.uniform(-1e18, 1e18)))); }
template <class Enum>
Enum choice(Random& random, Enum last) {
  return static_cast<Enum>(static_cast<int>(random.uniform(0, 1 + static_cast<int>(last))));
}
std::string text(Random& random, int most) {
  std::string result(1 + static_cast<std::size_t>(random.uniform(0, most)), ' ');
  for (char& letter : result) letter = static_cast<char>(random.uniform(' ', '~'));
  return result;
}

Duration duration(Random& random) { return Duration(static_cast<long>(random.uniform(0, 1e9))); }

std::optional<TouchPage> touch_page(Random& random) {
  if (random.uniform(0, 1) < 0.5) return std::nullopt;
  const auto count = static_cast<std::size_t>(random.uniform(0, 1 + double(kMostTouchPoints)));
  TouchPage page;
  for (std::size_t i = 0; i < count; ++i)
    page.points.push_back(
        {{random.normal(3), random.normal(3), random.uniform(-1e4, 1e4)}, text(random, 60)});
  page.done = static_cast<std::size_t>(random.uniform(0, 1 + double(count)));
  page.held = random.uniform(0, 1);
  page.remark = text(random, 250);
  page.ring_m = random.uniform(1e-4, 1e2);
  return page;
}

FrameMessage frame(Random& random) {
  FrameMessage frame{.epoch = id(random), .newest = random_state(random)};
  frame.origin.tick_time = time(random);
  frame.origin.eye_time = frame.origin.tick_time + duration(random);
  if (random.uniform(0, 1) < 0.5)
    frame.origin.capture_time = frame.origin.tick_time - duration(random);
  frame.released = frame.newest.number - 1;
  if (random.uniform(0, 1) < 0.5) frame.present_time = time(random);
  frame.scene_revision = id(random);
  frame.active_tiles = static_cast<std::uint32_t>(random.uniform(0, 64));
  frame.sent_time = time(random);
  return frame;
}

ReadyMessage ready(Random& random) {
  return {
      .tile = text(random, 62),
      .incarnation = id(random),
      .epoch = id(random),
      .number = id(random),
      .presented = id(random),
      .presented_time = time(random),
      .presented_parts = {duration(random), duration(random), duration(random), duration(random)},
      .draw_time = duration(random),
      .frame_sent_time = time(random),
      .frame_received_time = time(random),
      .sent_time = time(random)};
}

StatusMessage status(Random& random) {
  return {.tile = text(random, 62),
          .host = text(random, 200),
          .incarnation = id(random),
          .state = choice(random, TileState::failed),
          .epoch = id(random),
          .presented = id(random),
          .scene_revision = id(random),
          .frames_per_s = random.uniform(0, 100),
          .late_frames = id(random),
          .refresh_hz = random.uniform(0, 100),
          .refresh_phase_s = random.uniform(0, 1),
          .renderer = text(random, 100),
          .version = text(random, 30),
          .error = text(random, 500),
          .draw = {.draw_ms = random.uniform(0, 100),
                   .gpu_ms = random.uniform(0, 100),
                   .triangles = id(random),
                   .culled_share = random.uniform(0, 1),
                   .memory_bytes = random.uniform(0, 1e12)},
          .process = static_cast<std::uint32_t>(random.uniform(0, 4e6))};
}

Quantiles quantiles(Random& random) {
  return {random.normal(1), random.normal(1), random.normal(1)};
}

ReportMessage report(Random& random) {
  ReportMessage report{.tile = text(random, 62),
                       .epoch = id(random),
                       .locked = static_cast<std::uint32_t>(random.uniform(0, 64)),
                       .evictions = static_cast<std::uint32_t>(random.uniform(0, 1e6)),
                       .restarts = static_cast<std::uint32_t>(random.uniform(0, 1e6)),
                       .level = choice(random, TrackingLevel::lost),
                       .event = text(random, 250),
                       .tracker = text(random, 250)};
  report.frames = {.frames = id(random),
                   .frames_per_s = random.uniform(0, 100),
                   .tracked = random.uniform(0, 1) < 0.5,
                   .motion_to_photon_ms = quantiles(random),
                   .skew_ms = quantiles(random)};
  for (double& mean_ms : report.frames.mean_ms) mean_ms = random.normal(10);
  return report;
}

PoseMessage pose(Random& random) {
  PoseMessage message{.pose = {},
                      .sent_time = time(random),
                      .followed = random.uniform(0, 1) < 0.5,
                      .tracker = text(random, 60),
                      .strength = static_cast<std::uint32_t>(random.uniform(0, 1000))};
  message.pose.object = static_cast<int>(random.uniform(-100, 100));
  message.pose.time = time(random);
  message.pose.capture_time = time(random);
  message.pose.level = choice(random, TrackingLevel::lost);
  message.pose.room_from_head = {turn(random), point(random)};
  message.pose.velocity_in_room_m_s = point(random);
  message.pose.angular_velocity_in_room_rad_s = point(random);
  Mat6 root;
  for (double& value : root.reshaped()) value = random.normal(1);
  message.pose.covariance = root * root.transpose();
  return message;
}

CameraMessage camera(Random& random) {
  return {.number = id(random),
          .position_in_wall = point(random),
          .room_from_wall = turn(random),
          .frustum_m = {random.normal(1), random.normal(1), random.normal(1), random.normal(1)},
          .near_m = random.uniform(0.01, 1),
          .far_m = random.uniform(0, 100)};
}

EventMessage event(Random& random) {
  return {.source = text(random, 60),
          .kind = choice(random, EventKind::key),
          .phase = choice(random, EventPhase::end),
          .id = static_cast<int>(random.uniform(0, 1e6)),
          .x_px = random.uniform(0, 7168),
          .y_px = random.uniform(0, 3072),
          .value = random.normal(1),
          .text = text(random, 120)};
}

CommandMessage command(Random& random) {
  return {.sender = text(random, 100),
          .request = id(random),
          .verb = choice(random, Verb::touch_page),
          .tile = text(random, 60),
          .argument = text(random, 1000),
          .clip = text(random, 250),
          .touch_page = touch_page(random)};
}

}  // namespace

FrameState random_state(Random& random) {
  FrameState state;
  state.number = 1 + id(random);
  state.photon_time = time(random);
  state.eye_in_wall = point(random);
  state.navigation.wall_from_scene = {turn(random), point(random)};
  state.navigation.scale = random.uniform(1e-6, 1e6);
  state.animation_time_s = random.normal(1000);
  state.clip = static_cast<int>(random.uniform(-1, 1000));
  state.mode = choice(random, Mode::track);
  state.overlays = random.uniform(0, 1) < 0.5 ? std::uint32_t{kStatistics} : 0;
  state.pattern = choice(random, Pattern::eye);
  state.blank = random.uniform(0, 1) < 0.5;
  state.touch_page = touch_page(random);
  return state;
}

Message random_message(Random& random, Topic topic) {
  switch (topic) {
    case Topic::frame:
      return frame(random);
    case Topic::ready:
      return ready(random);
    case Topic::tile_status:
      return status(random);
    case Topic::scene:
      return SceneMessage{id(random), text(random, 1000), text(random, 60),
                          choice(random, Placement::as_is)};
    case Topic::wall:
      return WallMessage{id(random), text(random, 60000)};
    case Topic::pose:
      return pose(random);
    case Topic::camera:
      return camera(random);
    case Topic::event:
      return event(random);
    case Topic::command:
      return command(random);
    case Topic::answer:
      return AnswerMessage{text(random, 100), id(random), text(random, 100),
                           random.uniform(0, 1) < 0.5, text(random, 1000)};
    case Topic::log:
      return LogMessage{text(random, 60), time(random), choice(random, LogLevel::verbose),
                        text(random, 500)};
    case Topic::report:
      return report(random);
    case Topic::presence:
      break;
  }
  return Presence{};
}

}  // namespace vindu::testing
