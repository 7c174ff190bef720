// A wall over several hosts: a network namespace each, on one bridge, and a second network besides,
// so that the right interface has to be taken. Needs root.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace vindu {
namespace {

bool shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Hosts 1 (the master's, 10.77.0.1) to 4; interface e0 leads to the others and dead0 nowhere.
class Hosts : public ::testing::TestWithParam<std::string> {
 protected:
  static constexpr int kHosts = 4;

  Hosts() {
    made_ = shell("ip netns add " + bridge() + " && ip -n " + bridge() +
                  " link add br0 type bridge mcast_snooping 0 && ip -n " + bridge() +
                  " link set br0 up");
    for (int i = 1; made_ && i <= kHosts; ++i) made_ = add(i);
  }
  ~Hosts() override {
    for (int i = 1; i <= kHosts; ++i) shell("ip netns del " + host(i) + " 2>/dev/null");
    shell("ip netns del " + bridge() + " 2>/dev/null");
  }

  std::string host(int i) const {
    return "vindu" + std::to_string(getpid()) + "h" + std::to_string(i);
  }
  std::string bridge() const { return host(0); }

  bool add(int i) const {
    const std::string in_host = "ip -n " + host(i) + " ", number = std::to_string(i);
    return shell("ip netns add " + host(i)) &&
           shell("ip link add e0 netns " + host(i) + " type veth peer name p" + number + " netns " +
                 bridge()) &&
           shell("ip -n " + bridge() + " link set p" + number + " master br0 up") &&
           shell(in_host + "addr add 10.77.0." + number + "/24 dev e0") &&
           shell(in_host + "link add dead0 type veth peer name dead1") &&
           shell(in_host + "addr add 10.66.0." + number + "/24 dev dead0") &&
           shell(in_host + "link set dead0 up") && shell(in_host + "link set e0 up") &&
           shell(in_host + "link set lo up") && shell(in_host + "route add 224.0.0.0/4 dev e0");
  }

  /// A bus_peer's command line on a host; MULTICAST is the parameter.
  std::string peer(int i, const std::string& role) const {
    return "ip netns exec " + host(i) + " timeout 100 " + VINDU_BUS_PEER + " " + role +
           " hosts e0 10.77.0.1 " + GetParam();
  }

  bool made_ = false;
};

TEST_P(Hosts, FindEachOtherByTheMaster) {
  if (!made_) GTEST_SKIP() << "no network namespaces here";
  for (int i = 2; i <= kHosts; ++i) shell(peer(i, "tile tile-" + std::to_string(i) + "-0") + " &");

  EXPECT_TRUE(shell(peer(1, "master 3")));

  for (int i = 2; i <= kHosts; ++i) shell("kill $(ip netns pids " + host(i) + ") 2>/dev/null");
}

INSTANTIATE_TEST_SUITE_P(WithMulticast, Hosts, ::testing::Values("true", "false"));

}  // namespace
}  // namespace vindu
