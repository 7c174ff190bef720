#include "tracker/wiimote/uhid_device.h"

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "core/error.h"

namespace vindu {
namespace {

Error cannot_open_uhid(const std::string& node, int error) {
  if (error == EACCES || error == EPERM)
    return Error({"you may not open it", node,
                  "run this as root, or allow it to yourself: sudo setfacl -m u:$USER:rw " + node});
  if (error == ENOENT || error == ENODEV || error == ENXIO)
    return Error({"this machine's kernel does not offer it", node,
                  "load its module, sudo modprobe uhid; a container may need --device " + node});
  return Error({std::string("cannot be opened: ") + std::strerror(error), node,
                "see that the kernel's module uhid is loaded"});
}

/// Events may be written short: the kernel fills up with zeros.
bool send(int file, const uhid_event& event, std::size_t size) {
  return ::write(file, &event, size) == static_cast<ssize_t>(size);
}

template <std::size_t kSize>
void copy_text(const std::string& text, __u8 (&to)[kSize]) {
  std::ranges::copy_n(text.begin(), static_cast<long>(std::min(text.size(), kSize - 1)), to);
}

uhid_event creation(const HidInfo& identity, std::span<const std::uint8_t> descriptor) {
  assert(!descriptor.empty() && descriptor.size() <= HID_MAX_DESCRIPTOR_SIZE);
  uhid_event event{};
  event.type = UHID_CREATE2;
  uhid_create2_req& request = event.u.create2;
  copy_text(identity.name, request.name);
  copy_text(identity.address, request.uniq);
  request.bus = BUS_BLUETOOTH;
  request.vendor = identity.vendor_id;
  request.product = identity.product_id;
  request.rd_size = static_cast<__u16>(descriptor.size());
  std::ranges::copy(descriptor, request.rd_data);
  return event;
}

std::vector<std::uint8_t> bytes_of(const __u8* data, std::size_t size) {
  return {data, data + std::min<std::size_t>(size, UHID_DATA_MAX)};
}

void answer_get(int file, const uhid_get_report_req& request) {
  uhid_event answer{};
  answer.type = UHID_GET_REPORT_REPLY;
  answer.u.get_report_reply.id = request.id;
  answer.u.get_report_reply.err = EIO;
  send(file, answer, offsetof(uhid_event, u.get_report_reply.data));
}

void answer_set(int file, const uhid_set_report_req& request, bool taken) {
  uhid_event answer{};
  answer.type = UHID_SET_REPORT_REPLY;
  answer.u.set_report_reply.id = request.id;
  answer.u.set_report_reply.err = taken ? 0 : EIO;
  send(file, answer, offsetof(uhid_event, u.set_report_reply) + sizeof(uhid_set_report_reply_req));
}

/// The output report in an event, if it is one; requests are answered.
std::optional<std::vector<std::uint8_t>> handle(int file, const uhid_event& event) {
  switch (event.type) {
    case UHID_OUTPUT:
      return bytes_of(event.u.output.data, event.u.output.size);
    case UHID_SET_REPORT: {
      const bool taken = event.u.set_report.rtype == UHID_OUTPUT_REPORT;
      answer_set(file, event.u.set_report, taken);
      if (taken) return bytes_of(event.u.set_report.data, event.u.set_report.size);
      return std::nullopt;
    }
    case UHID_GET_REPORT:
      answer_get(file, event.u.get_report);
      return std::nullopt;
    default:  // started, stopped, opened, closed: a Wiimote is not told
      return std::nullopt;
  }
}

/// False when nothing has come by then.
bool wait_for_event(int file, Time until) {
  const auto left = std::max(Duration::zero(), Duration(until - MonotonicClock().now()));
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec limit{whole.count(), (left - whole).count()};
  pollfd wanted{file, POLLIN, 0};
  return ::ppoll(&wanted, 1, &limit, nullptr) > 0;
}

}  // namespace

UhidDevice::UhidDevice(const HidInfo& identity, std::span<const std::uint8_t> report_descriptor,
                       const std::string& node)
    : file_(::open(node.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0) throw cannot_open_uhid(node, errno);
  const uhid_event event = creation(identity, report_descriptor);
  if (send(file_, event, offsetof(uhid_event, u.create2.rd_data) + report_descriptor.size()))
    return;
  const std::string reason = std::strerror(errno);
  ::close(file_);
  throw Error({"the kernel does not make the device " + identity.name + ": " + reason, node,
               "see that it is the kernel's uhid, and what dmesg says"});
}

UhidDevice::~UhidDevice() {
  uhid_event event{};
  event.type = UHID_DESTROY;
  send(file_, event, sizeof(event.type));
  ::close(file_);
}

std::optional<std::vector<std::uint8_t>> UhidDevice::next_output(Time until) {
  while (wait_for_event(file_, until)) {
    uhid_event event{};
    if (::read(file_, &event, sizeof(event)) < static_cast<ssize_t>(sizeof(event.type))) break;
    if (auto report = handle(file_, event)) return report;
  }
  return std::nullopt;
}

bool UhidDevice::input(std::span<const std::uint8_t> report) {
  assert(report.size() <= UHID_DATA_MAX);
  uhid_event event{};
  event.type = UHID_INPUT2;
  event.u.input2.size = static_cast<__u16>(report.size());
  std::ranges::copy(report, event.u.input2.data);
  return send(file_, event, offsetof(uhid_event, u.input2.data) + report.size());
}

bool serve(WiimoteEmulator& wiimote, UhidDevice& device, Time until, const OutputTap& tap) {
  const MonotonicClock clock;
  for (Time now = clock.now(); now < until && wiimote.alive(); now = clock.now()) {
    while (const auto report = wiimote.next(now)) device.input(report->span());
    const auto output = device.next_output(std::min(until, wiimote.next_event()));
    if (!output) continue;
    if (tap) tap(*output);
    wiimote.output(*output, clock.now());
  }
  return wiimote.alive();
}

}  // namespace vindu
