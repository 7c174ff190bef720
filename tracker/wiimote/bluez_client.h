// The calls to BlueZ over D-Bus' system bus, as values: nothing of D-Bus shows. Internal to
// bluez.cpp and bluez_pair.cpp. Source: BlueZ' doc/org.bluez.Adapter.rst and org.bluez.Device.rst.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracker/wiimote/bluez.h"

namespace sdbus {
class IConnection;
}

namespace vindu {

/// What BlueZ answers when it does not do what it is asked.
struct BluezRefusal {
  std::string name;  ///< without its prefix: "AuthenticationFailed"
  std::string text;  ///< "Authentication Failed", "br-connection-page-timeout"
};

/// Bound to one thread. DBUS_SYSTEM_BUS_ADDRESS names another bus than the system's.
class BluezClient {
 public:
  /// Throws Error when there is no bus.
  BluezClient();
  ~BluezClient();
  BluezClient(const BluezClient&) = delete;
  BluezClient& operator=(const BluezClient&) = delete;

  /// Throws Error when BlueZ is not there or may not be asked.
  BluezView look();

  /// Of BR/EDR devices alone; ends with this object. Nothing that is called below throws.
  std::optional<BluezRefusal> start_discovery(const std::string& adapter);
  /// Takes up to 40 s. BlueZ' own plugin supplies the PIN, so no agent is registered.
  std::optional<BluezRefusal> pair(const BluezDevice& device);
  /// A trusted device may connect without anybody being asked.
  std::optional<BluezRefusal> trust(const BluezDevice& device);
  /// All its profiles; takes up to 30 s.
  std::optional<BluezRefusal> connect(const BluezDevice& device);
  /// Disconnects the device and forgets its bond.
  std::optional<BluezRefusal> remove(const BluezDevice& device);

 private:
  std::unique_ptr<sdbus::IConnection> connection_;
};

}  // namespace vindu
