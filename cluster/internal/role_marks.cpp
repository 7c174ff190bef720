#include "cluster/internal/role_marks.h"

#include <algorithm>

#include "wire.h"

namespace vindu::internal {
namespace {

dds_entity_t topic_of(dds_entity_t participant, Role role) {
  return dds_create_topic(participant, &vindu_wire_RoleMark_desc, mark_of(role).c_str(), nullptr,
                          nullptr);
}

dds_entity_t expect_right(dds_entity_t entity, Role role) {
  if (entity < 0)
    throw Error({.what = "the key is not the " + std::string(name_of(role)) + "'s, or is of " +
                         "another version (" + dds_strretcode(entity) + ")",
                 .where = mark_of(role),
                 .remedy = "make it again: vindu keys --renew"});
  return entity;
}

}  // namespace

void RoleMarks::show(dds_entity_t participant, Role own) {
  const dds_entity_t topic = expect_right(topic_of(participant, own), own);
  expect_right(dds_create_writer(participant, topic, nullptr, nullptr), own);
}

void RoleMarks::watch(dds_entity_t participant, const dds_listener_t* news) {
  for (const Role role : kRoles) {
    const dds_entity_t topic = expect_right(topic_of(participant, role), role);
    readers_[role] = expect_right(dds_create_reader(participant, topic, nullptr, news), role);
  }
}

std::multimap<dds_instance_handle_t, Role> RoleMarks::proven() const {
  std::multimap<dds_instance_handle_t, Role> roles;
  for (const auto& [role, reader] : readers_) {
    const int count = dds_get_matched_publications(reader, nullptr, 0);
    std::vector<dds_instance_handle_t> writers(static_cast<std::size_t>(std::max(count, 0)));
    dds_get_matched_publications(reader, writers.data(), writers.size());
    for (const dds_instance_handle_t handle : writers) {
      // Empty where it has gone meanwhile.
      dds_builtintopic_endpoint_t* const writer = dds_get_matched_publication_data(reader, handle);
      if (!writer) continue;
      roles.emplace(writer->participant_instance_handle, role);
      dds_builtintopic_free_endpoint(writer);
    }
  }
  return roles;
}

}  // namespace vindu::internal
