#include "tracker/wiimote/reader.h"

#include <algorithm>
#include <array>

namespace vindu {
namespace {

constexpr Duration kBreath = std::chrono::milliseconds(1);

}  // namespace

WiimoteReader::WiimoteReader(std::unique_ptr<HidDevice> device, int camera,
                             const WiimoteSettings& settings)
    : device_(std::move(device)), camera_(camera), session_(settings) {}

void WiimoteReader::reconnect(std::unique_ptr<HidDevice> device, Time now) {
  device_ = std::move(device);
  now_ = std::max(now_, now);
  gone_ = refuses_ = false;
  session_.reconnected(now_);
}

void WiimoteReader::write_outputs() {
  while (const auto output = session_.next_output(now_)) {
    const auto report = output->span();
    refuses_ = !device_->write(report) && !device_->write(report);
  }
}

std::optional<WiimoteSample> WiimoteReader::next_sample(Time until) {
  std::array<std::uint8_t, 64> buffer;
  if (now_ == Time::min()) now_ = until;
  while (!gone_) {
    write_outputs();
    const Time wait = std::min(until, std::max(session_.deadline(), now_ + kBreath));
    const HidRead read = device_->read(buffer, wait);
    gone_ = read.status == HidStatus::gone;
    if (gone_) session_.away(now_);
    if (read.status == HidStatus::report) {
      now_ = std::max(now_, read.arrival);
      const auto sample = session_.take(std::span(buffer).first(read.size), read.arrival);
      if (sample) return sample;
    } else if (read.status == HidStatus::nothing) {
      now_ = std::max(now_, wait);
      if (wait >= until) return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<Observation> WiimoteReader::next(Time until) {
  while (const auto sample = next_sample(until))
    if (const auto observation = observation_of(*sample)) return observation;
  return std::nullopt;
}

std::optional<Observation> WiimoteReader::observation_of(const WiimoteSample& sample) const {
  if (!sample.data.slots) return std::nullopt;
  return Observation{camera_, sample.arrival, dots_of(*sample.data.slots), sample.data.buttons};
}

}  // namespace vindu
