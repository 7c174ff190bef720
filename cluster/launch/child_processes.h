// Programs as children: started with no way to outlive this process, listened to line by line,
// waited for. Together with keeper.h nothing that they start outlives it either.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <map>
#include <string>
#include <vector>

#include "cluster/launch/keeper.h"
#include "core/clock.h"

namespace vindu {

/// Stands for one file descriptor.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor();

  int get() const { return number_; }
  bool open() const { return number_ >= 0; }

 private:
  int number_;
};

struct ChildLine {
  std::string name;     ///< of the child
  bool result = false;  ///< of its standard output, not of its error stream
  std::string text;     ///< without its end; of a longer one than 4096 bytes as many pieces
};

constexpr int kNotStarted = 127;  ///< exit code, as shells say it

struct ChildEnd {
  std::string name;
  int exit_code = 0;  ///< or kNotStarted
  int signal = 0;     ///< that ended it; 0: ended by itself
};

struct ChildNews {
  std::vector<std::string> alive;  ///< names of those that said so, by sd_notify(3)
  std::vector<ChildLine> lines;
  std::vector<ChildEnd> ends;  ///< each after its last line
  bool stop = false;           ///< Ctrl-C, SIGTERM or SIGHUP came
};

/// "ended with exit code 1", "was killed (Segmentation fault)"
std::string text_of(const ChildEnd& end);

/// One in a process; bound to the thread that makes it, which must start before all others: they
/// inherit that signals are held back. All children that are left are killed at the end.
class ChildProcesses {
 public:
  enum class SignsOfLife { not_asked_for, asked_for };  ///< ChildNews::alive

  explicit ChildProcesses(SignsOfLife signs = SignsOfLife::not_asked_for);
  ~ChildProcesses();
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  /// The first word is a path, or is looked for in PATH. No shell reads the words. Its standard
  /// input is empty. No other child has this name. Throws Error where the system starts none.
  void start(const std::string& name, const std::vector<std::string>& words);

  /// At the latest at the deadline.
  ChildNews wait(Time deadline);

  void signal_all(int signal) const;
  void kill_one(const std::string& name) const;
  bool empty() const { return children_.empty(); }
  bool has(const std::string& name) const;

 private:
  struct Stream {
    FileDescriptor pipe;
    std::string rest;  ///< of a line whose end has not come
  };
  struct Child {
    std::string name;
    Stream out, err;
  };

  void read_signals(ChildNews& news);
  void read_signs_of_life(ChildNews& news) const;
  void read_all(Child& child, ChildNews& news);
  void reap(ChildNews& news);
  void kill_strays() const;

  std::map<pid_t, Child> children_;
  Reaper reaper_;
  sigset_t before_{};
  FileDescriptor signals_;
  FileDescriptor signs_of_life_;  // a socket, whose name is in the children's environment; or none
  std::vector<std::string> environment_;
};

}  // namespace vindu
