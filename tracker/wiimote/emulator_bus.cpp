#include "tracker/wiimote/emulator_bus.h"

#include <algorithm>
#include <cassert>
#include <cstdio>

#include "core/error.h"

namespace vindu {
namespace {

constexpr std::uint16_t kNintendo = 0x057e;
constexpr std::uint16_t kWiimote = 0x0306;
constexpr std::uint16_t kWiimotePlus = 0x0330;
constexpr std::size_t kMostDevices = 16;
constexpr std::size_t kSlots = 4;          // of a DolphinBar
constexpr std::size_t kShortestWrite = 2;  // hidraw takes no less

// While nothing is due the device is looked at this often: another thread may do something to it.
constexpr Duration kIdle = std::chrono::milliseconds(5);

std::string made_up_address(std::size_t index) {
  char text[18];
  std::snprintf(text, sizeof text, "00:1f:c5:00:00:%02x", static_cast<unsigned>(index % 256));
  return text;
}

SensorView nothing_in_view(Time) { return {}; }

}  // namespace

HidInfo wiimote_info(std::uint16_t product_id, const std::string& address) {
  assert(product_id == kWiimote || product_id == kWiimotePlus);
  const bool plus = product_id == kWiimotePlus;
  return {"", kNintendo, product_id, plus ? "Nintendo RVL-CNT-01-TR" : "Nintendo RVL-CNT-01",
          address};
}

EmulatedDevice& EmulatedHidBus::add(EmulatedDeviceOptions options, WiimoteEmulator::Look look) {
  assert(devices_.size() < kMostDevices);
  if (options.info.name.empty())
    options.info =
        wiimote_info(options.firmware.motion_plus ? kWiimotePlus : kWiimote, options.info.address);
  if (options.info.address.empty() && !options.slot)
    options.info.address = made_up_address(devices_.size());
  return *devices_.emplace_back(
      std::make_unique<EmulatedDevice>(std::move(options), std::move(look), clock_));
}

void EmulatedHidBus::add_dolphin_bar(const std::vector<WiimoteEmulator::Look>& wiimotes) {
  assert(wiimotes.size() <= kSlots);
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    EmulatedDeviceOptions options;
    options.info = {"", kNintendo, kWiimote, "Mayflash Wiimote PC Adapter", ""};
    options.slot = true;
    const bool held = slot < wiimotes.size();
    EmulatedDevice& device = add(std::move(options), held ? wiimotes[slot] : nothing_in_view);
    if (!held) device.unplug();
  }
}

void EmulatedHidBus::add_strangers() {
  const auto add_one = [&](const char* name, std::uint16_t product_id) {
    EmulatedDeviceOptions options;
    options.info = {"", kNintendo, product_id, name, ""};
    add(std::move(options), nothing_in_view);
  };
  add_one("Nintendo RVL-WBC-01", kWiimote);
  add_one("Nintendo RVL-CNT-01-UC", kWiimotePlus);
}

std::string EmulatedHidBus::path(std::size_t index) {
  EmulatedDevice& device = *devices_.at(index);
  const int moves = device.options().slot ? 0 : device.connections();
  const auto number = index + kMostDevices * static_cast<std::size_t>(moves);
  return "/dev/hidraw" + std::to_string(number);
}

std::vector<HidInfo> EmulatedHidBus::list() {
  std::vector<HidInfo> infos;
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    if (!devices_[i]->connected()) continue;
    infos.push_back(devices_[i]->options().info);
    infos.back().path = path(i);
  }
  return infos;
}

std::unique_ptr<HidDevice> EmulatedHidBus::open(const std::string& path) {
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    if (!devices_[i]->connected() || this->path(i) != path) continue;
    if (!devices_[i]->options().permitted)
      throw Error({"permission denied", path, "install the udev rules, or ask the administrator"});
    return std::make_unique<EmulatedHandle>(*devices_[i], clock_);
  }
  throw Error({"there is no such device", path, "connect it again: press a button on it"});
}

EmulatedHandle::EmulatedHandle(EmulatedDevice& device, Clock& clock)
    : device_(device), clock_(clock) {
  device_.at_present([&](Time) {
    device_.listeners_.push_back(&listener_);
    listener_.gone = !device_.firmware_ && !device_.options_.slot;
  });
}

EmulatedHandle::~EmulatedHandle() {
  device_.at_present([&](Time) { std::erase(device_.listeners_, &listener_); });
}

HidRead EmulatedHandle::read(std::span<std::uint8_t> buffer, Time until) {
  while (true) {
    std::optional<HidRead> done;
    const Time wake = device_.at_present([&](Time now) {
      if (!listener_.queue.empty() && listener_.queue.front().at <= until) {
        const auto& [arrival, bytes] = listener_.queue.front();
        const std::size_t size = std::min(bytes.size(), buffer.size());
        std::copy_n(bytes.begin(), size, buffer.begin());
        done = HidRead{HidStatus::report, size, arrival};
        listener_.queue.pop_front();
      } else if (listener_.queue.empty() && listener_.gone) {
        done = HidRead{HidStatus::gone, 0, {}};
      } else if (now >= until) {
        done = HidRead{};
      }
      return std::min({until, now + kIdle, device_.next_event()});
    });
    if (done) return *done;
    clock_.sleep_until(wake);
  }
}

bool EmulatedHandle::write(std::span<const std::uint8_t> report) {
  if (report.size() < kShortestWrite) return false;
  return device_.at_present([&](Time now) {
    if (listener_.gone || !device_.firmware_) return false;
    device_.to_device_.push_back(
        {device_.link_.reaches_device(now), {report.begin(), report.end()}});
    return true;
  });
}

}  // namespace vindu
