// Which field of a message is which of its wire struct, once for both directions: an Op copies one
// pair after the other, to the wire or from it. Private to cluster.
#pragma once

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

template <class Op, class Wire, class Value>
void rigid_fields(Op& op, Wire& wire, Value& value) {
  op.quaternion(wire.rotation, value.rotation);
  op.numbers(wire.translation_m, value.translation);
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
  op.choice(wire.mode, state.mode, Mode::track);
  op.count(wire.overlays, state.overlays);
}

template <class Op, class Wire, class Value>
requires std::same_as<std::remove_const_t<Value>, FrameMessage>
void fields(Op& op, Wire& wire, Value& frame) {
  op.id(wire.epoch, frame.epoch);
  fields(op, wire.newest, frame.newest);
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
  op.text(wire.user_data, message.user_data);
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
  op.choice(wire.verb, command.verb, Verb::stop);
  op.whole_text(wire.tile, command.tile);
  op.whole_text(wire.argument, command.argument);
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
