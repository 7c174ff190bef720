// The wall over the network: Eclipse Cyclone DDS, which finds participants, sends again what was
// lost, keeps what late readers need, and notices who is gone. Its types show in no header but
// internal ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cluster/bus.h"
#include "cluster/credentials.h"
#include "core/site.h"

namespace vindu {

/// Loopback, unless it is told otherwise.
struct DdsSettings {
  std::string name = "wall";         ///< of the wall: participants of another name are never seen
  int domain = 0;                    ///< 0 to 230: which UDP ports
  std::string interface = "lo";      ///< network interface; empty: chosen by Cyclone
  bool multicast = true;             ///< for data; discovery uses it on loopback only
  std::vector<std::string> peers{};  ///< hosts to find each other by: the master's and trackers'
  std::optional<Credentials> credentials{};  ///< with these, DDS-Security is on
};

/// Without credentials: those are read by who knows as whom it joins (cluster/keys).
DdsSettings dds_settings_of(const ClusterConfig& cluster);

/// What Cyclone is told. `environment` is CYCLONEDDS_URI; not empty, it stands instead of all but
/// name and domain.
std::string dds_configuration(const DdsSettings& settings, const std::string& environment);

/// Thread-safe. Several of them in one process are like several processes.
class DdsTransport final : public Transport {
 public:
  /// Throws Error where the interface is not there. Cyclone's own messages go to the log, those of
  /// one kind at 1, 2, 4, 8 ... of them.
  explicit DdsTransport(const DdsSettings& settings = {});
  ~DdsTransport() override;

  std::unique_ptr<Bus> join(const Membership& membership) override;

 private:
  class Domain;
  class Member;
  std::unique_ptr<Domain> domain_;
};

}  // namespace vindu
