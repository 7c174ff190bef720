#include "cluster/roll.h"

#include <fmt/format.h>

#include <algorithm>

#include "cluster/launch/node_set.h"

namespace vindu {

void Roll::hear(const Presence& presence) {
  if (presence.who.role == Role::console) return;  // what is wrong with it is told there
  const auto same = std::ranges::find(others_, presence.who);
  if (presence.change == PresenceChange::left && same != others_.end()) others_.erase(same);
  if (presence.change == PresenceChange::joined || presence.change == PresenceChange::other_version)
    others_.push_back(presence.who);
}

std::vector<Participant> Roll::masters() const {
  std::vector<Participant> masters;
  for (const Participant& other : others_)
    if (other.role == Role::master && other.protocol == self_.protocol) masters.push_back(other);
  return masters;
}

std::optional<Participant> Roll::master() const {
  const std::vector<Participant> all = masters();
  const auto newest = std::ranges::max_element(all, {}, &Participant::epoch);
  return newest == all.end() ? std::nullopt : std::optional(*newest);
}

bool Roll::has_tile(const std::string& name) const {
  return std::ranges::any_of(others_, [&](const Participant& other) {
    return other.role == Role::tile && other.name == name && other.protocol == self_.protocol;
  });
}

std::vector<std::string> Roll::trackers() const {
  std::vector<std::string> names;
  for (const Participant& other : others_)
    if (other.role == Role::tracker && other.protocol == self_.protocol)
      names.push_back(other.name);
  return names;
}

std::vector<std::string> Roll::hosts_of_masters() const {
  std::vector<std::string> hosts;
  if (self_.role == Role::master) hosts.push_back(self_.host);
  for (const Participant& other : masters()) hosts.push_back(other.host);
  return hosts;
}

std::string Roll::wall_of_master() const {
  if (self_.role == Role::master) return self_.wall;
  return master().value_or(Participant{}).wall;
}

/// What is drawn and tracked is measured by the master's.
void Roll::complain_of_walls(std::vector<std::string>& lines) const {
  const std::string wall = wall_of_master();
  const auto differs = [&](const Participant& who) {
    return !who.wall.empty() && !wall.empty() && who.wall != wall;
  };
  if (self_.role == Role::console && differs(self_))
    lines.push_back(
        fmt::format("the master on {} has another wall than the wall file here; name "
                    "that file (--wall)",
                    master()->host));
  std::vector<std::string> others;
  for (const Participant& other : others_)
    if ((other.role == Role::tile || other.role == Role::tracker) && differs(other))
      others.push_back(other.name);
  if (!others.empty())
    lines.push_back(fold_names(others) +
                    ": the wall of another wall file than the master's, so what is seen is wrong; "
                    "bring that (vindu deploy), or start with it (--wall)");
}

std::vector<std::string> Roll::complaints() const {
  std::vector<std::string> lines;
  for (const Participant& other : others_)
    if (other.protocol != self_.protocol) lines.push_back(version_complaint(self_, other));
  if (const auto hosts = hosts_of_masters(); hosts.size() > 1)
    lines.push_back(fmt::format("{} masters, on {}: tiles follow the newer one; end the other",
                                hosts.size(), fmt::join(hosts, " and ")));
  complain_of_walls(lines);
  return lines;
}

}  // namespace vindu
