// Who is what, on a wall with keys. What a participant says of itself when it is found is said
// before anybody has asked for its key; so each also has a writer of a topic that only its role may
// write, and is believed by who sees that writer: Cyclone lets no other through. Private to
// cluster.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cluster/internal/dds_entity.h"
#include "cluster/topics.h"

namespace vindu::internal {

class RoleMarks {
 public:
  /// Throws Error where the participant's key is not of that role.
  void show(dds_entity_t participant, Role own);
  /// `news` is told of whoever comes.
  void watch(dds_entity_t participant, const dds_listener_t* news);

  /// Participants, by their handles of DDS' own list, that have proven to have that role.
  std::multimap<dds_instance_handle_t, Role> proven() const;

 private:
  std::map<Role, dds_entity_t> readers_;
};

}  // namespace vindu::internal
