#include "tracker/wiimote/bluez.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "tracker/wiimote/bluez_client.h"

namespace vindu {

BluezView bluez_wiimotes() {
  try {
    return BluezClient().look();
  } catch (const Error& error) {
    return {.adapters = {}, .wiimotes = {}, .trouble = error.what()};
  }
}

std::vector<std::string> adapter_warnings(std::span<const BluezDevice> wiimotes) {
  std::map<std::string, int> counts;
  for (const BluezDevice& device : wiimotes)
    if (device.paired || device.connected) ++counts[device.adapter];
  std::vector<std::string> warnings;
  for (const auto& [adapter, count] : counts)
    if (count >= 3)
      warnings.push_back(fmt::format(
          "{}: {} Wiimotes share this adapter and report late, in bursts; one or two an adapter is "
          "better: plug in another and pair there with --adapter",
          adapter, count));
  return warnings;
}

bool same_address(const std::string& one, const std::string& other) {
  const auto capital = [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; };
  return std::ranges::equal(one, other, {}, capital, capital);
}

}  // namespace vindu
