#include "cluster/dds.h"

#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <map>
#include <set>

#include "cluster/interfaces.h"
#include "cluster/internal/dds_entity.h"
#include "cluster/internal/dds_security.h"
#include "cluster/internal/participant_text.h"
#include "cluster/internal/role_marks.h"
#include "cluster/internal/signal.h"
#include "cluster/internal/wire_types.h"

namespace vindu {
namespace {

using internal::DdsEntity;
using internal::Signal;
using internal::WireOf;

constexpr int kMostDomains = 230;
constexpr int kBatch = 16;

const dds_topic_descriptor_t& descriptor_of(Topic topic) {
  return internal::with_type_of(topic, []<class M>(M*) -> const dds_topic_descriptor_t& {
    if constexpr (std::same_as<M, Presence>)
      return WireOf<StatusMessage>::descriptor();
    else
      return WireOf<M>::descriptor();
  });
}

internal::DdsQos qos_of(Topic topic) {
  const TopicRules& rules = rules_of(topic);
  internal::DdsQos qos = internal::make_dds_qos();
  dds_qset_reliability(qos.get(),
                       rules.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(10));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, rules.depth);
  if (rules.for_late_readers) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  if (rules.exclusive) dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  if (rules.lease > Duration())
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, rules.lease.count());
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

std::string interfaces() {
  std::string text;
  for (const NetworkInterface& each : network_interfaces())
    text += (text.empty() ? "" : ", ") + each.name;
  return text;
}

/// Cyclone's domain in this process. Those are numbered per process; what other processes see is
/// the external number in the configuration.
DdsEntity open_domain(const DdsSettings& settings) {
  internal::log_what_dds_says(settings.credentials.has_value());
  const char* const environment = std::getenv("CYCLONEDDS_URI");
  const std::string xml = dds_configuration(settings, environment ? environment : "");
  for (dds_domainid_t id = 0; id < kMostDomains; ++id) {
    const dds_entity_t domain = dds_create_domain(id, xml.c_str());
    if (domain > 0) return {domain, "a domain"};
    if (domain != DDS_RETCODE_PRECONDITION_NOT_MET) break;
  }
  if (environment)
    throw Error({.what = "Cyclone DDS does not start with CYCLONEDDS_URI",
                 .where = environment,
                 .remedy = "see its messages above; unset it for Vindu's own settings"});
  throw Error({.what = "the network cannot be joined",
               .where = "interface " + settings.interface,
               .remedy = "there are: " + interfaces() +
                         "; where its ports are in use (above), give [cluster] another domain"});
}

/// Throws Error where a key's permissions forbid it.
dds_entity_t expect_allowed(dds_entity_t entity, Topic topic, const Participant& self) {
  if (entity == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
    throw Error({.what = "the key of this " + std::string(name_of(self.role)) +
                         " does not allow it to take part in the topic " +
                         std::string(rules_of(topic).name),
                 .where = self.name,
                 .remedy = "make it anew with this version: vindu keys --renew"});
  assert(entity > 0);
  return entity;
}

/// Samples of one topic as Cyclone writes them: flat structs in our own memory.
class SampleBuffer {
 public:
  explicit SampleBuffer(const dds_topic_descriptor_t& type)
      : size_((type.m_size + 7) / 8), memory_(size_ * kBatch) {
    for (int i = 0; i < kBatch; ++i) pointers_[i] = memory_.data() + i * size_;
  }

  /// Calls use(sample, info) for all that there are.
  template <class Use>
  void take(dds_entity_t reader, Use use) {
    std::array<dds_sample_info_t, kBatch> infos;
    int count = 0;
    do {
      count = dds_take(reader, pointers_.data(), infos.data(), kBatch, kBatch);
      for (int i = 0; i < count; ++i) use(pointers_[i], infos[i]);
    } while (count == kBatch);
  }

 private:
  std::size_t size_;
  std::vector<std::uint64_t> memory_;
  std::array<void*, kBatch> pointers_{};
};

}  // namespace

class DdsTransport::Domain {
 public:
  explicit Domain(const DdsSettings& settings)
      : credentials_(settings.credentials), entity_(open_domain(settings)) {
    dds_domainid_t id = 0;
    dds_get_domainid(entity_.get(), &id);
    id_ = id;
  }
  dds_domainid_t id() const { return id_; }
  const std::optional<Credentials>& credentials() const { return credentials_; }

