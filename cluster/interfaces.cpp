#include "cluster/interfaces.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>

#include <array>
#include <map>
#include <memory>

namespace vindu {
namespace {

using AddressList = std::unique_ptr<ifaddrs, decltype(&freeifaddrs)>;

AddressList system_list() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) list = nullptr;
  return {list, &freeifaddrs};
}

std::string text_of(const sockaddr* address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto* ipv4 = reinterpret_cast<const sockaddr_in*>(address);
  inet_ntop(AF_INET, &ipv4->sin_addr, text.data(), text.size());
  return text.data();
}

}  // namespace

std::vector<NetworkInterface> network_interfaces() {
  const AddressList list = system_list();
  std::map<std::string, NetworkInterface> by_name;
  for (const ifaddrs* each = list.get(); each; each = each->ifa_next) {
    NetworkInterface& found = by_name[each->ifa_name];
    found.name = each->ifa_name;
    found.running = (each->ifa_flags & IFF_UP) && (each->ifa_flags & IFF_RUNNING);
    found.multicast = each->ifa_flags & IFF_MULTICAST;
    found.loopback = each->ifa_flags & IFF_LOOPBACK;
    if (each->ifa_addr && each->ifa_addr->sa_family == AF_INET)
      found.addresses.push_back(text_of(each->ifa_addr));
  }
  std::vector<NetworkInterface> interfaces;
  for (auto& [name, found] : by_name) interfaces.push_back(std::move(found));
  return interfaces;
}

bool has_address(const std::string& host) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0) return false;
  freeaddrinfo(found);
  return true;
}

}  // namespace vindu
