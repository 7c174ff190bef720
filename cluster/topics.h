// The topics of a wall, how each of them is delivered, and who is present. The reasons for every
// choice: decision 6 in docs/decisions.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "cluster/messages.h"

namespace vindu {

enum class Role { master, tile, tracker, console };

constexpr Role kRoles[] = {Role::master, Role::tile, Role::tracker, Role::console};

constexpr std::string_view name_of(Role role) {
  constexpr std::string_view names[] = {"master", "tile", "tracker", "console"};
  return names[static_cast<int>(role)];
}

struct Participant {
  Role role = Role::tile;
  std::string name{};  ///< "tile-3-0", "master"; letters, digits, and - _ . : @, as the next two
  std::string host{};
  std::string version{};            ///< of the program
  int protocol = kProtocolVersion;  ///< messages cross only between equal ones
  std::uint64_t epoch = 0;          ///< of a master (FrameMessage); 0: not said
  std::string wall{};               ///< fingerprint of what it takes for the wall; empty: not said

  bool operator==(const Participant&) const = default;
};

enum class PresenceChange {
  joined,
  alive,          ///< a tile whose status arrives; it has joined before or will at once
  silent,         ///< a tile whose status stopped: hung, or about to leave
  left,           ///< said so, or was not heard of for a second
  other_version,  ///< joined, and is not understood
};

constexpr std::string_view name_of(PresenceChange change) {
  constexpr std::string_view names[] = {"joined", "alive", "silent", "left", "other version"};
  return names[static_cast<int>(change)];
}

/// Made by the bus itself: who came and went among the others.
struct Presence {
  PresenceChange change = PresenceChange::joined;
  Participant who{};
};

/// What to tell people about a participant of another version; both sides get to say it.
std::string version_complaint(const Participant& self, const Participant& other);

enum class Topic {
  frame,
  ready,
  tile_status,
  scene,
  wall,
  pose,
  camera,
  event,
  command,
  answer,
  log,
  report,
  presence
};
constexpr int kTopics = 13;

/// In the order of Topic.
using Message = std::variant<FrameMessage, ReadyMessage, StatusMessage, SceneMessage, WallMessage,
                             PoseMessage, CameraMessage, EventMessage, CommandMessage,
                             AnswerMessage, LogMessage, ReportMessage, Presence>;
static_assert(std::variant_size_v<Message> == kTopics);

inline Topic topic_of(const Message& message) { return static_cast<Topic>(message.index()); }

namespace internal {
template <class M, int index = 0>
constexpr int topic_index() {
  if constexpr (std::is_same_v<M, std::variant_alternative_t<index, Message>>)
    return index;
  else
    return topic_index<M, index + 1>();
}
}  // namespace internal

template <class M>
constexpr Topic kTopicOf = static_cast<Topic>(internal::topic_index<M>());

/// A set of topics.
class Topics {
 public:
  constexpr Topics() = default;
  constexpr Topics(std::initializer_list<Topic> topics) {
    for (const Topic topic : topics) bits_ |= bit(topic);
  }
  constexpr bool has(Topic topic) const { return bits_ & bit(topic); }
  constexpr bool meets(Topics other) const { return bits_ & other.bits_; }
  constexpr void add(Topic topic) { bits_ |= bit(topic); }
  constexpr void remove(Topic topic) { bits_ &= ~bit(topic); }

 private:
  static constexpr unsigned bit(Topic topic) { return 1u << static_cast<int>(topic); }
  unsigned bits_ = 0;
};

/// How a topic is delivered. A message has a key (its tile, object, source or sender), and a reader
/// that is late keeps the newest `depth` of each key.
struct TopicRules {
  std::string_view name;
  bool reliable = false;  ///< sent again where the network lost it
  int depth = 1;
  bool for_late_readers = false;  ///< they get the last of each key, while its writer lives
  bool exclusive = false;         ///< of several writers of a key the strongest living one is heard
  Duration lease{};               ///< a writer lives that long after each message; 0: no limit
};

const TopicRules& rules_of(Topic topic);

/// What a role may write and read where the wall has keys; nobody more than it needs.
struct TopicRights {
  Topics writes{};
  Topics reads{};
};
TopicRights rights_of(Role role);

/// The topic that nobody but this role may write where the wall has keys (internal/role_marks.h);
/// the same in all versions, so that those who do not understand each other know who it is.
std::string mark_of(Role role);
std::string key_of(const Message& message);

}  // namespace vindu
