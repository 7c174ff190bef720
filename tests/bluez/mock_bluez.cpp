#include "tests/bluez/mock_bluez.h"

#include <sdbus-c++/sdbus-c++.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kAdapter = "org.bluez.Adapter1";
constexpr const char* kDevice = "org.bluez.Device1";
constexpr const char* kMock = "org.freedesktop.DBus.Mock";

pid_t start(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t child = -1;
  if (posix_spawnp(&child, pointers.front(), nullptr, nullptr, pointers.data(), environ))
    throw std::runtime_error("cannot start " + words.front());
  return child;
}

void end(pid_t child) {
  if (child <= 0) return;
  kill(child, SIGTERM);
  waitpid(child, nullptr, 0);
}

void wait_until(const std::string& what, const std::function<bool()>& there) {
  const auto limit = std::chrono::steady_clock::now() + 60s;
  while (!there()) {
    if (std::chrono::steady_clock::now() > limit) throw std::runtime_error("waited for " + what);
    std::this_thread::sleep_for(20ms);
  }
}

std::string configuration(const std::string& socket, const std::string& forbidden) {
  const std::string rule = forbidden.empty()
                               ? ""
                               : "<deny send_destination='" + forbidden + "' send_interface='" +
                                     "org.freedesktop.DBus.ObjectManager'/>";
  return "<!DOCTYPE busconfig PUBLIC '-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN' "
         "'http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd'>\n"
         "<busconfig><listen>unix:path=" +
         socket +
         "</listen><auth>EXTERNAL</auth><policy context='default'><allow own='*'/>"
         "<allow send_destination='*' eavesdrop='true'/><allow eavesdrop='true'/>" +
         rule + "</policy></busconfig>\n";
}

std::string path_of(const std::string& adapter, std::string address = "") {
  std::ranges::replace(address, ':', '_');
  return "/org/bluez/" + adapter + (address.empty() ? "" : "/dev_" + address);
}

void set_property(sdbus::IConnection& connection, const std::string& path, const char* interface,
                  const std::string& property, const sdbus::Variant& value) {
  const std::map<std::string, sdbus::Variant> values = {{property, value}};
  const auto proxy = sdbus::createProxy(connection, "org.bluez", path);
  const auto call = [&](const char* method) {
    proxy->callMethod(method).onInterface(kMock).withArguments(std::string(interface), values);
  };
  try {
    call("UpdateProperties");
  } catch (const sdbus::Error&) {
    call("AddProperties");  // the template does not have it
  }
}

/// Replaces the template's method: that one does not change the properties it reports.
void answer(sdbus::IConnection& connection, const std::string& path, const std::string& method,
            const std::string& error, const std::string& deed) {
  const std::string code =
      error.empty()
          ? deed
          : "raise dbus.exceptions.DBusException('mocked', name='org.bluez.Error." + error + "')";
  sdbus::createProxy(connection, "org.bluez", path)
      ->callMethod("AddMethod")
      .onInterface(kMock)
      .withArguments(std::string(kDevice), method, std::string(), std::string(), code);
}

// The name comes last, as from real BlueZ: nobody takes it for a Wiimote before its methods are
// there.
void add(sdbus::IConnection& connection, const std::string& adapter, const std::string& address,
         const std::string& name, const MockAnswers& answers) {
  std::string path;
  sdbus::createProxy(connection, "org.bluez", "/")
      ->callMethod("AddDevice")
      .onInterface("org.bluez.Mock")
      .withArguments(adapter, address, std::string())
      .storeResultsTo(path);
  answer(connection, path, "Pair", answers.pair,
         "self.UpdateProperties('org.bluez.Device1', {'Paired': dbus.Boolean(True)})");
  answer(connection, path, "Connect", answers.connect,
         "self.UpdateProperties('org.bluez.Device1', {'Connected': dbus.Boolean(True)})");
  set_property(connection, path, kDevice, "Name", sdbus::Variant(name));
}

/// A socket's file is there before anybody listens.
bool listens_at(const fs::path& socket_file) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  socket_file.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int socket_id = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool connected =
      connect(socket_id, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(socket_id);
  return connected;
}

