// Cyclone's configuration. Discovery by a star (peers are announced to every 250 ms; the default of
// 8 s is what tiles would wait that start before the master) or, where no master is named, by
// multicast: all hear all there, so each says so as seldom as its lease allows. Data by multicast
// unless that is off. The measurements are cited in decision 6.
#include <algorithm>

#include "cluster/dds.h"

namespace vindu {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string domain_xml(const std::string& content) {
  return "<CycloneDDS><Domain Id=\"any\">" + content + "</Domain></CycloneDDS>";
}

std::string general(const DdsSettings& settings, bool star) {
  std::string xml = "<General>";
  if (!settings.interface.empty())
    xml += "<Interfaces><NetworkInterface name=\"" + escaped(settings.interface) + "\"" +
           (settings.interface == "lo" ? " multicast=\"true\"" : "") + "/></Interfaces>";
  // asm: any-source multicast, for data only.
  const char* const multicast = !settings.multicast ? "false" : star ? "asm" : "true";
  return xml + "<AllowMulticast>" + multicast + "</AllowMulticast></General>";
}

/// A peer is written to at the ports of that many participants of its host, every 250 ms.
std::string star_discovery(const std::vector<std::string>& peers, int participants) {
  std::string xml = "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
                    std::to_string(participants - 1) + "</MaxAutoParticipantIndex><Peers>";
  for (const std::string& peer : peers) xml += "<Peer address=\"" + escaped(peer) + "\"/>";
  return xml + "</Peers>";
}

}  // namespace

DdsSettings dds_settings_of(const ClusterConfig& cluster) {
  DdsSettings settings{.name = cluster.name,
                       .domain = cluster.domain,
                       .interface = cluster.interface,
                       .multicast = cluster.multicast,
                       .peers = {}};
  if (!cluster.master.empty()) settings.peers = {cluster.master};
  return settings;
}

std::string dds_configuration(const DdsSettings& settings, const std::string& environment) {
  const std::string which = "<Tag>" + escaped(settings.name) + "</Tag><ExternalDomainId>" +
                            std::to_string(settings.domain) + "</ExternalDomainId>";
  if (!environment.empty())
    return domain_xml("<Discovery>" + which + "</Discovery>") + "," + environment;
  std::vector<std::string> peers = settings.peers;
  const bool local = peers.empty() && !settings.multicast;
  if (local) peers = {"127.0.0.1"};
  const bool star = !peers.empty();
  return domain_xml(general(settings, star) + "<Discovery>" + which +
                    "<LeaseDuration>1s</LeaseDuration><SPDPInterval>" +
                    (star ? "250ms</SPDPInterval>" + star_discovery(peers, local ? 100 : 12)
                          : "800ms</SPDPInterval>") +
                    "</Discovery>");
}

}  // namespace vindu
