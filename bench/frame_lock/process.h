// A process that a bench starts, and that ends with the scope that it belongs to.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace vindu {

class Process {
 public:
  /// `words`: the program's file and its arguments. Throws Error where it cannot be started.
  explicit Process(std::vector<std::string> words, bool silent = false);
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;
  ~Process();

  pid_t id() const { return id_; }
  void send(int signal) const;
  /// Waits for its end.
  void end();

 private:
  pid_t id_ = 0;
};

}  // namespace vindu
