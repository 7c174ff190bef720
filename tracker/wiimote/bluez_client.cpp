#include "tracker/wiimote/bluez_client.h"

#include <sdbus-c++/sdbus-c++.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>

#include "core/error.h"
#include "tracker/wiimote/find.h"

namespace vindu {
namespace {

using namespace std::chrono_literals;
using Properties = std::map<std::string, sdbus::Variant>;
using Objects = std::map<sdbus::ObjectPath, std::map<std::string, Properties>>;

constexpr const char* kService = "org.bluez";
constexpr const char* kAdapter = "org.bluez.Adapter1";
constexpr const char* kDevice = "org.bluez.Device1";

template <typename Value>
std::optional<Value> property(const Properties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end() || !found->second.containsValueOfType<Value>()) return {};
  return found->second.get<Value>();
}

bool flag(const Properties& properties, const std::string& name) {
  return property<bool>(properties, name).value_or(false);
}

std::string text(const Properties& properties, const std::string& name) {
  return property<std::string>(properties, name).value_or("");
}

std::string after_last(const std::string& text, char mark) {
  return text.substr(text.rfind(mark) + 1);
}

std::string path_of(const std::string& adapter) { return "/org/bluez/" + adapter; }

std::string path_of(const BluezDevice& device) {
  std::string address = device.address;
  std::ranges::replace(address, ':', '_');
  return path_of(device.adapter) + "/dev_" + address;
}

BluezAdapter adapter_from(const std::string& path, const Properties& properties) {
  return {after_last(path, '/'), text(properties, "Address"), flag(properties, "Powered"),
          text(properties, "PowerState") == "off-blocked"};
}

// BlueZ 5.65 and later say by Bonded whether a pairing has a key that is kept.
BluezDevice device_from(const Properties& properties) {
  const auto adapter = property<sdbus::ObjectPath>(properties, "Adapter");
  return {.address = text(properties, "Address"),
          .name = text(properties, "Name"),
          .adapter = adapter ? after_last(*adapter, '/') : "",
          .paired = property<bool>(properties, "Bonded").value_or(flag(properties, "Paired")),
          .trusted = flag(properties, "Trusted"),
          .connected = flag(properties, "Connected"),
          .in_range = property<std::int16_t>(properties, "RSSI").has_value()};
}

bool is_wiimote(const std::string& name) {
  HidInfo info;
  info.name = name;
  return kind_of(info) != WiimoteKind::none;
}

BluezView view_of(const Objects& objects) {
  BluezView view;
  for (const auto& [path, interfaces] : objects)
    for (const auto& [interface, properties] : interfaces) {
      if (interface == kAdapter) view.adapters.push_back(adapter_from(path, properties));
      if (interface != kDevice) continue;
      const BluezDevice device = device_from(properties);
      if (is_wiimote(device.name)) view.wiimotes.push_back(device);
    }
  std::ranges::sort(view.adapters, {}, &BluezAdapter::name);
  std::ranges::sort(view.wiimotes, {}, [](const BluezDevice& device) {
    return std::tie(device.address, device.adapter);
  });
  return view;
}

Error cannot_ask(const sdbus::Error& error) {
  const std::string& name = error.getName();
  if (name.ends_with("AccessDenied"))
    return Error({"this user may not use Bluetooth", "BlueZ",
                  "sudo adduser $USER bluetooth and log in again, or run this with sudo"});
  constexpr const char* kAbsent[] = {"ServiceUnknown", "NameHasNoOwner", "NoSuchUnit",
                                     "NoReply",        "TimedOut",       "Timeout"};
  const bool absent =
      name.find(".Spawn.") != std::string::npos ||
      std::ranges::any_of(kAbsent, [&](const char* end) { return name.ends_with(end); });
  if (absent)
    return Error({"Bluetooth's service does not run", "BlueZ",
                  "sudo apt install bluez, then sudo systemctl enable --now bluetooth"});
  return Error({name + ": " + error.getMessage(), "BlueZ", "journalctl -u bluetooth says more"});
}

// `call` names the method and gives its arguments.
template <typename Call>
std::optional<BluezRefusal> refusal_of(sdbus::IConnection& connection, const std::string& path,
                                       const Call& call) {
  try {
    const auto proxy = sdbus::createProxy(connection, kService, path);
    call(*proxy);
    return std::nullopt;
  } catch (const sdbus::Error& error) {
    return BluezRefusal{after_last(error.getName(), '.'), error.getMessage()};
  }
}

}  // namespace

BluezClient::BluezClient() try : connection_(sdbus::createSystemBusConnection()) {
} catch (const sdbus::Error& error) {
  throw Error({"the system bus cannot be reached: " + error.getMessage(), "D-Bus",
               "sudo apt install dbus bluez, then sudo systemctl start dbus bluetooth"});
}

BluezClient::~BluezClient() = default;

BluezView BluezClient::look() try {
  const auto root = sdbus::createProxy(*connection_, kService, "/");
  Objects objects;
  root->callMethod("GetManagedObjects")
      .onInterface("org.freedesktop.DBus.ObjectManager")
      .withTimeout(10s)
      .storeResultsTo(objects);
  return view_of(objects);
} catch (const sdbus::Error& error) {
  throw cannot_ask(error);
}

std::optional<BluezRefusal> BluezClient::start_discovery(const std::string& adapter) {
  return refusal_of(*connection_, path_of(adapter), [](sdbus::IProxy& proxy) {
    const Properties filter = {{"Transport", sdbus::Variant(std::string("bredr"))}};
    proxy.callMethod("SetDiscoveryFilter").onInterface(kAdapter).withArguments(filter);
    proxy.callMethod("StartDiscovery").onInterface(kAdapter);
  });
}

std::optional<BluezRefusal> BluezClient::pair(const BluezDevice& device) {
  return refusal_of(*connection_, path_of(device), [](sdbus::IProxy& proxy) {
    proxy.callMethod("Pair").onInterface(kDevice).withTimeout(40s);
  });
}

std::optional<BluezRefusal> BluezClient::trust(const BluezDevice& device) {
  return refusal_of(*connection_, path_of(device), [](sdbus::IProxy& proxy) {
    proxy.setProperty("Trusted").onInterface(kDevice).toValue(true);
  });
}

std::optional<BluezRefusal> BluezClient::connect(const BluezDevice& device) {
  return refusal_of(*connection_, path_of(device), [](sdbus::IProxy& proxy) {
    proxy.callMethod("Connect").onInterface(kDevice).withTimeout(30s);
  });
}

std::optional<BluezRefusal> BluezClient::remove(const BluezDevice& device) {
  return refusal_of(*connection_, path_of(device.adapter), [&](sdbus::IProxy& proxy) {
    proxy.callMethod("RemoveDevice")
        .onInterface(kAdapter)
        .withArguments(sdbus::ObjectPath(path_of(device)));
  });
}

}  // namespace vindu
