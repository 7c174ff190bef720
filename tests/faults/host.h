// A host of a wall on this machine: a network namespace of its own whose one card ends in a switch
// of this process, a host name, and a disk of its own that can be filled.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace vindu::testing {

/// Into a user and mount namespace in which this process may make networks and disks, where it is
/// not root. To be called before any thread is started. Returns false where the kernel forbids it.
bool become_master_of_namespaces();

class Host {
 public:
  /// 10.77.0.NUMBER, with `folder` (that is there) as its disk. Throws std::runtime_error with what
  /// could not be made.
  Host(std::string name, int number, std::string folder);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  const std::string& name() const { return name_; }
  const std::string& folder() const { return folder_; }
  /// The other end of its network card: a whole Ethernet frame a read or write, never blocking.
  int card() const { return card_; }

  /// As /proc/PID/ns/net names it.
  std::string network() const;
  /// Whether its network card has a carrier.
  void plug(bool in);
  /// Takes what is left of its disk, or gives it back.
  void fill_disk(bool full);

  /// What a child process does before exec to run on this host. Safe after fork.
  std::function<void()> entrance() const;

 private:
  void make_network(int number);
  void make_disk();
  std::string ballast() const { return folder_ + "/ballast"; }

  std::string name_;
  std::string folder_;
  int network_ = -1;
  int card_ = -1;
};

}  // namespace vindu::testing
