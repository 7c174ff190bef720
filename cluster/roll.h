// Who is on a wall's bus, and what is wrong about that: another version, a second master, another
// wall file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cluster/topics.h"

namespace vindu {

class Roll {
 public:
  /// `self`: who listens, and counts too. Of the others, consoles do not.
  explicit Roll(Participant self) : self_(std::move(self)) {}

  void hear(const Presence& presence);

  /// Of the others.
  std::vector<Participant> masters() const;
  /// The newest of these, which tiles follow.
  std::optional<Participant> master() const;
  bool has_tile(const std::string& name) const;
  std::vector<std::string> trackers() const;

  /// A line for each thing, as people should be told it.
  std::vector<std::string> complaints() const;

 private:
  std::vector<std::string> hosts_of_masters() const;
  std::string wall_of_master() const;
  void complain_of_walls(std::vector<std::string>& lines) const;

  Participant self_;
  std::vector<Participant> others_;  // in the order in which they came
};

}  // namespace vindu
