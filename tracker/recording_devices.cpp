#include "tracker/recording_devices.h"

#include <algorithm>

namespace vindu {

HidRead RecordingHidDevice::read(std::span<std::uint8_t> buffer, Time until) {
  const HidRead read = device_->read(buffer, until);
  if (read.status == HidStatus::report && read.size > 0)
    writer_.add(index_, read.arrival, buffer.first(std::min(read.size, kMaxRecordedReport)));
  return read;
}

ReplayHidDevice::ReplayHidDevice(const std::string& file, int device, Clock& clock,
                                 const ReplayOptions& options)
    : reader_(file, options.damage), device_(device), clock_(clock), shift_(options.shift) {
  fetch();
}

void ReplayHidDevice::fetch() {
  do next_ = reader_.next();
  while (next_ && next_->device != device_);
  if (next_) next_->arrival = last_arrival_ = std::max(last_arrival_, next_->arrival + shift_);
}

HidRead ReplayHidDevice::read(std::span<std::uint8_t> buffer, Time until) {
  if (!next_) return {HidStatus::gone, 0, {}};
  if (next_->arrival > until) {
    clock_.sleep_until(until);
    return {};
  }
  clock_.sleep_until(next_->arrival);
  const std::size_t size = std::min(buffer.size(), next_->bytes.size());
  std::copy_n(next_->bytes.begin(), size, buffer.begin());
  const HidRead read{HidStatus::report, size, next_->arrival};
  fetch();
  return read;
}

}  // namespace vindu
