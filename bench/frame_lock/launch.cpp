#include "bench/frame_lock/launch.h"

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "bench/frame_lock/process.h"
#include "cluster/dds.h"

namespace vindu {
namespace {

/// The Tromsø wall under a name of its own; removed at the end of its scope.
class WallFile {
 public:
  explicit WallFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (name + ".toml")) {
    std::ofstream(path_) << "[wall]\ncolumns = 7\nrows = 4\nwidth_m = 5.185\nheight_m = 2.238\n"
                            "tile_width_px = 1024\ntile_height_px = 768\n"
                         << "[cluster]\nname = \"" << name << "\"\n";
  }
  ~WallFile() { std::filesystem::remove(path_); }
  WallFile(const WallFile&) = delete;
  WallFile& operator=(const WallFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

bool whole(const FrameMessage& message) {
  return message.active_tiles == 28 && message.released == message.newest.number;
}

}  // namespace

std::optional<double> launch_s(const std::string& program) {
  const std::string name = "launch-bench-" + std::to_string(getpid());
  const WallFile wall(name);
  const MonotonicClock clock;
  DdsTransport transport({.name = name});
  const auto bus = transport.join({{Role::console, "bench", "here", "bench"}, {}, {Topic::frame}});
  const Time start = clock.now();
  const Time deadline = start + std::chrono::seconds(60);
  Process launch(
      {program, "launch", "--headless", "--scale", "0.1", "--seconds", "90", "--wall", wall.path()},
      true);
  std::optional<double> took_s;
  while (!took_s && clock.now() < deadline) {
    bus->wait({Topic::frame}, deadline);
    const Time now = clock.now();
    for (const FrameMessage& message : bus->take<FrameMessage>())
      if (!took_s && whole(message)) took_s = seconds(now - start);
  }
  launch.send(SIGTERM);
  launch.end();
  return took_s;
}

}  // namespace vindu
