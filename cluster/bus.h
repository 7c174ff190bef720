// The transport seam: typed messages between the processes of a wall, or between the tiles of one
// process. What is delivered how (kept for late readers, conflated, owned) is a table in topics.h;
// InProcessTransport and DdsTransport keep to it alike.
#pragma once

#include <memory>
#include <vector>

#include "cluster/topics.h"

namespace vindu {

/// Who takes part, and as what. Names of tiles are those of the wall.
struct Membership {
  Participant self;
  Topics publishes;
  Topics subscribes;
  int strength = 1;  ///< as a source of poses: the stronger is heard (tracker 10, master 1)
};

/// One participant of a wall. publish() is thread-safe; take() and wait() belong to one thread.
/// Nobody hears himself. Only wait() waits, but that publish() of a reliable topic may take
/// 10 ms where a reader is far behind.
class Bus {
 public:
  virtual ~Bus() = default;

  /// Of a topic that the membership publishes. A message that no reader would accept (not a
  /// number, no name) is left out, with a line in the log.
  virtual void publish(const Message& message) = 0;

  /// What has arrived since the last call, oldest first for each key; the topic must be subscribed
  /// to.
  virtual std::vector<Message> take(Topic topic) = 0;

  /// Returns when something happened in one of these topics (true; that a writer left counts too,
  /// so take() may come back empty), or at the deadline.
  virtual bool wait(Topics topics, Time deadline) = 0;

  template <class M>
  std::vector<M> take() {
    std::vector<M> messages;
    for (Message& message : take(kTopicOf<M>)) messages.push_back(std::get<M>(std::move(message)));
    return messages;
  }

  template <class M>
  std::optional<M> take_newest() {
    std::vector<Message> messages = take(kTopicOf<M>);
    if (messages.empty()) return std::nullopt;
    return std::get<M>(std::move(messages.back()));
  }
};

/// Outlives every bus that it gives.
class Transport {
 public:
  virtual ~Transport() = default;
  /// Throws Error where the network cannot be joined.
  virtual std::unique_ptr<Bus> join(const Membership& membership) = 0;
};

}  // namespace vindu
