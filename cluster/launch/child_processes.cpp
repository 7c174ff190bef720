#include "cluster/launch/child_processes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <string_view>
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
[[noreturn]] void become(char* const* words, char* const* environment, pid_t parent, int out,
                         int err) {
  if (!die_with(parent, SIGKILL)) _exit(kNotStarted);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execvpe(words[0], words, environment);
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

/// Takes what sd_notify(3) says, and who says it.
FileDescriptor open_signs_of_life() {
  FileDescriptor socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  const sockaddr_un any{.sun_family = AF_UNIX, .sun_path = {}};  // the kernel finds a name
  if (setsockopt(socket_.get(), SOL_SOCKET, SO_PASSCRED, &on, sizeof on) != 0 ||
      bind(socket_.get(), reinterpret_cast<const sockaddr*>(&any), sizeof any.sun_family) != 0)
    refuse("the system gives no socket");
  return socket_;
}

/// As sd_notify(3) writes those of the abstract namespace.
std::string name_of_socket(int socket_) {
  sockaddr_un address{};
  socklen_t size = sizeof address;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
  const std::size_t begin = offsetof(sockaddr_un, sun_path) + 1;
  return "@" + std::string(address.sun_path + 1, size - begin);
}

std::vector<char*> pointers_to(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
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

ChildProcesses::ChildProcesses(SignsOfLife signs) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, &before_);
  signals_ = FileDescriptor(signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!signals_.open()) refuse("the system gives no signalfd");
  for (char** entry = environ; *entry; ++entry)
    if (!std::string_view(*entry).starts_with("NOTIFY_SOCKET=")) environment_.emplace_back(*entry);
  if (signs == SignsOfLife::not_asked_for) return;
  signs_of_life_ = open_signs_of_life();
  environment_.push_back("NOTIFY_SOCKET=" + name_of_socket(signs_of_life_.get()));
}

ChildProcesses::~ChildProcesses() {
  kill_descendants();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void ChildProcesses::start(const std::string& name, const std::vector<std::string>& words) {
  assert(!words.empty());
  const std::vector<char*> pointers = pointers_to(words), environment = pointers_to(environment_);
  Pipe out = make_pipe(), err = make_pipe();
  const pid_t self = getpid();
  const pid_t child = fork();
  if (child < 0) refuse("the system starts no process");
  if (child == 0)
    become(pointers.data(), environment.data(), self, out.write.get(), err.write.get());
  children_[child] = Child{name, {std::move(out.read), {}}, {std::move(err.read), {}}};
}

bool ChildProcesses::has(const std::string& name) const {
  return std::ranges::any_of(children_,
                             [&](const auto& entry) { return entry.second.name == name; });
}

void ChildProcesses::signal_all(int signal) const {
  for (const auto& [id, child] : children_) kill(id, signal);
}

void ChildProcesses::kill_one(const std::string& name) const {
  for (const auto& [id, child] : children_)
    if (child.name == name) kill(id, SIGKILL);
}

ChildNews ChildProcesses::wait(Time deadline) {
  std::vector<pollfd> ready{{signals_.get(), POLLIN, 0}, {signs_of_life_.get(), POLLIN, 0}};
  std::vector<std::pair<Child*, bool>> owners{{nullptr, false}, {nullptr, false}};
  for (auto& [id, child] : children_)
    for (const bool result : {true, false})
      if (const Stream& stream = result ? child.out : child.err; stream.pipe.open()) {
        ready.push_back({stream.pipe.get(), POLLIN, 0});
        owners.emplace_back(&child, result);
      }
  ChildNews news;
  if (poll(ready.data(), ready.size(), ms_until(deadline)) <= 0) return news;
  for (std::size_t i = 2; i < ready.size(); ++i) {
    if (!ready[i].revents) continue;
    const auto [child, result] = owners[i];
    Stream& stream = result ? child->out : child->err;
    if (read_some(stream.pipe.get(), stream.rest)) stream.pipe = FileDescriptor();
    cut_lines(stream.rest, child->name, result, news);
  }
  if (ready[1].revents) read_signs_of_life(news);
  if (ready[0].revents) read_signals(news);
  return news;
}

/// What they say does not matter, and the kernel says who it is.
void ChildProcesses::read_signs_of_life(ChildNews& news) const {
  char text = 0;
  iovec part{&text, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
  constexpr int kMost = 256;  // of one turn
  for (int i = 0; i < kMost; ++i) {
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (recvmsg(signs_of_life_.get(), &message, 0) < 0) return;
    const cmsghdr* const header = CMSG_FIRSTHDR(&message);
    if (!header || header->cmsg_type != SCM_CREDENTIALS) continue;
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(header), sizeof sender);
    if (const auto child = children_.find(sender.pid); child != children_.end())
      news.alive.push_back(child->second.name);
  }
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
