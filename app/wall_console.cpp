#include "app/wall_console.h"

#include <unistd.h>

#include "app/common.h"

namespace vindu::app {

Participant this_console() {
  return {.role = Role::console,
          .name = "console-" + host_name() + "-" + std::to_string(getpid()),
          .host = host_name(),
          .version = VINDU_VERSION};
}

std::vector<std::string> tile_names(const Wall& wall) {
  std::vector<std::string> names;
  for (const Tile& tile : wall.tiles) names.push_back(tile.name);
  return names;
}

}  // namespace vindu::app
