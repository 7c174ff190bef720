// A launcher and its processes, for tests:
//   launch_peer launch NAME=BEHAVIOUR ...   keeps them running; the first one leads
//   launch_peer BEHAVIOUR                   one of them: prints its process id, then
//     stay    sleeps, with a child of its own that has left the session and heeds no SIGTERM
//     stubborn   the same, and heeds no SIGTERM itself
//     end, fail, wrong, crash    ends with 0, 1, 2, or by SIGABRT,
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "cluster/launch/keeper.h"
#include "cluster/launch/supervisor.h"
#include "core/error.h"

namespace {

using namespace vindu;

void say(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

int launch(const std::string& program, const std::vector<std::string>& processes) {
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
    Supervisor supervisor(plans, {result, log, log, [](int) {}});
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

int behave(const std::string& behaviour) {
  if (behaviour == "stubborn") signal(SIGTERM, SIG_IGN);
  if (behaviour == "stay" || behaviour == "stubborn") leave_a_child();
  say(fmt::format("pid {}", getpid()));
  if (behaviour == "stay" || behaviour == "stubborn") sleep_for_ever();
  if (behaviour == "crash") std::abort();
  return behaviour == "end" ? 0 : behaviour == "fail" ? 1 : 2;
}

}  // namespace

int main(int count, char** begin) try {
  const std::vector<std::string> words(begin, begin + count);
  if (words.size() < 2) return 2;
  if (words[1] == "launch") return launch(words[0], {words.begin() + 2, words.end()});
  return behave(words[1]);
} catch (const vindu::Error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
