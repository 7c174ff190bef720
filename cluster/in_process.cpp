#include "cluster/in_process.h"

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>

#include "cluster/internal/participant_text.h"
#include "cluster/internal/wire_types.h"

namespace vindu {
namespace {

/// The message as it would arrive over the network; empty when it would not.
std::optional<Message> as_it_arrives(const Message& message) {
  return std::visit(
      []<class M>(const M& value) -> std::optional<Message> {
        if constexpr (std::same_as<M, Presence>) {
          return std::nullopt;
        } else {
          auto wire = std::make_unique<typename internal::WireOf<M>::type>();
          if (!internal::to_wire(value, *wire)) return std::nullopt;
          return internal::from_wire<M>(*wire);
        }
      },
      message);
}

/// What waits to be taken of one topic.
class Inbox {
 public:
  void add(const std::string& key, const Message& message, int depth) {
    const auto has_key = [&key](const auto& entry) { return entry.first == key; };
    if (std::ranges::count_if(entries_, has_key) >= depth)
      entries_.erase(std::ranges::find_if(entries_, has_key));
    entries_.emplace_back(key, message);
  }
  bool empty() const { return entries_.empty(); }
  std::vector<Message> take() {
    std::vector<Message> messages;
    for (auto& entry : entries_) messages.push_back(std::move(entry.second));
    entries_.clear();
    return messages;
  }

 private:
  std::deque<std::pair<std::string, Message>> entries_;
};

}  // namespace

/// All that members share, behind one lock.
class InProcessTransport::Hub {
 public:
  void enter(Member& member);
  void leave(Member& member);
  void publish(Member& from, const Message& message);
  std::vector<Message> take(Member& member, Topic topic);
  bool wait(Member& member, Topics topics, Time deadline);

 private:
  struct Owner {
    const Member* member = nullptr;
    Time last{};
  };

  /// False when a stronger source of the same key lives.
  bool owns(const Member& from, Topic topic, const std::string& key, Time now);
  void tell(const Presence& presence, const Member& about);
  void mark_silent(Time now);
  Time next_silence() const;

  std::mutex mutex_;
  std::vector<Member*> members_;
  std::map<std::pair<Topic, std::string>, Owner> owners_;
};

class InProcessTransport::Member final : public Bus {
 public:
  Member(Hub& hub, const Membership& membership) : hub_(hub), membership_(membership) {
    hub_.enter(*this);
  }
  ~Member() override { hub_.leave(*this); }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  void publish(const Message& message) override {
    assert(membership_.publishes.has(topic_of(message)));
    if (const auto arrives = as_it_arrives(message)) return hub_.publish(*this, *arrives);
    log_warning(membership_.self.name, "a message of topic " +
                                           std::string(rules_of(topic_of(message)).name) +
                                           " is out of range and was not sent");
  }
  using Bus::take;
  std::vector<Message> take(Topic topic) override {
    assert(membership_.subscribes.has(topic));
    return hub_.take(*this, topic);
  }
  bool wait(Topics topics, Time deadline) override { return hub_.wait(*this, topics, deadline); }

 private:
  friend class Hub;

  bool hears(const Member& other, Topic topic) const {
    return &other != this && membership_.subscribes.has(topic) &&
           membership_.self.protocol == other.membership_.self.protocol;
  }
  void receive(const Message& message) {
    const Topic topic = topic_of(message);
    inboxes_[topic].add(key_of(message), message, rules_of(topic).depth);
    arrived_.notify_all();
  }
  PresenceChange arrival_of(const Member& other) const {
    return membership_.self.protocol == other.membership_.self.protocol
               ? PresenceChange::joined
               : PresenceChange::other_version;
  }

