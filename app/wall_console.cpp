#include "app/wall_console.h"

#include <unistd.h>

#include <algorithm>

#include "app/common.h"
#include "cluster/keys/key_folder.h"

namespace vindu::app {

DdsSettings network_of(const Site& site, Role role, const std::string& tile) {
  DdsSettings settings = dds_settings_of(site.cluster);
  if (site.cluster.keys.empty()) return settings;
  KeyOwner owner{role};
  const auto own = std::ranges::find(site.wall.tiles, tile, &Tile::name);
  if (own != site.wall.tiles.end()) owner.host = own->host;
  settings.credentials = read_credentials(site.cluster.keys, owner);
  return settings;
}

Participant this_participant(Role role, const std::string& name, const Site& site,
                             std::uint64_t epoch) {
  return {.role = role,
          .name = name,
          .host = host_name(),
          .version = VINDU_VERSION,
          .epoch = epoch,
          .wall = fingerprint_of(site.wall)};
}

Participant this_console(const Site& site) {
  return this_participant(Role::console, "console-" + host_name() + "-" + std::to_string(getpid()),
                          site);
}

std::vector<std::string> tile_names(const Wall& wall) {
  std::vector<std::string> names;
  for (const Tile& tile : wall.tiles) names.push_back(tile.name);
  return names;
}

}  // namespace vindu::app
