#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>

#include "app/launch.h"
#include "app/wall_console.h"
#include "cluster/dds.h"
#include "cluster/launch/keeper.h"
#include "cluster/wall_view.h"

namespace vindu::app {
namespace {

/// The wall's state in the last line of a terminal, below what its processes say.
class StatusLine {
 public:
  explicit StatusLine(const Site& site)
      : self_(this_console(site)),
        transport_(network_of(site, Role::console)),
        bus_(transport_.join({self_, {}, WallView::hears()})),
        view_(tile_names(site.wall), self_) {}

  void show(int restarts) {
    view_.poll(*bus_, std::chrono::steady_clock::now());
    std::string line = summary_of(view_.now());
    if (restarts > 0) line += fmt::format(", {} restarts", restarts);
    if (line != shown_) std::fputs(("\r\x1b[K" + line).c_str(), stderr);
    shown_ = line;
  }
  void clear() {
    if (!shown_.empty()) std::fputs("\r\x1b[K", stderr);
    shown_.clear();
  }

 private:
  Participant self_;
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
  WallView view_;
  std::string shown_;
};

/// What cannot be written, to a full disk or a reader that has gone, does not end the wall.
void write_if_possible(std::FILE* to, const std::string& line) {
  std::fputs(line.c_str(), to);
  std::fflush(to);
}

int keep_running(std::vector<ProcessPlan> plans, const Site& site) {
  const WallClaim claim(site.cluster);
  std::signal(SIGPIPE, SIG_IGN);
  std::unique_ptr<StatusLine> status;  // made after the supervisor: its threads hold no signals
  const auto say = [&](const std::string& name, const std::string& line) {
    if (status) status->clear();
    write_if_possible(stderr, name + ": " + line + "\n");
  };
  const auto result = [&](const std::string& line) {
    if (status) status->clear();
    write_if_possible(stdout, line + "\n");
  };
  Supervisor supervisor(std::move(plans), {result, say, say, [&](int restarts) {
                                             if (status) status->show(restarts);
                                           }});
  if (isatty(STDERR_FILENO) == 1) status = std::make_unique<StatusLine>(site);
  const bool good = supervisor.run();
  if (status) status->clear();
  return good ? 0 : 1;
}

}  // namespace

int launch_here(const LaunchRequest& request, const Site& site, int tiles_per_process) {
  return run_kept(
      [&] { return keep_running(local_wall(request, site.wall, tiles_per_process), site); });
}

}  // namespace vindu::app
