// Hosts of a wall that are network namespaces of this machine, made by namespace_hosts.sh: each has
// its own name, home, sshd and systemd of the user, or besides a slurmd. Needs root.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cluster/launch/hosts.h"

namespace vindu::testing {

class NamespaceHosts {
 public:
  /// The first is the one from which a wall is launched; with Slurm its controller too.
  explicit NamespaceHosts(std::vector<std::string> names, bool slurm = false);
  /// Takes them down, if that was not done.
  ~NamespaceHosts();
  NamespaceHosts(const NamespaceHosts&) = delete;
  NamespaceHosts& operator=(const NamespaceHosts&) = delete;

  /// False where the kernel forbids it or something is not installed.
  bool made() const { return made_; }
  const std::vector<std::string>& names() const { return names_; }
  std::filesystem::path folder() const { return folder_; }
  std::filesystem::path home(const std::string& host) const { return folder_ / host / "root"; }

  /// On the network of the first, with its ssh, in the root of this process: what to start there,
  /// and how it ended.
  std::vector<std::string> words_on_head(std::vector<std::string> words) const;
  ProgramResult on_head(const std::vector<std::string>& words) const;

  /// Of one host, by words that are in their command line.
  std::vector<pid_t> processes(const std::string& host, const std::string& words) const;
  /// Of all hosts.
  std::vector<pid_t> processes(const std::string& words) const;

  void take_down();

 private:
  ProgramResult rig(std::vector<std::string> words) const;

  std::vector<std::string> names_;
  std::filesystem::path folder_;
  std::string prefix_;
  bool made_ = false;
  std::map<std::string, std::string> networks_;  // by host, as /proc/PID/ns/net names them
};

}  // namespace vindu::testing