  // All that follows is guarded by the hub's lock.
  Hub& hub_;
  const Membership membership_;
  std::condition_variable arrived_;
  std::map<Topic, Inbox> inboxes_;
  std::map<std::pair<Topic, std::string>, Message> kept_;  // of this writer, for late readers
  std::optional<Time> last_status_;                        // while it is called alive
};

void InProcessTransport::Hub::enter(Member& member) {
  const std::scoped_lock lock(mutex_);
  for (Member* other : members_) {
    if (member.membership_.subscribes.has(Topic::presence))
      member.receive(Presence{member.arrival_of(*other), other->membership_.self});
    if (other->membership_.subscribes.has(Topic::presence))
      other->receive(Presence{other->arrival_of(member), member.membership_.self});
    for (const auto& [key, message] : other->kept_)
      if (member.hears(*other, key.first)) member.receive(message);
    if (other->last_status_ && member.hears(*other, Topic::presence))
      member.receive(Presence{PresenceChange::alive, other->membership_.self});
  }
  members_.push_back(&member);
}

void InProcessTransport::Hub::leave(Member& member) {
  const std::scoped_lock lock(mutex_);
  std::erase(members_, &member);
  std::erase_if(owners_, [&member](const auto& entry) { return entry.second.member == &member; });
  for (Member* other : members_)
    if (other->membership_.subscribes.has(Topic::presence))
      other->receive(Presence{PresenceChange::left, member.membership_.self});
}

void InProcessTransport::Hub::publish(Member& from, const Message& message) {
  const std::scoped_lock lock(mutex_);
  const Time now = std::chrono::steady_clock::now();
  const Topic topic = topic_of(message);
  const std::string key = key_of(message);
  if (rules_of(topic).exclusive && !owns(from, topic, key, now)) return;
  if (rules_of(topic).for_late_readers) from.kept_.insert_or_assign({topic, key}, message);
  for (Member* member : members_)
    if (member->hears(from, topic)) member->receive(message);
  if (topic != Topic::tile_status) return;
  if (!from.last_status_) tell({PresenceChange::alive, from.membership_.self}, from);
  from.last_status_ = now;
}

bool InProcessTransport::Hub::owns(const Member& from, Topic topic, const std::string& key,
                                   Time now) {
  Owner& owner = owners_[{topic, key}];
  const bool other_holds = owner.member && owner.member != &from &&
                           now - owner.last <= rules_of(topic).lease &&
                           owner.member->membership_.strength >= from.membership_.strength;
  if (!other_holds) owner = {&from, now};
  return !other_holds;
}

void InProcessTransport::Hub::tell(const Presence& presence, const Member& about) {
  for (Member* member : members_)
    if (member->hears(about, Topic::presence)) member->receive(presence);
}

void InProcessTransport::Hub::mark_silent(Time now) {
  for (Member* member : members_)
    if (member->last_status_ && now - *member->last_status_ > rules_of(Topic::tile_status).lease) {
      member->last_status_.reset();
      tell({PresenceChange::silent, member->membership_.self}, *member);
    }
}

Time InProcessTransport::Hub::next_silence() const {
  Time next = Time::max();
  for (const Member* member : members_)
    if (member->last_status_)
      next = std::min(next, *member->last_status_ + rules_of(Topic::tile_status).lease);
  return next == Time::max() ? next : next + std::chrono::milliseconds(1);
}

std::vector<Message> InProcessTransport::Hub::take(Member& member, Topic topic) {
  const std::scoped_lock lock(mutex_);
  mark_silent(std::chrono::steady_clock::now());
  return member.inboxes_[topic].take();
}

bool InProcessTransport::Hub::wait(Member& member, Topics topics, Time deadline) {
  std::unique_lock lock(mutex_);
  const auto arrived = [&] {
    return std::ranges::any_of(member.inboxes_, [&](const auto& inbox) {
      return topics.has(inbox.first) && !inbox.second.empty();
    });
  };
  while (true) {
    const Time now = std::chrono::steady_clock::now();
    mark_silent(now);
    if (arrived()) return true;
    if (now >= deadline) return false;
    member.arrived_.wait_until(lock, std::min(deadline, next_silence()));
  }
}

InProcessTransport::InProcessTransport() : hub_(std::make_unique<Hub>()) {}
InProcessTransport::~InProcessTransport() = default;

std::unique_ptr<Bus> InProcessTransport::join(const Membership& membership) {
  internal::text_of(membership.self);  // the same names as over the network
  return std::make_unique<Member>(*hub_, membership);
}

}  // namespace vindu
