#include "app/runtime_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "core/sha256.h"

namespace vindu::app {
namespace {

/// systemd's, which is the user's own.
std::string users_folder() {
  const char* const folder = std::getenv("XDG_RUNTIME_DIR");
  return folder ? folder : "";
}

/// Makes it for this user alone. One that is there already must be so: others may have made it.
void make_private(const std::string& folder) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw Error({std::string("cannot be made: ") + std::strerror(errno), folder,
                 "set XDG_RUNTIME_DIR to a folder of yours"});
  struct stat state {};
  const bool own = lstat(folder.c_str(), &state) == 0 && S_ISDIR(state.st_mode) &&
                   state.st_uid == geteuid() && (state.st_mode & 022) == 0;
  if (!own)
    throw Error({"is no folder that you alone may write to", folder,
                 "remove it, or set XDG_RUNTIME_DIR to one of yours"});
}

}  // namespace

std::string runtime_folder(const ClusterConfig& cluster) {
  std::string user = users_folder();
  if (user.empty()) make_private(user = fmt::format("/tmp/vindu-{}", geteuid()));
  std::string folder = user + "/" + runtime_folder_name(cluster);
  make_private(folder);
  return folder;
}

std::string runtime_folder_name(const ClusterConfig& cluster) {
  constexpr std::size_t kLongest = 100;  // of a name that a file may have as well
  const std::string& name = cluster.name;
  const std::string short_name =
      name.size() <= kLongest ? name
                              : name.substr(0, kLongest) + "-" + sha256_of_text(name).substr(0, 16);
  return fmt::format("vindu-{}-{}", cluster.domain, short_name);
}

}  // namespace vindu::app
