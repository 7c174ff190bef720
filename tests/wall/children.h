// Programs that run beside a test: started, stopped, killed.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace vindu::testing {

/// Killed at the end of its scope, if it still runs, and when the test dies.
class Child {
 public:
  /// Its output goes to that file. `enter` is called in the child, before the program starts;
  /// without it there is no display.
  Child(
      std::vector<std::string> words, const std::string& output_file,
      const std::function<void()>& enter = [] {});
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  ~Child();

  pid_t id() const { return pid_; }
  void send(int signal) const;
  /// Waits for its end: its exit code, 128 + the signal's number where one ended it.
  int end();
  bool runs();

 private:
  pid_t pid_ = -1;
  int exit_code_ = -1;
};

}  // namespace vindu::testing
