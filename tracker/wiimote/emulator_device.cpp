#include "tracker/wiimote/emulator_device.h"

#include <algorithm>

namespace vindu {

EmulatedDevice::EmulatedDevice(EmulatedDeviceOptions options, WiimoteEmulator::Look look,
                               Clock& clock)
    : options_(std::move(options)),
      look_(std::move(look)),
      clock_(clock),
      random_(options_.seed ^ 0x2545f4914f6cdd1dULL),
      link_(options_.link, options_.seed) {
  connect(clock_.now());
}

void EmulatedDevice::connect(Time at) {
  if (options_.firmware.battery == 0) return;
  EmulatorOptions firmware = options_.firmware;
  firmware.start = at;
  firmware_.emplace(std::move(firmware), look_);
  if (!options_.kernel) return;
  KernelOptions kernel = *options_.kernel;
  kernel.seed += static_cast<std::uint64_t>(connections_);
  kernel_.emplace(kernel, at);
}

void EmulatedDevice::disconnect() {
  firmware_.reset();
  kernel_.reset();
  to_device_.clear();
  on_the_way_.clear();
  if (options_.slot) return;
  for (Listener* listener : listeners_) listener->gone = true;
}

Time EmulatedDevice::next_event() const {
  Time soonest = plugs_.empty() ? Time::max() : plugs_.front().at;
  if (!firmware_) return soonest;
  soonest = std::min(soonest, firmware_->next_event());
  if (kernel_) soonest = std::min(soonest, kernel_->next_event());
  if (!to_device_.empty()) soonest = std::min(soonest, to_device_.front().at);
  if (!on_the_way_.empty()) soonest = std::min(soonest, on_the_way_.front().at);
  return soonest;
}

void EmulatedDevice::advance(Time until) {
  for (Time at = next_event(); at <= until; at = next_event()) step(at);
}

// One thing that happens at this time, which is that of the next event.
void EmulatedDevice::step(Time at) {
  if (!plugs_.empty() && plugs_.front().at == at) {
    const bool in = plugs_.front().in;
    plugs_.pop_front();
    if (in == firmware_.has_value()) return;
    if (!in) return disconnect();
    ++connections_;
    return connect(at);
  }
  if (!on_the_way_.empty() && on_the_way_.front().at == at) {
    Arrival arrival = std::move(on_the_way_.front());
    on_the_way_.pop_front();
    return arrive(std::move(arrival));
  }
  if (!to_device_.empty() && to_device_.front().at == at) {
    const KernelWrite write = std::move(to_device_.front());
    to_device_.pop_front();
    firmware_->output(write.bytes, at);
    return;
  }
  if (kernel_ && kernel_->next_event() == at) {
    if (auto write = kernel_->next(at))
      to_device_.push_back({link_.reaches_device(write->at), std::move(write->bytes)});
    return;
  }
  if (const auto report = firmware_->next(at)) leave(*report);
}

void EmulatedDevice::leave(const EmulatedReport& report) {
  const std::uint8_t id = report.bytes[0];
  const auto arrival = link_.carry(report.at, id >= 0x30);
  const bool swallowed =
      id == 0x22 && acknowledgement_loss_ > 0 && random_.uniform(0, 1) < acknowledgement_loss_;
  if (!arrival || silent_ || swallowed) {
    ++counts_.lost;
    return;
  }
  on_the_way_.push_back({*arrival, {report.span().begin(), report.span().end()}});
}

void EmulatedDevice::arrive(Arrival arrival) {
  ++counts_.arrived;
  if (kernel_) kernel_->input(arrival.bytes, arrival.at);
  for (Listener* listener : listeners_) {
    if (options_.ring > 0 && listener->queue.size() >= options_.ring)
      ++counts_.dropped;
    else if (!listener->gone)
      listener->queue.push_back(arrival);
  }
}

void EmulatedDevice::schedule(Plug plug) {
  const auto later = std::ranges::upper_bound(plugs_, plug.at, {}, &Plug::at);
  plugs_.insert(later, plug);
}

void EmulatedDevice::stay_silent(bool silent) {
  at_present([&](Time) { silent_ = silent; });
}

void EmulatedDevice::lose_acknowledgements(double share) {
  at_present([&](Time) { acknowledgement_loss_ = share; });
}

void EmulatedDevice::send_status() {
  at_present([&](Time now) {
    if (firmware_) firmware_->send_status(now);
  });
}

void EmulatedDevice::send_garbage(int reports) {
  const auto byte = [&] { return static_cast<std::uint8_t>(random_.uniform(0, 256)); };
  at_present([&](Time now) {
    for (int i = 0; i < reports && firmware_; ++i) {
      EmulatedReport report;
      report.size = 1 + byte() % report.bytes.size();
      std::generate_n(report.bytes.begin(), report.size, byte);
      report.at = now;
      leave(report);
    }
  });
}

void EmulatedDevice::plug_extension(bool plugged) {
  at_present([&](Time now) {
    if (firmware_) firmware_->plug_extension(plugged, now);
  });
}

void EmulatedDevice::set_battery(std::uint8_t level) {
  at_present([&](Time) {
    options_.firmware.battery = level;
    if (firmware_) firmware_->set_battery(level);
    if (level == 0) disconnect();
  });
}

void EmulatedDevice::unplug() {
  at_present([&](Time) { disconnect(); });
}

void EmulatedDevice::plug_in() { plug_in_at(clock_.now()); }

void EmulatedDevice::unplug_at(Time time) {
  at_present([&](Time now) {
    schedule({time, false});
    advance(now);
  });
}

void EmulatedDevice::plug_in_at(Time time) {
  at_present([&](Time now) {
    schedule({time, true});
    advance(now);
  });
}

void EmulatedDevice::read_battery() {
  at_present([&](Time now) {
    if (kernel_) kernel_->read_battery(now);
  });
}

void EmulatedDevice::open_camera_node() {
  at_present([&](Time now) {
    if (kernel_) kernel_->open_camera_node(now);
  });
}

void EmulatedDevice::close_camera_node() {
  at_present([&](Time now) {
    if (kernel_) kernel_->close_camera_node(now);
  });
}

bool EmulatedDevice::connected() {
  return at_present([&](Time) { return firmware_.has_value() || options_.slot; });
}

std::uint8_t EmulatedDevice::leds() {
  return at_present([&](Time) { return firmware_ ? firmware_->leds() : std::uint8_t{0}; });
}

bool EmulatedDevice::rumbling() {
  return at_present([&](Time) { return firmware_ && firmware_->rumbling(); });
}

EmulatedDeviceCounts EmulatedDevice::counts() {
  return at_present([&](Time) { return counts_; });
}

int EmulatedDevice::connections() {
  return at_present([&](Time) { return connections_; });
}

}  // namespace vindu
