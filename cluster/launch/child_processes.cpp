#include "cluster/launch/child_processes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "core/error.h"

namespace vindu {
namespace {

constexpr std::size_t kLongestLine = 4096;

[[noreturn]] void refuse(const std::string& what) {
  throw Error({what + ": " + std::strerror(errno), "launch",
               "end other programs, or raise the limits (ulimit -u, ulimit -n)"});
}

struct Pipe {
  FileDescriptor read, write;
};

Pipe make_pipe() {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC)) refuse("the system gives no pipe");
  Pipe made{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return made;
}

/// In the child, between fork and exec: nothing here allocates or locks.
[[noreturn]] void become(char* const* words, pid_t parent, int out, int err) {
  if (!die_with(parent, SIGKILL)) _exit(kNotStarted);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execvp(words[0], words);
  const char* const why = strerrordesc_np(errno);
  for (const char* part : {"cannot start ", static_cast<const char*>(words[0]), ": ",
                           why ? why : "unknown error", "\n"})
    if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  _exit(kNotStarted);
}

/// Moves whole lines from `rest` to the news, and what is too long to wait for its end.
void cut_lines(std::string& rest, const std::string& name, bool result, ChildNews& news) {
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = rest.find('\n', begin);
    const std::size_t length =
        std::min(end == std::string::npos ? rest.size() - begin : end - begin, kLongestLine);
    const bool whole = end != std::string::npos && end - begin == length;
    if (!whole && length < kLongestLine) break;
    news.lines.push_back({name, result, rest.substr(begin, length)});
    begin += length + (whole ? 1 : 0);
  }
  rest.erase(0, begin);
}

/// What the pipe holds now, at most as much as one turn should bring; returns whether it has ended.
bool read_some(int pipe, std::string& into) {
  std::array<char, 65536> bytes;
  const ssize_t count = read(pipe, bytes.data(), bytes.size());
  if (count > 0) into.append(bytes.data(), static_cast<std::size_t>(count));
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
}

int ms_until(Time deadline) {
  const auto left = deadline - std::chrono::steady_clock::now();
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
  return static_cast<int>(std::clamp<std::int64_t>(ms, 0, 60'000));
}

}  // namespace

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)) {}
FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}
FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) close(number_);
}

std::string text_of(const ChildEnd& end) {
  if (end.signal == 0) return "ended with exit code " + std::to_string(end.exit_code);
  return std::string("was killed (") + strsignal(end.signal) + ")";
}

ChildProcesses::ChildProcesses() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, &before_);
  signals_ = FileDescriptor(signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!signals_.open()) refuse("the system gives no signalfd");
}

ChildProcesses::~ChildProcesses() {
  kill_descendants();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void ChildProcesses::start(const std::string& name, const std::vector<std::string>& words) {
  assert(!words.empty());
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  Pipe out = make_pipe(), err = make_pipe();
  const pid_t self = getpid();
  const pid_t child = fork();
  if (child < 0) refuse("the system starts no process");
  if (child == 0) become(pointers.data(), self, out.write.get(), err.write.get());
  children_[child] = Child{name, {std::move(out.read), {}}, {std::move(err.read), {}}};
}

bool ChildProcesses::has(const std::string& name) const {
  return std::ranges::any_of(children_,
                             [&](const auto& entry) { return entry.second.name == name; });
}

void ChildProcesses::signal_all(int signal) const {
  for (const auto& [id, child] : children_) kill(id, signal);
}

ChildNews ChildProcesses::wait(Time deadline) {
  std::vector<pollfd> ready{{signals_.get(), POLLIN, 0}};
  std::vector<std::pair<Child*, bool>> owners{{nullptr, false}};
  for (auto& [id, child] : children_)
    for (const bool result : {true, false})
      if (const Stream& stream = result ? child.out : child.err; stream.pipe.open()) {
        ready.push_back({stream.pipe.get(), POLLIN, 0});
        owners.emplace_back(&child, result);
      }
  ChildNews news;
  if (poll(ready.data(), ready.size(), ms_until(deadline)) <= 0) return news;
  for (std::size_t i = 1; i < ready.size(); ++i) {
    if (!ready[i].revents) continue;
    const auto [child, result] = owners[i];
    Stream& stream = result ? child->out : child->err;
    if (read_some(stream.pipe.get(), stream.rest)) stream.pipe = FileDescriptor();
    cut_lines(stream.rest, child->name, result, news);
  }
  if (ready[0].revents) read_signals(news);
  return news;
}

void ChildProcesses::read_signals(ChildNews& news) {
  signalfd_siginfo info{};
  bool died = false;
  while (read(signals_.get(), &info, sizeof info) == sizeof info) {
    if (info.ssi_signo == SIGCHLD)
      died = true;
    else
      news.stop = true;
  }
  if (died) reap(news);
}

/// What a dead child has left in its pipes. A grandchild may hold them open: it is not waited for.
void ChildProcesses::read_all(Child& child, ChildNews& news) {
  constexpr int kMostReads = 64;
  for (const bool result : {true, false}) {
    Stream& stream = result ? child.out : child.err;
    for (int i = 0; i < kMostReads && stream.pipe.open(); ++i) {
      const std::size_t before = stream.rest.size();
      if (read_some(stream.pipe.get(), stream.rest) || stream.rest.size() == before) break;
      cut_lines(stream.rest, child.name, result, news);
    }
    if (!stream.rest.empty()) news.lines.push_back({child.name, result, stream.rest});
  }
}

void ChildProcesses::reap(ChildNews& news) {
  int status = 0;
  for (pid_t ended = 0; (ended = waitpid(-1, &status, WNOHANG)) > 0;) {
    const auto found = children_.find(ended);
    if (found == children_.end()) continue;  // left by one of them
    read_all(found->second, news);
    ChildEnd end{.name = found->second.name};
    if (WIFSIGNALED(status))
      end.signal = WTERMSIG(status);
    else
      end.exit_code = WEXITSTATUS(status);
    news.ends.push_back(end);
    children_.erase(found);
  }
  kill_strays();
}

/// What a child had started and left behind is ours now; nobody waits for it.
void ChildProcesses::kill_strays() const {
  std::ifstream list("/proc/thread-self/children");
  for (pid_t child = 0; list >> child;)
    if (!children_.contains(child)) kill(child, SIGKILL);
}

}  // namespace vindu
