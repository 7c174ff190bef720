// Messages to wire structs and back, checked in both directions, and which wire struct a message
// has. Private to cluster.
#pragma once

#include <concepts>
#include <optional>

#include "cluster/internal/wire_fields.h"

namespace vindu::internal {

/// Wire struct and descriptor of a value type.
template <class Value>
struct WireOf;

#define VINDU_WIRE(Value, Struct)                                                            \
  template <>                                                                                \
  struct WireOf<Value> {                                                                     \
    using type = vindu_wire_##Struct;                                                        \
    static const dds_topic_descriptor_t& descriptor() { return vindu_wire_##Struct##_desc; } \
  }
VINDU_WIRE(FrameState, FrameState);
VINDU_WIRE(FrameMessage, Frame);
VINDU_WIRE(ReadyMessage, Ready);
VINDU_WIRE(StatusMessage, TileStatus);
VINDU_WIRE(SceneMessage, Scene);
VINDU_WIRE(WallMessage, Wall);
VINDU_WIRE(PoseMessage, Pose);
VINDU_WIRE(CameraMessage, Camera);
VINDU_WIRE(EventMessage, Event);
VINDU_WIRE(CommandMessage, Command);
VINDU_WIRE(AnswerMessage, Answer);
VINDU_WIRE(LogMessage, Log);
VINDU_WIRE(ReportMessage, Report);
#undef VINDU_WIRE

/// Every byte of `wire` is written, padding too. False when the value is one that no reader
/// accepts.
template <class Value>
bool to_wire(const Value& value, typename WireOf<Value>::type& wire);

/// Empty when anything in it is out of range.
template <class Value>
std::optional<Value> from_wire(const typename WireOf<Value>::type& wire);

/// Calls `use` with a null pointer to the message type of a topic; of presence with that of
/// Presence.
template <class Use>
decltype(auto) with_type_of(Topic topic, Use use) {
  switch (topic) {
    case Topic::frame:
      return use(static_cast<FrameMessage*>(nullptr));
    case Topic::ready:
      return use(static_cast<ReadyMessage*>(nullptr));
    case Topic::tile_status:
      return use(static_cast<StatusMessage*>(nullptr));
    case Topic::scene:
      return use(static_cast<SceneMessage*>(nullptr));
    case Topic::wall:
      return use(static_cast<WallMessage*>(nullptr));
    case Topic::pose:
      return use(static_cast<PoseMessage*>(nullptr));
    case Topic::camera:
      return use(static_cast<CameraMessage*>(nullptr));
    case Topic::event:
      return use(static_cast<EventMessage*>(nullptr));
    case Topic::command:
      return use(static_cast<CommandMessage*>(nullptr));
    case Topic::answer:
      return use(static_cast<AnswerMessage*>(nullptr));
    case Topic::log:
      return use(static_cast<LogMessage*>(nullptr));
    case Topic::report:
      return use(static_cast<ReportMessage*>(nullptr));
    case Topic::presence:
      break;
  }
  return use(static_cast<Presence*>(nullptr));
}

}  // namespace vindu::internal
