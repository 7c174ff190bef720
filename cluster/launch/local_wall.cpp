#include "cluster/launch/local_wall.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <thread>

#include "cluster/launch/node_set.h"
#include "core/error.h"

namespace vindu {

std::vector<std::string> master_words(const LaunchRequest& request) {
  std::vector<std::string> words{request.program, "master", "--wall", request.wall_file};
  words.insert(words.end(), request.master_arguments.begin(), request.master_arguments.end());
  return words;
}

std::vector<std::string> tile_words(const LaunchRequest& request,
                                    const std::vector<std::string>& tiles) {
  std::vector<std::string> words{request.program, "tile"};
  words.insert(words.end(), tiles.begin(), tiles.end());
  words.insert(words.end(), {"--wall", request.wall_file});
  words.insert(words.end(), request.tile_arguments.begin(), request.tile_arguments.end());
  return words;
}

std::vector<ProcessPlan> local_wall(const LaunchRequest& request, const Wall& wall,
                                    int tiles_per_process) {
  const auto most = static_cast<std::size_t>(tiles_per_process);
  std::vector<ProcessPlan> plans{{"master", master_words(request), true}};
  for (std::size_t first = 0; first < wall.tiles.size(); first += most) {
    std::vector<std::string> tiles;
    for (std::size_t i = first; i < std::min(first + most, wall.tiles.size()); ++i)
      tiles.push_back(wall.tiles[i].name);
    plans.push_back({fold_names(tiles), tile_words(request, tiles)});
  }
  return plans;
}

WallClaim::WallClaim(const ClusterConfig& cluster)
    : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  // A name of the abstract namespace: no file, and as far as a loopback interface reaches.
  const std::string name = "vindu/" + std::to_string(cluster.domain) + "/" + cluster.name;
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::size_t length = std::min(name.size(), sizeof address.sun_path - 1);
  std::memcpy(address.sun_path + 1, name.data(), length);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0)
    throw Error({"a wall of this name runs on this machine", cluster.name,
                 "stop it (vindu stop), or give this one another name in its [cluster]"});
}

bool wait_until_ended(const ClusterConfig& cluster, Duration patience) {
  const auto runs = [&] {
    try {
      const WallClaim claim(cluster);
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  for (const Time limit = std::chrono::steady_clock::now() + patience; runs();) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace vindu