 private:
  std::optional<Credentials> credentials_;
  DdsEntity entity_;
  dds_domainid_t id_ = 0;
};

class DdsTransport::Member final : public Bus {
 public:
  Member(const Domain& domain, const Membership& membership);

  void publish(const Message& message) override;
  using Bus::take;
  std::vector<Message> take(Topic topic) override;
  bool wait(Topics topics, Time deadline) override { return signal_.wait(topics, deadline); }

 private:
  /// What a listener is told: whom to wake, and why.
  struct Wake {
    Signal* signal = nullptr;
    Topic topic{};
  };
  struct Reader {
    dds_entity_t handle = 0;
    std::unique_ptr<SampleBuffer> buffer;
    unsigned refused = 0;
  };

  dds_entity_t topic_entity(Topic topic);
  void open_writer(Topic topic);
  dds_entity_t open_reader(dds_entity_t of, const dds_qos_t* qos, Topic wakes);
  void open_presence();
  std::vector<Message> take_presence();
  void take_participants(std::vector<Message>& changes);
  void take_silences(std::vector<Message>& changes);
  void believe(std::vector<Message>& changes);
  void joined(dds_instance_handle_t id, const Participant& who, std::vector<Message>& changes);
  void arrived(dds_instance_handle_t id, const dds_qos_t* qos, std::vector<Message>& changes);

