#include "bench/frame_lock/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace vindu {

Process::Process(std::vector<std::string> words, bool silent) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (silent)
    for (const int output : {STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  const int failed = posix_spawn(&id_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw Error({words[0] + " does not start", std::strerror(failed),
                 "see that it is there, and that the machine has room for more processes"});
}

Process::Process(Process&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

Process::~Process() {
  send(SIGKILL);
  end();
}

void Process::send(int signal) const {
  if (id_ > 0) kill(id_, signal);
}

void Process::end() {
  if (id_ > 0) waitpid(std::exchange(id_, 0), nullptr, 0);
}

}  // namespace vindu
