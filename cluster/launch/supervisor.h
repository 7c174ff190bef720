// Keeps the processes of a wall running: starts them, starts again what dies, stops all. What
// systemd does on the hosts of a wall, for processes of one machine.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cluster/launch/child_processes.h"
#include "cluster/launch/restarts.h"

namespace vindu {

struct ProcessPlan {
  std::string name;
  std::vector<std::string> words;  ///< program and arguments
  bool leads = false;              ///< when it ends by itself, all others are stopped
};

/// Who crashes, fails or hangs is started again; who ends with 0 stays ended. Who leads and ends by
/// itself ends the wall, unless it had been started again after a crash; so does a crash of it too
/// many. An exit code of 2, called wrong, 3, in vain, or 127, no such program, is final for
/// everybody.
class Supervisor {
 public:
  struct Output {
    std::function<void(const std::string& line)> result;  ///< the leader's standard output
    std::function<void(const std::string& name, const std::string& line)> log;
    std::function<void(const std::string& name, const std::string& line)> trouble;
    std::function<void(int restarts)> idle;  ///< several times a second; of all processes
  };

  Supervisor(std::vector<ProcessPlan> plans, Output output, const RestartPolicy& policy = {});

  /// Until a signal says so or the wall has ended. Returns whether that was well: stopped, or its
  /// leader ended with 0.
  bool run();

  /// Starts that followed a death, of all processes.
  int restarts() const;
  /// Names of processes that were given up.
  const std::vector<std::string>& given_up() const { return given_up_; }

 private:
  struct Process {
    ProcessPlan plan;
    Restarts restarts;
    Time started{};
    std::optional<Time> due{};  ///< empty: runs, or ended for good
    Time alive_until{};         ///< unless it says that it lives, it hangs then
  };
  enum class Outcome { running, good, bad };

  void start_due(Time now);
  Time next_start(Time now) const;
  void print(const ChildNews& news);
  void end_who_hangs(const ChildNews& news, Time now);
  Outcome consider(const ChildEnd& end);
  Outcome give_up(Process& process, const std::string& why);
  Outcome outcome_without_followers() const;
  void stop();

  std::map<std::string, Process> processes_;
  Output output_;
  Duration patience_, first_patience_;
  Time turned_;  // when it last had news
  std::vector<std::string> given_up_;
  ChildProcesses children_{ChildProcesses::SignsOfLife::asked_for};
};

}  // namespace vindu
