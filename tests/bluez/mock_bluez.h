// A private D-Bus system bus, and on it python-dbusmock's BlueZ: real processes, which a test fills
// with adapters and devices. What the code under test starts finds the bus by
// DBUS_SYSTEM_BUS_ADDRESS.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace sdbus {
class IConnection;
}

namespace vindu::testing {

constexpr const char* kWiimoteName = "Nintendo RVL-CNT-01";

/// The bus alone. Ends with its scope.
class PrivateBus {
 public:
  /// Whoever asks for `forbidden` is denied; empty: nothing is.
  explicit PrivateBus(const std::string& forbidden = "");
  ~PrivateBus();
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;

  const std::string& address() const { return address_; }

 private:
  std::filesystem::path folder_;
  std::string address_;
  pid_t daemon_ = -1;
};

/// How a device answers to Pair and to Connect: empty, it obeys; else BlueZ's error.
struct MockAnswers {
  std::string pair = {};
  std::string connect = {};
};

/// BlueZ on a bus. Paths are BlueZ' own: /org/bluez/hci0/dev_AA_...
class MockBluez {
 public:
  explicit MockBluez(const PrivateBus& bus);
  ~MockBluez();
  MockBluez(const MockBluez&) = delete;
  MockBluez& operator=(const MockBluez&) = delete;

  void add_adapter(const std::string& name);
  void set_adapter(const std::string& name, const std::string& property, bool value);
  void set_adapter_text(const std::string& name, const std::string& property,
                        const std::string& value);

  void add_device(const std::string& adapter, const std::string& address, const std::string& name,
                  const MockAnswers& answers = {});
  void set_device(const std::string& adapter, const std::string& address,
                  const std::string& property, bool value);
  /// As after an earlier pairing.
  void add_bonded(const std::string& adapter, const std::string& address);
  /// A short while after the adapter has begun to search.
  void add_device_in_discovery(const std::string& adapter, const std::string& address,
                               const std::string& name, const MockAnswers& answers = {});
  /// What the adapter was told to search for: its filter's Transport.
  std::string discovery_transport(const std::string& adapter);

 private:
  std::unique_ptr<sdbus::IConnection> connection_;
  pid_t service_ = -1;
  std::vector<std::jthread> threads_;
};

}  // namespace vindu::testing
