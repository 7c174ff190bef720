// A launcher and its processes, for tests:
//   launch_peer launch NAME=BEHAVIOUR ...   keeps them running; the first one leads
//   launch_peer launch-impatiently ...      the same; who does not say within 1 s that it lives
//   hangs launch_peer BEHAVIOUR                   one of them: prints its process id, then
//     stay    sleeps, with a child of its own that has left the session and heeds no SIGTERM
//     stubborn   the same, and heeds no SIGTERM itself
//     hang    says once that it lives, and sleeps
//     live    says so again and again
//     end, fail, wrong, crash    ends with 0, 1, 2, or by SIGABRT,
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "cluster/launch/host_plan.h"
#include "cluster/launch/hosts.h"
#include "cluster/launch/keeper.h"
#include "cluster/launch/supervisor.h"
#include "core/error.h"

namespace {

using namespace vindu;

void say(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

int launch(const std::string& program, const std::vector<std::string>& processes,
           Duration first_patience) {
  std::vector<ProcessPlan> plans;
  for (const std::string& process : processes) {
    const std::size_t equals = process.find('=');
    plans.push_back(
        {process.substr(0, equals), {program, process.substr(equals + 1)}, plans.empty()});
  }
  const auto log = [](const std::string& name, const std::string& line) {
    say(name + ": " + line);
  };
  const auto result = [](const std::string& line) { say("result: " + line); };
  return run_kept([&] {
    say(fmt::format("launcher: pid {}", getpid()));
    Supervisor supervisor(plans, {result, log, log, [](int) {}},
                          {.patience = std::chrono::seconds(1), .first_patience = first_patience});
    const bool good = supervisor.run();
    say(fmt::format("launcher: {}, {} restarts", good ? "good" : "bad", supervisor.restarts()));
    return good ? 0 : 1;
  });
}

[[noreturn]] void sleep_for_ever() {
  while (true) pause();
}

void leave_a_child() {
  if (fork() != 0) return;
  setsid();
  signal(SIGTERM, SIG_IGN);
  sleep_for_ever();
}

/// As sd_notify(3) does it.
void notify_systemd(const std::string& state) {
  const char* const name = std::getenv("NOTIFY_SOCKET");
  if (!name) return;
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::size_t length = std::min(std::strlen(name), sizeof address.sun_path - 1);
  std::memcpy(address.sun_path, name, length);
  if (name[0] == '@') address.sun_path[0] = 0;
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM, 0);
  sendto(socket_, state.data(), state.size(), 0, reinterpret_cast<const sockaddr*>(&address),
         static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length));
  close(socket_);
}

[[noreturn]] void stand_for_vindu(const std::vector<std::string>& words) {
  const std::string file = std::getenv("HOME") + std::string("/said-") + words[1];
  {
    std::ofstream said(file + ".new");
    said << getpid() << '\n';
    for (std::size_t i = 2; i < words.size(); ++i) said << words[i] << '\n';
    const char* const display = std::getenv("DISPLAY");
    said << "DISPLAY=" << (display ? display : "") << '\n';
  }
  std::filesystem::rename(file + ".new", file);
  while (true) {
    notify_systemd("READY=1\nWATCHDOG=1");
    sleep(1);
  }
}

int on_hosts_of_a_wall(const std::vector<std::string>& words) {
  const std::string &verb = words[2], &folder = words[3];
  const std::vector<std::string> hosts(words.begin() + 4, words.end());
  Site site;
  site.cluster.master = hosts.front();
  WallGrid grid;
  grid.columns = static_cast<int>(hosts.size()) - 1;
  grid.width_m = grid.height_m = 1;
  grid.tile_width_px = grid.tile_height_px = 1;
  site.wall = expand_wall(grid, {}, {});
  const auto sum = [&](const std::string& file) {
    return run_program({"sha256sum", folder + "/" + file}).out.at(0).substr(0, 64);
  };
  const HostRequest request{
      .model = "it's a \"model\" $HOME 100%.glb",
      .master_arguments = {"--mode", "%h $TILES `id` \\ 'x'; touch /root/hacked"},
      .tile_arguments = {"$(touch /root/hacked)"},
      .headless = false,
      .program_sha256 = sum("bin/vindu"),
      .wall_sha256 = sum("wall.toml")};
  const auto plans = host_plans(site);
  std::vector<HostFiles> files;
  for (const std::string& host : hosts) files.push_back({host, {folder}});
  const auto reports = verb == "copy"    ? copy_to_hosts(files)
                       : verb == "start" ? on_hosts(hosts, start_script(plans, request))
                       : verb == "stop"  ? on_hosts(hosts, stop_script())
                                         : on_hosts(hosts, restart_script());
  fmt::print("{}", failures_of(reports));
  return failures_of(reports).empty() ? 0 : 1;
}

[[noreturn]] void live() {
  while (true) {
    notify_systemd("READY=1\nWATCHDOG=1");
    usleep(50'000);
  }
}

int behave(const std::string& behaviour) {
  if (behaviour == "stubborn") signal(SIGTERM, SIG_IGN);
  if (behaviour == "stay" || behaviour == "stubborn") leave_a_child();
  say(fmt::format("pid {}", getpid()));
  if (behaviour == "stay" || behaviour == "stubborn") sleep_for_ever();
  if (behaviour == "hang") notify_systemd("READY=1");
  if (behaviour == "hang") sleep_for_ever();
  if (behaviour == "live") live();
  if (behaviour == "crash") std::abort();
  return behaviour == "end" ? 0 : behaviour == "fail" ? 1 : 2;
}

}  // namespace

int main(int count, char** begin) try {
  const std::vector<std::string> words(begin, begin + count);
  if (words.size() < 2) return 2;
  if (words[1] == "--version") {
    say("a stand-in");
    return 0;
  }
  if (words[1] == "master" || words[1] == "tile") stand_for_vindu(words);
  if (words[1] == "hosts" && words.size() > 4) return on_hosts_of_a_wall(words);
  const std::vector<std::string> rest(words.begin() + 2, words.end());
  if (words[1] == "launch") return launch(words[0], rest, RestartPolicy{}.first_patience);
  if (words[1] == "launch-impatiently") return launch(words[0], rest, std::chrono::seconds(1));
  return behave(words[1]);
} catch (const vindu::Error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
