// What a machine is for a wall: its tiles and cameras there, the network, the keys, and the
// programs that reach hosts.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "app/common.h"
#include "app/doctor.h"
#include "app/launch.h"
#include "app/wall_console.h"
#include "cluster/interfaces.h"
#include "cluster/keys/key_folder.h"
#include "cluster/launch/node_set.h"
#include "cluster/wall_view.h"
#include "core/error.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> tiles_of(const Site& site, const std::string& host) {
  std::vector<std::string> names;
  for (const Tile& tile : site.wall.tiles)
    if (tile.host == host) names.push_back(tile.name);
  return names;
}

bool master_is_here(const Site& site) {
  return !has_hosts(site) || site.cluster.master == host_name();
}

Finding examine_camera(const CameraConfig& camera) {
  const fs::path source = camera.video.file.empty() ? camera.video.device : camera.video.file;
  const std::string what = fmt::format("{} of the wall file: {}", camera.name, source.string());
  std::error_code error;
  if (!fs::exists(source, error) && source.string().find('%') == std::string::npos)
    return {"cameras", Health::bad, what + " is not there", "plug it in, or correct the wall file"};
  return {"cameras", Health::good, what};
}

std::string described(const NetworkInterface& interface) {
  return fmt::format("{} ({})", interface.name,
                     interface.addresses.empty()
                         ? "no address"
                         : fmt::format("{}", fmt::join(interface.addresses, ", ")));
}

/// Those that a wall over hosts could use.
std::string usable(const std::vector<NetworkInterface>& interfaces) {
  std::vector<std::string> names;
  for (const NetworkInterface& interface : interfaces)
    if (!interface.loopback && !interface.addresses.empty()) names.push_back(described(interface));
  return names.empty() ? "there is no other with an address"
                       : fmt::format("there are: {}", fmt::join(names, ", "));
}

Finding examine_interface(const ClusterConfig& cluster) {
  const std::vector<NetworkInterface> interfaces = network_interfaces();
  if (std::getenv("CYCLONEDDS_URI"))
    return {"network", Health::note,
            "CYCLONEDDS_URI stands in the place of the wall file's network",
            "unset it for Vindu's own settings"};
  if (cluster.interface.empty())
    return {"network", Health::good, "the interface is chosen by DDS; " + usable(interfaces)};
  const auto own = std::ranges::find(interfaces, cluster.interface, &NetworkInterface::name);
  if (own == interfaces.end())
    return {"network", Health::bad, "there is no interface " + cluster.interface,
            "[cluster] interface; " + usable(interfaces)};
  const std::string what = "interface " + described(*own);
  if (!own->running)
    return {"network", Health::bad, what + " is down", "see to its cable; " + usable(interfaces)};
  if (own->addresses.empty())
    return {"network", Health::bad, what, "give it an IPv4 address; " + usable(interfaces)};
  if (cluster.multicast && !own->multicast && !own->loopback)
    return {"network", Health::bad, what + " has no multicast", "[cluster] multicast = false"};
  return {"network", Health::good, what};
}

/// For a wall over hosts.
Findings examine_names(const Site& site) {
  std::vector<std::string> hosts, unknown;
  for (const HostPlan& plan : host_plans(site)) hosts.push_back(plan.host);
  std::ranges::copy_if(hosts, std::back_inserter(unknown),
                       [](const std::string& host) { return !has_address(host); });
  if (!unknown.empty())
    return {{"network", Health::bad, "no address is known of " + fold_names(unknown),
             "add them to /etc/hosts or DNS, or correct the wall file"}};
  return {{"network", Health::good, fold_names(hosts) + ": all have addresses"}};
}

/// The owners whose keys this machine needs.
std::vector<KeyOwner> owners_here(const Site& site) {
  std::vector<KeyOwner> owners{{Role::console}};
  if (master_is_here(site)) owners.push_back({Role::master});
  for (const HostPlan& plan : host_plans(site))
    if (!plan.tiles.empty() && (!has_hosts(site) || plan.host == host_name()))
      owners.push_back({Role::tile, plan.host});
  return owners;
}

