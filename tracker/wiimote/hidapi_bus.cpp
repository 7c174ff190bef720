#include "tracker/wiimote/hidapi_bus.h"

#include <hidapi.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>

#include "core/error.h"

namespace vindu {
namespace {

struct Close {
  void operator()(hid_device* device) const { hid_close(device); }
};
using Handle = std::unique_ptr<hid_device, Close>;

// hidapi names its texts wchar_t; names and addresses of Wiimotes are ASCII.
std::string narrow(const wchar_t* text) {
  std::string narrowed;
  for (; text && *text; ++text) narrowed += *text < 128 ? static_cast<char>(*text) : '?';
  return narrowed;
}

class HidapiDevice final : public HidDevice {
 public:
  HidapiDevice(Handle handle, Clock& clock) : handle_(std::move(handle)), clock_(clock) {}

  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until - clock_.now());
    const auto wait_ms = static_cast<int>(std::clamp<std::int64_t>(wait.count(), 0, 60'000));
    const int size = hid_read_timeout(handle_.get(), buffer.data(), buffer.size(), wait_ms);
    const Time arrival = clock_.now();
    if (size < 0) return {HidStatus::gone, 0, {}};
    if (size == 0) return {};
    return {HidStatus::report, static_cast<std::size_t>(size), arrival};
  }

  bool write(std::span<const std::uint8_t> report) override {
    return hid_write(handle_.get(), report.data(), report.size()) ==
           static_cast<int>(report.size());
  }

 private:
  Handle handle_;
  Clock& clock_;
};

Error cannot_open(const std::string& path, int error) {
  const std::string reason = std::string("cannot be opened: ") + std::strerror(error);
  if (error == EACCES || error == EPERM)
    return Error({reason, path,
                  "install the udev rules (cmake --install, or assets/70-vindu-wiimote.rules into "
                  "/etc/udev/rules.d), then reconnect the Wiimote"});
  return Error({reason, path, "reconnect the Wiimote"});
}

// hidapi promises nothing about threads for what is not bound to one device.
class HidapiBus final : public HidBus {
 public:
  explicit HidapiBus(Clock& clock) : clock_(clock) {}
  ~HidapiBus() override { hid_exit(); }
  HidapiBus(const HidapiBus&) = delete;
  HidapiBus& operator=(const HidapiBus&) = delete;

  std::vector<HidInfo> list() override {
    const std::lock_guard lock(mutex_);
    std::vector<HidInfo> found;
    hid_device_info* const first = hid_enumerate(0, 0);
    for (const hid_device_info* info = first; info; info = info->next)
      found.push_back({info->path, info->vendor_id, info->product_id, narrow(info->product_string),
                       narrow(info->serial_number)});
    hid_free_enumeration(first);
    return found;
  }

  std::unique_ptr<HidDevice> open(const std::string& path) override {
    const std::lock_guard lock(mutex_);
    errno = 0;
    Handle handle(hid_open_path(path.c_str()));
    if (!handle) throw cannot_open(path, errno ? errno : ENODEV);
    return std::make_unique<HidapiDevice>(std::move(handle), clock_);
  }

 private:
  Clock& clock_;
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<HidBus> make_hidapi_bus(Clock& clock) {
  if (hid_init() != 0)
    throw Error({"hidapi does not start", "HID devices", "is libhidapi-hidraw0 installed?"});
  return std::make_unique<HidapiBus>(clock);
}

std::string hidapi_version() { return hid_version_str(); }

}  // namespace vindu
