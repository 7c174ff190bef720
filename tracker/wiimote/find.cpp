#include "tracker/wiimote/find.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>

#include "tracker/wiimote/commands.h"

namespace vindu {
namespace {

/// "00:1f:c5:1b:3a:b1"
bool is_bluetooth_address(const std::string& text) {
  if (text.size() != 17) return false;
  for (std::size_t at = 0; at < text.size(); ++at)
    if (at % 3 == 2 ? text[at] != ':' : !std::isxdigit(static_cast<unsigned char>(text[at])))
      return false;
  return true;
}

}  // namespace

WiimoteKind kind_of(const HidInfo& info) {
  constexpr std::uint16_t kNintendo = 0x057e, kLego = 0x054c;
  constexpr std::uint16_t kClassic = 0x0306, kTr = 0x0330;
  if (info.name.ends_with("-UC") || info.name.find("RVL-WBC") != std::string::npos)
    return WiimoteKind::none;
  if (info.name.find("RVL-CNT-01-TR") != std::string::npos) return WiimoteKind::tr;
  if (info.name.find("RVL-CNT-01") != std::string::npos) return WiimoteKind::classic;
  const bool known_id = (info.vendor_id == kNintendo || info.vendor_id == kLego) &&
                        (info.product_id == kClassic || info.product_id == kTr);
  if (!known_id) return WiimoteKind::none;
  // Bluetooth's serial number is the device's address; an adapter has none of its slots'.
  if (!is_bluetooth_address(info.address)) return WiimoteKind::adapter;
  return info.product_id == kTr ? WiimoteKind::tr : WiimoteKind::classic;
}

std::vector<HidInfo> find_wiimotes(HidBus& bus) {
  std::vector<HidInfo> found = bus.list();
  std::erase_if(found, [](const HidInfo& info) { return kind_of(info) == WiimoteKind::none; });
  for (HidInfo& info : found)
    if (kind_of(info) == WiimoteKind::adapter) info.address.clear();
  std::ranges::sort(found, {},
                    [](const HidInfo& info) { return std::tie(info.address, info.path); });
  return found;
}

const std::string& label_of(const HidInfo& info) {
  return info.address.empty() ? info.path : info.address;
}

std::optional<StatusReport> probe(HidDevice& device, Clock& clock, Duration patience) {
  std::array<std::uint8_t, 64> buffer;
  const Time end = clock.now() + patience;
  if (!device.write(request_status().span())) return std::nullopt;
  while (clock.now() < end) {
    const HidRead read = device.read(buffer, end);
    if (read.status != HidStatus::report) return std::nullopt;
    const ParsedReport parsed = parse_report(std::span(buffer).first(read.size));
    const auto* status = parsed.report ? std::get_if<StatusReport>(&*parsed.report) : nullptr;
    if (status) return *status;
  }
  return std::nullopt;
}

double battery_charge(int level) { return std::min(level / 208.0, 1.0); }

}  // namespace vindu