bool searching(sdbus::IConnection& connection, const std::string& adapter) {
  return sdbus::createProxy(connection, "org.bluez", path_of(adapter))
      ->getProperty("Discovering")
      .onInterface(kAdapter)
      .get<bool>();
}

}  // namespace

PrivateBus::PrivateBus(const std::string& forbidden) {
  std::string pattern = (fs::temp_directory_path() / "vindu_bus_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  folder_ = pattern;
  const fs::path socket = folder_ / "socket";
  std::ofstream(folder_ / "bus.conf") << configuration(socket, forbidden);
  daemon_ = start({"dbus-daemon", "--nofork", "--config-file=" + (folder_ / "bus.conf").string()});
  address_ = "unix:path=" + socket.string();
  wait_until("the bus", [&] { return listens_at(socket); });
  setenv("DBUS_SYSTEM_BUS_ADDRESS", address_.c_str(), 1);
}

PrivateBus::~PrivateBus() {
  unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
  end(daemon_);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

MockBluez::MockBluez(const PrivateBus& bus)
    : connection_(sdbus::createSessionBusConnectionWithAddress(bus.address())) {
  // Debian's modules are those of the Python in /usr/bin.
  service_ = start({"/usr/bin/python3", "-m", "dbusmock", "--system", "--logfile", "/dev/null",
                    "--template", "bluez5"});
  const auto broker = sdbus::createProxy(*connection_, "org.freedesktop.DBus", "/");
  wait_until("the mocked BlueZ", [&] {
    if (waitpid(service_, nullptr, WNOHANG) != 0)
      throw std::runtime_error("the mocked BlueZ has ended: is python3-dbusmock installed?");
    bool owned = false;
    broker->callMethod("NameHasOwner")
        .onInterface("org.freedesktop.DBus")
        .withArguments("org.bluez")
        .storeResultsTo(owned);
    return owned;
  });
}

MockBluez::~MockBluez() {
  threads_.clear();
  end(service_);
}

void MockBluez::add_adapter(const std::string& name) {
  std::string path;
  sdbus::createProxy(*connection_, "org.bluez", "/")
      ->callMethod("AddAdapter")
      .onInterface("org.bluez.Mock")
      .withArguments(name, "a test's")
      .storeResultsTo(path);
}

void MockBluez::set_adapter(const std::string& name, const std::string& property, bool value) {
  set_property(*connection_, path_of(name), kAdapter, property, sdbus::Variant(value));
}

void MockBluez::set_adapter_text(const std::string& name, const std::string& property,
                                 const std::string& value) {
  set_property(*connection_, path_of(name), kAdapter, property, sdbus::Variant(value));
}

void MockBluez::add_device(const std::string& adapter, const std::string& address,
                           const std::string& name, const MockAnswers& answers) {
  add(*connection_, adapter, address, name, answers);
}

void MockBluez::set_device(const std::string& adapter, const std::string& address,
                           const std::string& property, bool value) {
  set_property(*connection_, path_of(adapter, address), kDevice, property, sdbus::Variant(value));
}

void MockBluez::add_bonded(const std::string& adapter, const std::string& address) {
  add_device(adapter, address, "Nintendo RVL-CNT-01");
  set_device(adapter, address, "Paired", true);
}

void MockBluez::add_device_in_discovery(const std::string& adapter, const std::string& address,
                                        const std::string& name, const MockAnswers& answers) {
  const std::string bus = getenv("DBUS_SYSTEM_BUS_ADDRESS");
  threads_.emplace_back([=](const std::stop_token& stop) {
    const auto connection = sdbus::createSessionBusConnectionWithAddress(bus);
    while (!stop.stop_requested() && !searching(*connection, adapter))
      std::this_thread::sleep_for(20ms);
    std::this_thread::sleep_for(500ms);
    if (!stop.stop_requested()) add(*connection, adapter, address, name, answers);
  });
}

std::string MockBluez::discovery_transport(const std::string& adapter) {
  const sdbus::Variant filter = sdbus::createProxy(*connection_, "org.bluez", path_of(adapter))
                                    ->getProperty("DiscoveryFilter")
                                    .onInterface(kAdapter);
  return filter.get<std::map<std::string, sdbus::Variant>>().at("Transport").get<std::string>();
}

}  // namespace vindu::testing
