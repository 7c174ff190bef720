#include "tracker/wiimote/reader.h"

#include <array>

#include "core/error.h"
#include "tracker/wiimote/report.h"

namespace vindu {

WiimoteReader::WiimoteReader(std::unique_ptr<HidDevice> device, int camera, const std::string& name)
    : device_(std::move(device)), camera_(camera) {
  constexpr std::array<std::uint8_t, 3> kStream0x33 = {0x12, 0x04, 0x33};  // 0x04: continuously
  if (!device_->write(kStream0x33))
    throw Error({"the Wiimote does not take the request for dots (report 0x12)", name,
                 "press 1 and 2 on it, or reconnect it, and start again"});
}

std::optional<Observation> WiimoteReader::next(Time until) {
  std::array<std::uint8_t, 64> buffer;
  while (!gone_) {
    const HidRead read = device_->read(buffer, until);
    gone_ = read.status == HidStatus::gone;
    if (read.status != HidStatus::report) return std::nullopt;
    const auto parsed = parse_report(std::span(buffer).first(read.size));
    if (parsed.report) {
      ++counts_.reports;
      return Observation{camera_, read.arrival, parsed.report->dots};
    }
    ++counts_.refused;
  }
  return std::nullopt;
}

}  // namespace vindu