  const bool with_keys_;
  const Membership membership_;
  Signal signal_;
  std::array<Wake, kTopics> wakes_;
  std::array<dds_entity_t, kTopics> topics_{};
  std::array<dds_entity_t, kTopics> writers_{};
  std::array<Reader, kTopics> readers_;
  std::atomic<unsigned> unsent_ = 0;
  dds_entity_t participants_reader_ = 0;
  internal::RoleMarks marks_;
  std::map<dds_instance_handle_t, Participant> claims_, present_;
  std::set<std::string> alive_;  // tiles
  DdsEntity participant_;        // the last member, so the first to go: no listener outlives it
};

DdsTransport::Member::Member(const Domain& domain, const Membership& membership)
    : with_keys_(domain.credentials().has_value()), membership_(membership) {
  const std::string text = internal::text_of(membership.self);
  const internal::DdsQos qos = internal::make_dds_qos();
  dds_qset_userdata(qos.get(), text.data(), text.size());
  if (domain.credentials()) internal::add_credentials(qos.get(), *domain.credentials());
  participant_ = {dds_create_participant(domain.id(), qos.get(), nullptr), "a participant"};
  if (with_keys_) marks_.show(participant_.get(), membership.self.role);
  for (int i = 0; i < kTopics; ++i) {
    const auto topic = static_cast<Topic>(i);
    wakes_[i] = {&signal_, topic};
    if (topic == Topic::presence) continue;
    if (membership.publishes.has(topic)) open_writer(topic);
    if (!membership.subscribes.has(topic)) continue;
    readers_[i].buffer = std::make_unique<SampleBuffer>(descriptor_of(topic));
    readers_[i].handle = open_reader(topic_entity(topic), qos_of(topic).get(), topic);
  }
  if (membership.subscribes.has(Topic::presence)) open_presence();
}

dds_entity_t DdsTransport::Member::topic_entity(Topic topic) {
  dds_entity_t& entity = topics_[static_cast<std::size_t>(topic)];
  if (entity > 0) return entity;
  const std::string name =
      "v" + std::to_string(membership_.self.protocol) + "/" + std::string(rules_of(topic).name);
  entity =
      dds_create_topic(participant_.get(), &descriptor_of(topic), name.c_str(), nullptr, nullptr);
  return expect_allowed(entity, topic, membership_.self);
}

void DdsTransport::Member::open_writer(Topic topic) {
  const internal::DdsQos qos = qos_of(topic);
  if (rules_of(topic).exclusive) dds_qset_ownership_strength(qos.get(), membership_.strength);
  const dds_entity_t writer =
      dds_create_writer(participant_.get(), topic_entity(topic), qos.get(), nullptr);
  writers_[static_cast<std::size_t>(topic)] = expect_allowed(writer, topic, membership_.self);
}

dds_entity_t DdsTransport::Member::open_reader(dds_entity_t of, const dds_qos_t* qos, Topic wakes) {
  const internal::DdsListener listener =
      internal::make_dds_listener(&wakes_[static_cast<std::size_t>(wakes)]);
  dds_lset_data_available(listener.get(), [](dds_entity_t, void* argument) {
    const Wake& wake = *static_cast<const Wake*>(argument);
    wake.signal->raise(wake.topic);
  });
  const dds_entity_t reader = dds_create_reader(participant_.get(), of, qos, listener.get());
  return expect_allowed(reader, wakes, membership_.self);
}

/// Who is there comes from DDS' own list of participants; that a tile is silent, from a second
/// reader of tile_status, whose instances (one each tile) end when their writer's lease does.
void DdsTransport::Member::open_presence() {
  Reader& reader = readers_[static_cast<std::size_t>(Topic::presence)];
  reader.buffer = std::make_unique<SampleBuffer>(descriptor_of(Topic::tile_status));
  reader.handle = open_reader(topic_entity(Topic::tile_status), qos_of(Topic::tile_status).get(),
                              Topic::presence);
  if (with_keys_) {
    const internal::DdsListener news =
        internal::make_dds_listener(&wakes_[static_cast<std::size_t>(Topic::presence)]);
    dds_lset_subscription_matched(
        news.get(), [](dds_entity_t, dds_subscription_matched_status_t, void* argument) {
          const Wake& wake = *static_cast<const Wake*>(argument);
          wake.signal->raise(wake.topic);
        });
    marks_.watch(participant_.get(), news.get());
  }
  participants_reader_ = open_reader(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, Topic::presence);
}

void DdsTransport::Member::publish(const Message& message) {
  const Topic topic = topic_of(message);
  const dds_entity_t writer = writers_[static_cast<std::size_t>(topic)];
  assert(writer > 0);
  const bool sent = std::visit(
      [writer]<class M>(const M& value) {
        if constexpr (std::same_as<M, Presence>) {
          return false;
        } else {
          typename WireOf<M>::type wire;
          return internal::to_wire(value, wire) && dds_write(writer, &wire) == DDS_RETCODE_OK;
        }
      },
      message);
  if (sent) return;
  if (const unsigned unsent = ++unsent_; std::has_single_bit(unsent))
    log_warning(membership_.self.name, std::to_string(unsent) + " messages were not sent so far, " +
                                           "this one of topic " +
                                           std::string(rules_of(topic).name));
}

std::vector<Message> DdsTransport::Member::take(Topic topic) {
  signal_.lower(topic);
  if (topic == Topic::presence) return take_presence();
  Reader& reader = readers_[static_cast<std::size_t>(topic)];
  assert(reader.handle > 0);
  std::vector<Message> messages;
  const unsigned refused_before = reader.refused;
  internal::with_type_of(topic, [&]<class M>(M*) {
    if constexpr (!std::same_as<M, Presence>)
      reader.buffer->take(reader.handle, [&](const void* sample, const dds_sample_info_t& info) {
        if (!info.valid_data) return;
        auto message =
            internal::from_wire<M>(*static_cast<const typename WireOf<M>::type*>(sample));
        if (message)
          messages.emplace_back(*std::move(message));
        else
          ++reader.refused;
      });
  });
  // At 1, 2, 4, 8 ... of them: a flood fills no log.
  if (std::bit_width(reader.refused) != std::bit_width(refused_before))
    log_warning(membership_.self.name, std::to_string(reader.refused) +
                                           " malformed messages of topic " +
                                           std::string(rules_of(topic).name) + " left out so far");
  return messages;
}

std::vector<Message> DdsTransport::Member::take_presence() {
  std::vector<Message> changes;
  take_participants(changes);
  if (with_keys_) believe(changes);
  take_silences(changes);
  return changes;
}

void DdsTransport::Member::take_participants(std::vector<Message>& changes) {
  std::array<void*, kBatch> samples{};
  std::array<dds_sample_info_t, kBatch> infos;
  int count = 0;
  do {
    count = dds_take(participants_reader_, samples.data(), infos.data(), kBatch, kBatch);
    for (int i = 0; i < count; ++i) {
      const dds_instance_handle_t id = infos[i].instance_handle;
      if (infos[i].instance_state == DDS_IST_ALIVE && infos[i].valid_data)
        arrived(id, static_cast<dds_builtintopic_participant_t*>(samples[i])->qos, changes);
      else if (const auto gone = present_.extract(id))
        changes.emplace_back(Presence{PresenceChange::left, gone.mapped()});
      else
        claims_.erase(id);
    }
    if (count > 0) dds_return_loan(participants_reader_, samples.data(), count);
  } while (count == kBatch);
}

void DdsTransport::Member::arrived(dds_instance_handle_t id, const dds_qos_t* qos,
                                   std::vector<Message>& changes) {
  dds_instance_handle_t own = 0;
  dds_get_instance_handle(participant_.get(), &own);
  void* data = nullptr;
  std::size_t size = 0;
  if (id == own || !dds_qget_userdata(qos, &data, &size) || !data) return;
  const auto who = internal::participant_from({static_cast<const char*>(data), size});
  dds_free(data);
  if (!who) return;
  if (with_keys_)
    claims_.emplace(id, *who);
  else
    joined(id, *who, changes);
}

/// Those whose role is proven by now.
void DdsTransport::Member::believe(std::vector<Message>& changes) {
  if (claims_.empty()) return;
  for (const auto& [id, role] : marks_.proven())
    if (const auto claim = claims_.find(id); claim != claims_.end() && claim->second.role == role) {
      joined(id, claim->second, changes);
      claims_.erase(claim);
    }
}

void DdsTransport::Member::joined(dds_instance_handle_t id, const Participant& who,
                                  std::vector<Message>& changes) {
  if (!present_.emplace(id, who).second) return;
  const bool understood = who.protocol == membership_.self.protocol;
  changes.emplace_back(
      Presence{understood ? PresenceChange::joined : PresenceChange::other_version, who});
}

void DdsTransport::Member::take_silences(std::vector<Message>& changes) {
  const auto tell = [&](PresenceChange change, const std::string& tile) {
    Participant who{.role = Role::tile, .name = tile};
    for (const auto& [id, participant] : present_)
      if (participant.name == tile) who = participant;
    changes.emplace_back(Presence{change, who});
  };
  const Reader& reader = readers_[static_cast<std::size_t>(Topic::presence)];
  reader.buffer->take(reader.handle, [&](const void* sample, const dds_sample_info_t& info) {
    const std::string tile = static_cast<const vindu_wire_TileStatus*>(sample)->tile;
    if (info.instance_state == DDS_IST_ALIVE) {
      if (alive_.insert(tile).second) tell(PresenceChange::alive, tile);
    } else if (alive_.erase(tile) > 0) {
      tell(PresenceChange::silent, tile);
    }
  });
}

DdsTransport::DdsTransport(const DdsSettings& settings)
    : domain_(std::make_unique<Domain>(settings)) {}
DdsTransport::~DdsTransport() = default;

std::unique_ptr<Bus> DdsTransport::join(const Membership& membership) {
  return std::make_unique<Member>(*domain_, membership);
}

}  // namespace vindu
