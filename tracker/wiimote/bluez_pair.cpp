#include "tracker/wiimote/bluez_pair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/log.h"
#include "tracker/wiimote/bluez_client.h"

namespace vindu {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLookEvery = 300ms;
constexpr Duration kDiscoverable = 20s;  // of a Wiimote, after its red button

constexpr const char* kPressRed =
    "open the battery lid and press the red button once; the lights blink for 20 s. Not 1+2: that "
    "does not bond, and would have to be pressed again each time";

Error switched_off(const BluezAdapter& adapter) {
  if (adapter.blocked)
    return Error({"is blocked by rfkill", adapter.name,
                  "sudo rfkill unblock bluetooth, or the switch or key of this machine"});
  return Error({"is switched off", adapter.name,
                "bluetoothctl power on; where that fails, sudo rfkill unblock bluetooth"});
}

std::size_t wiimotes_on(const BluezView& view, const std::string& adapter) {
  return static_cast<std::size_t>(
      std::ranges::count_if(view.wiimotes, [&](const BluezDevice& device) {
        return device.adapter == adapter && (device.paired || device.connected);
      }));
}

BluezAdapter named_adapter(const BluezView& view, const std::string& name) {
  const auto found = std::ranges::find(view.adapters, name, &BluezAdapter::name);
  if (found != view.adapters.end()) return *found;
  std::vector<std::string> names;
  for (const BluezAdapter& adapter : view.adapters) names.push_back(adapter.name);
  throw Error({"there is no such Bluetooth adapter", name,
               fmt::format("there is {}", fmt::join(names, ", "))});
}

/// The fewest Wiimotes, among those that are switched on where any is.
BluezAdapter choose_adapter(const BluezView& view, const std::string& name) {
  if (view.adapters.empty())
    throw Error({"there is no Bluetooth adapter", "BlueZ",
                 "plug one in; if there is one, sudo dmesg | grep -i -e bluetooth -e firmware "
                 "says what it lacks"});
  BluezAdapter chosen =
      !name.empty() ? named_adapter(view, name)
                    : *std::ranges::min_element(view.adapters, {}, [&](const BluezAdapter& a) {
                        return std::pair(!a.powered, wiimotes_on(view, a.name));
                      });
  if (!chosen.powered) throw switched_off(chosen);
  return chosen;
}

struct Explanation {
  std::string trouble;
  std::string remedy;
};

Explanation explain_pairing(const BluezRefusal& refusal) {
  const std::string trouble = fmt::format("pairing failed: {} ({})", refusal.name, refusal.text);
  if (refusal.name.starts_with("Authentication"))
    return {
        trouble,
        "press the red button under the battery lid, not 1+2; if it was the red one, see "
        "\"Authentication\" in docs/wiimotes.md: BlueZ without its wiimote plugin, or a release "
        "later than 5.72 that has trouble with some Wiimotes, the -TR above all"};
  return {trouble, "press the red button again, within a metre of the adapter"};
}

Explanation explain_connection(const BluezRefusal& refusal) {
  return {fmt::format("bonded, but the connection failed: {} ({})", refusal.name, refusal.text),
          "press any of its buttons, or the red one again; journalctl -u bluetooth says more"};
}

Explanation explain_no_hid(Duration waited) {
  return {
      fmt::format("connected, but no HID device appeared within {:g} s", seconds(waited)),
      "sudo modprobe uhid hid_wiimote; if journalctl -u bluetooth speaks of a device that is not "
      "bonded, press the red button, or set ClassicBondedOnly=false in "
      "/etc/bluetooth/input.conf and restart bluetooth"};
}

class Pairing {
 public:
  Pairing(const PairOptions& options, HidBus& hid, Clock& clock)
      : options_(options), hid_(hid), clock_(clock) {}

  std::vector<PairResult> run() {
    begin();
    Time give_up = clock_.now() + options_.patience;
    while (count_ready() < options_.count && clock_.now() < give_up) {
      const int before = count_ready();
      for (const BluezDevice& device : client_.look().wiimotes)
        if (count_ready() < options_.count && wants_pairing(device)) attempt(device);
      if (count_ready() > before) give_up = clock_.now() + options_.patience;
      remind(give_up);
      clock_.sleep_until(clock_.now() + kLookEvery);
    }
    return results();
  }

