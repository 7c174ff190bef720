#include "app/wall_console.h"

#include <unistd.h>

#include <array>

namespace vindu::app {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

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
