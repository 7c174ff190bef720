// Which field of a message is which of its wire struct, once for both directions: an Op copies one
// pair after the other, to the wire or from it. Private to cluster.
#pragma once

#include <algorithm>
#include <concepts>

#include "cluster/topics.h"
#include "wire.h"

namespace vindu::internal {

/// What a number may be.
struct Limits {
  double low = -1e9;
  double high = 1e9;
};
constexpr Limits kNotNegative{0, 1e9};
constexpr Limits kAboveZero{1e-9, 1e9};
constexpr Limits kShare{0, 1};
constexpr Limits kBytes{0, 1e18};
/// Of a touch page: in pixels of any tile they are far within an int.
constexpr Limits kOnWall_m{-1e4, 1e4};
constexpr Limits kRing_m{1e-4, 1e2};

/// What is added up never overflows.
inline bool brief(Duration duration) {
  return duration < std::chrono::days(1) && duration > -std::chrono::days(1);
}

template <class Op, class Wire, class Value>
void rigid_fields(Op& op, Wire& wire, Value& value) {
  op.quaternion(wire.rotation, value.rotation);
  op.numbers(wire.translation_m, value.translation);
}

template <class Op, class Wire, class Value>
void touch_page_fields(Op& op, Wire& wire, Value& maybe) {
  if (!op.there(wire._d, maybe)) return;
  auto& page = *maybe;
  auto& wire_page = wire._u.page;
  op.size(wire_page.count, page.points, kMostTouchPoints);
  for (std::size_t i = 0; i < std::min(page.points.size(), kMostTouchPoints); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      op.number(wire_page.points[i].x_in_wall_m[axis], page.points[i].x_in_wall[axis], kOnWall_m);
    op.name(wire_page.points[i].tile, page.points[i].tile);
  }
  op.index(wire_page.done, page.done, page.points.size());
  op.number(wire_page.held, page.held, kShare);
  op.number(wire_page.ring_m, page.ring_m, kRing_m);
  op.text(wire_page.remark, page.remark);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, FrameState>
void fields(Op& op, Wire& wire, Value& state) {
  op.id(wire.number, state.number);
  op.time(wire.photon_time_ns, state.photon_time);
  op.numbers(wire.eye_in_wall_m, state.eye_in_wall);
  rigid_fields(op, wire.wall_from_scene, state.navigation.wall_from_scene);
  op.number(wire.scale, state.navigation.scale, kAboveZero);
  op.number(wire.animation_time_s, state.animation_time_s);
  op.integer(wire.clip, state.clip);
  op.require(state.clip >= -1);
  op.choice(wire.mode, state.mode, Mode::track);
  op.count(wire.overlays, state.overlays);
  op.choice(wire.pattern, state.pattern, Pattern::eye);
  op.flag(wire.blank, state.blank);
  touch_page_fields(op, wire.touch_page, state.touch_page);
}

template <class Op, class Wire, class Value>
void origin_fields(Op& op, Wire& wire, Value& origin) {
  op.optional_time(wire.capture_time_ns, origin.capture_time);
  op.time(wire.tick_time_ns, origin.tick_time);
  op.time(wire.eye_time_ns, origin.eye_time);
  op.require(brief(origin.eye_time - origin.tick_time));
  op.require(!origin.capture_time || brief(origin.tick_time - *origin.capture_time));
}

template <class Op, class Wire, class Value>
void parts_fields(Op& op, Wire& wire, Value& parts) {
  op.duration(wire.pickup_ns, parts.pickup);
  op.duration(wire.draw_ns, parts.draw);
  op.duration(wire.barrier_ns, parts.barrier);
  op.duration(wire.swap_ns, parts.swap);
  op.require(brief(parts.pickup) && brief(parts.draw) && brief(parts.barrier) && brief(parts.swap));
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, FrameMessage>
void fields(Op& op, Wire& wire, Value& frame) {
  op.id(wire.epoch, frame.epoch);
  fields(op, wire.newest, frame.newest);
  origin_fields(op, wire.origin, frame.origin);
  op.count(wire.released, frame.released);
  op.require(frame.released <= frame.newest.number);
  op.optional_time(wire.present_time_ns, frame.present_time);
  op.count(wire.scene_revision, frame.scene_revision);
  op.count(wire.active_tiles, frame.active_tiles);
  op.time(wire.sent_time_ns, frame.sent_time);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, ReadyMessage>
void fields(Op& op, Wire& wire, Value& ready) {
  op.name(wire.tile, ready.tile);
  op.id(wire.incarnation, ready.incarnation);
  op.id(wire.epoch, ready.epoch);
  op.id(wire.number, ready.number);
  op.count(wire.presented, ready.presented);
  op.time(wire.presented_time_ns, ready.presented_time);
  parts_fields(op, wire.presented_parts, ready.presented_parts);
  op.duration(wire.draw_ns, ready.draw_time);
  op.time(wire.frame_sent_time_ns, ready.frame_sent_time);
  op.time(wire.frame_received_time_ns, ready.frame_received_time);
  op.time(wire.sent_time_ns, ready.sent_time);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, StatusMessage>
void fields(Op& op, Wire& wire, Value& status) {
  op.name(wire.tile, status.tile);
  op.text(wire.host, status.host);
  op.id(wire.incarnation, status.incarnation);
  op.choice(wire.state, status.state, TileState::failed);
  op.count(wire.epoch, status.epoch);
  op.count(wire.presented, status.presented);
  op.count(wire.scene_revision, status.scene_revision);
  op.number(wire.frames_per_s, status.frames_per_s, kNotNegative);
  op.count(wire.late_frames, status.late_frames);
  op.number(wire.refresh_hz, status.refresh_hz, kNotNegative);
  op.number(wire.refresh_phase_s, status.refresh_phase_s);
  op.text(wire.renderer, status.renderer);
  op.text(wire.version, status.version);
  op.text(wire.error, status.error);
  op.number(wire.draw_ms, status.draw.draw_ms, kNotNegative);
  op.number(wire.gpu_ms, status.draw.gpu_ms, kNotNegative);
  op.count(wire.triangles, status.draw.triangles);
  op.number(wire.culled_share, status.draw.culled_share, kShare);
  op.number(wire.memory_bytes, status.draw.memory_bytes, kBytes);
  op.count(wire.process, status.process);
}

template <class Op, class Wire, class Value>
void quantile_fields(Op& op, Wire& wire, Value& quantiles) {
  op.number(wire.p50, quantiles.p50);
  op.number(wire.p99, quantiles.p99);
  op.number(wire.max, quantiles.max);
}

template <class Op, class Wire, class Value>
void summary_fields(Op& op, Wire& wire, Value& summary) {
  op.count(wire.frames, summary.frames);
  op.number(wire.frames_per_s, summary.frames_per_s, kNotNegative);
  op.numbers(wire.mean_ms, summary.mean_ms);
  op.flag(wire.tracked, summary.tracked);
  quantile_fields(op, wire.motion_to_photon_ms, summary.motion_to_photon_ms);
  quantile_fields(op, wire.skew_ms, summary.skew_ms);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, ReportMessage>
void fields(Op& op, Wire& wire, Value& report) {
  op.whole_text(wire.tile, report.tile);
  op.id(wire.epoch, report.epoch);
  summary_fields(op, wire.frames, report.frames);
  op.count(wire.locked, report.locked);
  op.count(wire.evictions, report.evictions);
  op.count(wire.restarts, report.restarts);
  op.choice(wire.level, report.level, TrackingLevel::lost);
  op.text(wire.event, report.event);
  op.text(wire.tracker, report.tracker);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, SceneMessage>
void fields(Op& op, Wire& wire, Value& scene) {
  op.id(wire.revision, scene.revision);
  op.whole_text(wire.path, scene.path);
  op.whole_text(wire.sha256, scene.sha256);
  op.choice(wire.placement, scene.placement, Placement::as_is);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, WallMessage>
void fields(Op& op, Wire& wire, Value& wall) {
  op.id(wire.revision, wall.revision);
  op.whole_text(wire.toml, wall.toml);
}

template <class Op, class Wire, class Value>
void pose_fields(Op& op, Wire& wire, Value& pose) {
  op.integer(wire.object, pose.object);
  op.time(wire.time_ns, pose.time);
  op.time(wire.capture_time_ns, pose.capture_time);
  op.choice(wire.level, pose.level, TrackingLevel::lost);
  rigid_fields(op, wire.room_from_head, pose.room_from_head);
  op.numbers(wire.velocity_in_room_m_s, pose.velocity_in_room_m_s);
  op.numbers(wire.angular_velocity_in_room_rad_s, pose.angular_velocity_in_room_rad_s);
  op.covariance(wire.covariance, pose.covariance);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, PoseMessage>
void fields(Op& op, Wire& wire, Value& message) {
  pose_fields(op, wire, message.pose);
  op.time(wire.sent_time_ns, message.sent_time);
  op.flag(wire.followed, message.followed);
  op.text(wire.tracker, message.tracker);
  op.count(wire.strength, message.strength);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, CameraMessage>
void fields(Op& op, Wire& wire, Value& camera) {
  op.id(wire.number, camera.number);
  op.numbers(wire.position_in_wall_m, camera.position_in_wall);
  op.quaternion(wire.room_from_wall_rotation, camera.room_from_wall);
  op.numbers(wire.frustum_m, camera.frustum_m);
  op.number(wire.near_m, camera.near_m, kAboveZero);
  op.number(wire.far_m, camera.far_m, kNotNegative);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, EventMessage>
void fields(Op& op, Wire& wire, Value& event) {
  op.name(wire.source, event.source);
  op.choice(wire.kind, event.kind, EventKind::key);
  op.choice(wire.phase, event.phase, EventPhase::end);
  op.integer(wire.id, event.id);
  op.number(wire.x_px, event.x_px);
  op.number(wire.y_px, event.y_px);
  op.number(wire.value, event.value);
  op.text(wire.text, event.text);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, CommandMessage>
void fields(Op& op, Wire& wire, Value& command) {
  op.name(wire.sender, command.sender);
  op.id(wire.request, command.request);
  op.choice(wire.verb, command.verb, Verb::touch_page);
  op.whole_text(wire.tile, command.tile);
  op.whole_text(wire.argument, command.argument);
  op.whole_text(wire.clip, command.clip);
  touch_page_fields(op, wire.touch_page, command.touch_page);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, AnswerMessage>
void fields(Op& op, Wire& wire, Value& answer) {
  op.name(wire.from, answer.from);
  op.name(wire.sender, answer.sender);
  op.id(wire.request, answer.request);
  op.flag(wire.done, answer.done);
  op.text(wire.text, answer.text);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, LogMessage>
void fields(Op& op, Wire& wire, Value& line) {
  op.name(wire.source, line.source);
  op.time(wire.time_ns, line.time);
  op.choice(wire.level, line.level, LogLevel::verbose);
  op.text(wire.text, line.text);
}

}  // namespace vindu::internal
