#include "cluster/launch/keeper.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/log.h"

namespace vindu {
namespace {

/// Of all threads, as the kernel lists them: any of them may have started one.
void signal_children(int signal) {
  std::ifstream list("/proc/thread-self/children");
  for (pid_t child = 0; list >> child;) kill(child, signal);
}

int exit_code_of(int status) {
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  log_warning("launch", std::string("was ended by a signal: ") + strsignal(WTERMSIG(status)) +
                            "; what it had started was ended too");
  return 1;
}

/// Passes on what is to end the child, until it has ended.
int wait_for(pid_t child, const sigset_t& signals) {
  while (true) {
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal > 0 && signal != SIGCHLD) kill(child, SIGTERM);
    int status = 0;
    for (pid_t ended = 0; (ended = waitpid(-1, &status, WNOHANG)) > 0;)
      if (ended == child) return exit_code_of(status);
  }
}

}  // namespace

Reaper::Reaper() {
  prctl(PR_GET_CHILD_SUBREAPER, &before_);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}
Reaper::~Reaper() { prctl(PR_SET_CHILD_SUBREAPER, before_); }

bool die_with(int parent, int signal) {
  prctl(PR_SET_PDEATHSIG, signal);
  return getppid() == parent;
}

void kill_descendants() {
  while (true) {
    signal_children(SIGKILL);
    pid_t ended = 0;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) continue;
    if (ended < 0 && errno == ECHILD) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

int run_kept(const std::function<int()>& work) {
  sigset_t signals, before;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, &before);
  const Reaper reaper;
  std::fflush(nullptr);  // what is buffered is printed once
  const pid_t self = getpid();
  const pid_t child = fork();
  if (child < 0)
    throw Error({std::string("the system starts no process: ") + std::strerror(errno), "launch",
                 "end other programs, or raise the limit (ulimit -u)"});
  if (child == 0) {
    setpgid(0, 0);
    const Reaper own;
    if (!die_with(self, SIGTERM)) return 1;
    return work();
  }
  const int code = wait_for(child, signals);
  kill_descendants();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return code;
}

}  // namespace vindu