std::string remedy_for(KeyState state) {
  if (state == KeyState::missing) return "bring it: vindu deploy; or make it: vindu keys";
  if (state == KeyState::unusable) return "bring it again: vindu deploy";
  return "vindu keys --renew, then vindu deploy";
}

/// Consoles are not on every host: a missing key of theirs is a note.
Findings examine_keys(const Site& site) {
  Findings findings;
  if (site.cluster.keys.empty()) return findings;
  std::vector<std::string> good;
  for (const KeyOwner& owner : owners_here(site)) {
    const KeyInfo key = inspect_key(site.cluster.keys, owner);
    if (key.state == KeyState::good) {
      good.push_back(name_of(owner));
      continue;
    }
    const bool minor = key.state == KeyState::ends_soon ||
                       (key.state == KeyState::missing && owner.role == Role::console);
    findings.push_back({"keys", minor ? Health::note : Health::bad,
                        fmt::format("{}: {}{}{}", name_of(owner), name_of(key.state),
                                    key.why.empty() ? "" : ": ", key.why),
                        remedy_for(key.state)});
  }
  if (!good.empty())
    findings.push_back({"keys", Health::good, fmt::format("{}", fmt::join(good, ", "))});
  return findings;
}

/// Joins the wall as a console does, and listens.
Finding listen(const Site& site) {
  constexpr auto kListen = std::chrono::milliseconds(1500);
  try {
    DdsTransport transport(network_of(site, Role::console));
    const Participant self = this_console(site);
    const auto bus = transport.join({self, {}, WallView::hears()});
    WallView view(tile_names(site.wall), self);
    const MonotonicClock clock;
    for (const Time end = clock.now() + kListen; clock.now() < end;) {
      bus->wait(WallView::hears(), end);
      view.poll(*bus, clock.now());
    }
    const WallNow& wall = view.now();
    if (!wall.master && wall.frame == 0)
      return {"wall", Health::note,
              "the wall \"" + site.cluster.name + "\" does not run, as far as is heard here",
              "light it: vindu launch"};
    return {"wall", wall.good() ? Health::good : Health::note,
            "the wall \"" + site.cluster.name + "\" runs: " + summary_of(wall)};
  } catch (const Error& error) {
    return {"wall", Health::bad, error.what()};
  }
}

bool in_path(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

Findings examine_role(const Site& site) {
  if (!has_hosts(site))
    return {{"wall", Health::good, "all tiles and the master run on this machine"}};
  const std::string here = host_name();
  const std::vector<std::string> tiles = tiles_of(site, here);
  std::vector<std::string> parts;
  if (master_is_here(site)) parts.emplace_back("the master");
  if (!tiles.empty()) parts.push_back(fold_names(tiles));
  if (parts.empty())
    return {{"wall", Health::note, here + " has no part in the wall but to control it",
             "a host that has one is called in the wall file as it calls itself (uname -n)"}};
  return {{"wall", Health::good, fmt::format("{} is {}", here, fmt::join(parts, " and "))}};
}

Findings examine_cameras_of(const Site& site) {
  Findings findings;
  if (!master_is_here(site)) return findings;
  for (const CameraConfig& camera : site.cameras)
    if (camera.source == CameraSource::video) findings.push_back(examine_camera(camera));
  return findings;
}

Findings examine_network(const Site& site) {
  Findings findings{examine_interface(site.cluster)};
  if (has_hosts(site)) std::ranges::copy(examine_names(site), std::back_inserter(findings));
  std::ranges::copy(examine_keys(site), std::back_inserter(findings));
  findings.push_back(listen(site));
  return findings;
}

Findings examine_programs(const Site& site) {
  Findings findings;
  if (!has_hosts(site)) return findings;
  for (const auto& [program, package] :
       {std::pair("clush", "clustershell"), {"ssh", "openssh-client"}, {"rsync", "rsync"}})
    if (in_path(program))
      findings.push_back({"programs", Health::good, program});
    else
      findings.push_back({"programs", Health::note,
                          fmt::format("no {}: launch, deploy, restart, logs and stop do not work "
                                      "from here",
                                      program),
                          fmt::format("sudo apt-get install {}", package)});
  return findings;
}

}  // namespace vindu::app