 private:
  void begin() {
    const BluezView view = client_.look();
    adapter_ = choose_adapter(view, options_.adapter);
    for (const BluezDevice& device : view.wiimotes) forget_without_bond(device);
    if (const auto refusal = client_.start_discovery(adapter_.name))
      throw Error({fmt::format("cannot search: {} ({})", refusal->name, refusal->text),
                   adapter_.name, "bluetoothctl show and journalctl -u bluetooth say more"});
    log_info(adapter_.name, fmt::format("searching. On the Wiimote, {}", kPressRed));
    next_reminder_ = clock_.now() + kDiscoverable;
  }

  void forget_without_bond(const BluezDevice& device) {
    if (device.adapter != adapter_.name) return;
    if (device.paired) {
      if (!device.connected)
        log_info(device.address, "is bonded already: any of its buttons connects it");
      return;
    }
    log_info(device.address, "is known but not bonded: removed, to be paired anew");
    client_.remove(device);
  }

  bool wants_pairing(const BluezDevice& device) const {
    if (device.adapter != adapter_.name) return false;
    const auto known = results_.find(device.address);
    if (known != results_.end() && known->second.ready()) return false;
    return !device.paired || (device.in_range && !device.connected);
  }

  void attempt(const BluezDevice& device) {
    PairResult& result = results_[device.address];
    result.device = device;
    if (!device.paired) {
      log_info(device.address, fmt::format("found: {}; pairing", device.name));
      const auto refusal = client_.pair(device);
      if (refusal && refusal->name != "AlreadyExists") {
        fail(result, explain_pairing(*refusal));
        client_.remove(device);  // what is left of it would stand in the way of the next try
        return;
      }
    }
    client_.trust(device);
    connect(result);
  }

  // The Wiimote may be faster: then it is connected, or being connected, already.
  void connect(PairResult& result) {
    const std::string address = result.device.address;
    log_info(address, "bonded; connecting");
    const auto refusal = client_.connect(result.device);
    if (refusal && refusal->name != "AlreadyConnected" && refusal->name != "InProgress") {
      fail(result, explain_connection(*refusal));
      if (++failed_connections_[address] % 2 == 0) client_.remove(result.device);  // a stale bond
      return;
    }
    if (!wait_for_hid(address)) return fail(result, explain_no_hid(options_.hid_wait));
    result.trouble.clear();
    result.remedy.clear();
    log_info(address, "ready; from now on any of its buttons connects it");
  }

  bool wait_for_hid(const std::string& address) {
    const Time give_up = clock_.now() + options_.hid_wait;
    while (true) {
      for (const HidInfo& info : hid_.list())
        if (same_address(info.address, address)) return true;
      if (clock_.now() >= give_up) return false;
      clock_.sleep_until(clock_.now() + kLookEvery);
    }
  }

  static void fail(PairResult& result, const Explanation& why) {
    result.trouble = why.trouble;
    result.remedy = why.remedy;
    log_warning(result.device.address, why.trouble + "; " + why.remedy);
  }

  void remind(Time give_up) {
    if (clock_.now() < next_reminder_) return;
    next_reminder_ = clock_.now() + kDiscoverable;
    const double left_s = seconds(give_up - clock_.now());
    if (left_s > 0)
      log_info(adapter_.name, fmt::format("still searching, {:.0f} s left; {}", left_s, kPressRed));
  }

  int count_ready() const {
    return static_cast<int>(
        std::ranges::count_if(results_, [](const auto& entry) { return entry.second.ready(); }));
  }

  /// With the devices as they are now.
  std::vector<PairResult> results() {
    const BluezView view = client_.look();
    std::vector<PairResult> results;
    for (auto& [address, result] : results_) {
      result.device.paired = result.device.trusted = result.device.connected = false;
      for (const BluezDevice& device : view.wiimotes)
        if (device.address == address && device.adapter == adapter_.name) result.device = device;
      results.push_back(result);
    }
    return results;
  }

  const PairOptions& options_;
  HidBus& hid_;
  Clock& clock_;
  BluezClient client_;
  BluezAdapter adapter_;
  std::map<std::string, PairResult> results_;
  std::map<std::string, int> failed_connections_;
  Time next_reminder_{};
};

}  // namespace

std::vector<PairResult> pair_wiimotes(const PairOptions& options, HidBus& hid, Clock& clock) {
  return Pairing(options, hid, clock).run();
}

}  // namespace vindu
