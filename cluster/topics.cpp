#include "cluster/topics.h"

#include <array>

namespace vindu {
namespace {

using std::chrono::milliseconds;

// Hot topics are best effort because they are repeated: a reliable one under loss waits for its
// resend (measured: p99 of the barrier 63 ms at 1 % loss, 17 ms by repeats).
constexpr std::array<TopicRules, kTopics> kRules = {{
    {.name = "frame"},
    {.name = "ready", .reliable = true},
    {.name = "tile_status", .reliable = true, .for_late_readers = true, .lease = milliseconds(500)},
    {.name = "scene", .reliable = true, .for_late_readers = true},
    {.name = "wall", .reliable = true, .for_late_readers = true},
    {.name = "pose", .exclusive = true, .lease = milliseconds(200)},
    {.name = "camera"},
    {.name = "event", .reliable = true, .depth = 256},
    {.name = "command", .reliable = true, .depth = 32},
    {.name = "answer", .reliable = true, .depth = 32},
    {.name = "log", .reliable = true, .depth = 100},
    {.name = "report", .reliable = true, .for_late_readers = true},
    {.name = "presence", .reliable = true, .depth = 16},
}};

std::string said_by(const Participant& who) {
  return std::string(name_of(who.role)) + " " + who.name + " on " + who.host + " (vindu " +
         who.version + ") speaks protocol " + std::to_string(who.protocol);
}

struct KeyOf {
  std::string operator()(const FrameMessage&) const { return {}; }
  std::string operator()(const SceneMessage&) const { return {}; }
  std::string operator()(const WallMessage&) const { return {}; }
  std::string operator()(const CameraMessage&) const { return {}; }
  std::string operator()(const ReadyMessage& message) const { return message.tile; }
  std::string operator()(const StatusMessage& message) const { return message.tile; }
  std::string operator()(const PoseMessage& message) const {
    return std::to_string(message.pose.object);
  }
  std::string operator()(const EventMessage& message) const { return message.source; }
  std::string operator()(const CommandMessage& message) const { return message.sender; }
  std::string operator()(const AnswerMessage& message) const { return message.from; }
  std::string operator()(const LogMessage& message) const { return message.source; }
  std::string operator()(const ReportMessage& message) const { return message.tile; }
  std::string operator()(const Presence& message) const { return message.who.name; }
};

}  // namespace

const TopicRules& rules_of(Topic topic) { return kRules[static_cast<std::size_t>(topic)]; }

// Presence is read off tile_status. A pose of the master's is the reserve of a tracker's.
TopicRights rights_of(Role role) {
  using enum Topic;
  switch (role) {
    case Role::master:
      return {.writes = {frame, scene, wall, pose, camera, event, answer, log, report},
              .reads = {ready, tile_status, pose, event, command, log}};
    case Role::tile:
      return {.writes = {ready, tile_status, log},
              .reads = {frame, scene, wall, pose, camera, report}};
    case Role::tracker:
      return {.writes = {pose, event, log}, .reads = {wall, camera}};
    case Role::console:
      return {.writes = {event, command},
              .reads = {frame, tile_status, scene, wall, pose, camera, event, answer, log, report}};
  }
  return {};
}

std::string mark_of(Role role) { return "vindu/is_" + std::string(name_of(role)); }

std::string key_of(const Message& message) { return std::visit(KeyOf(), message); }

std::string version_complaint(const Participant& self, const Participant& other) {
  return said_by(other) + ", but " + said_by(self) +
         ": they do not hear each other; install the same vindu on both (vindu deploy)";
}

}  // namespace vindu
