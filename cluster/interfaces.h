// The network as this machine has it: its interfaces, and the hosts whose names it knows.
#pragma once

#include <string>
#include <vector>

namespace vindu {

struct NetworkInterface {
  std::string name;                    ///< "eth0"
  std::vector<std::string> addresses;  ///< IPv4, "192.168.1.7"
  bool running = false;                ///< up, and its cable or access point is there
  bool multicast = false;              ///< Linux says so of all but lo and tunnels
  bool loopback = false;
};

/// In order of name.
std::vector<NetworkInterface> network_interfaces();

/// Whether the name has an IPv4 address, by /etc/hosts or DNS. May take as long as DNS does.
bool has_address(const std::string& host);

}  // namespace vindu
