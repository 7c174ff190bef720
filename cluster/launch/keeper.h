// Nothing is left of a launcher, by whatever means it dies. It is two processes, each of which
// ends what the other one leaves behind: the outer one, which the user sees, and the inner one,
// which does the work and has all the others below it.
#pragma once

#include <functional>

namespace vindu {

/// As long as it lives, processes below this one whose parents died become children of this one.
class Reaper {
 public:
  Reaper();
  ~Reaper();
  Reaper(const Reaper&) = delete;
  Reaper& operator=(const Reaper&) = delete;

 private:
  int before_ = 0;
};

/// Kills the children of this process, and those that they leave to it, until there is none. Needs
/// a Reaper from before they were started.
void kill_descendants();

/// Has the kernel send this process a signal when `parent`, its parent, dies. False if that has
/// happened already.
bool die_with(int parent, int signal);

/// Runs `work` in a child, in a process group of its own (Ctrl-C of the terminal reaches the caller
/// alone), and returns its exit code in the caller when nothing of it is left. In the child it
/// returns too, with what `work` returned: the caller should do nothing more than end. Ctrl-C,
/// SIGTERM and SIGHUP reach `work` as SIGTERM, and so does the caller's death. Call it before any
/// thread is started. Throws Error where the system starts no process.
int run_kept(const std::function<int()>& work);

}  // namespace vindu
