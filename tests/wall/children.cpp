#include "tests/wall/children.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <utility>

namespace vindu::testing {
namespace {

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

Child::Child(std::vector<std::string> words, const std::string& output_file,
             const std::function<void()>& enter) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(126);
  const int output = open(output_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  enter();
  execv(argv[0], argv.data());
  _exit(127);
}

Child::Child(Child&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), exit_code_(other.exit_code_) {}

Child::~Child() {
  if (pid_ <= 0) return;
  send(SIGKILL);
  send(SIGCONT);
  end();
}

void Child::send(int signal) const {
  if (pid_ > 0) kill(pid_, signal);
}

int Child::end() {
  if (pid_ <= 0) return exit_code_;
  int status = 0;
  waitpid(std::exchange(pid_, -1), &status, 0);
  return exit_code_ = code_of(status);
}

bool Child::runs() {
  int status = 0;
  if (pid_ <= 0 || waitpid(pid_, &status, WNOHANG) == 0) return pid_ > 0;
  pid_ = -1;
  exit_code_ = code_of(status);
  return false;
}

}  // namespace vindu::testing
