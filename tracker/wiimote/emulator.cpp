#include "tracker/wiimote/emulator.h"

#include <algorithm>
#include <cassert>

namespace vindu {
namespace {

// Output reports: 0x10 up, payload bytes of each.
constexpr std::array<std::size_t, 11> kOutputBytes = {1, 1, 2, 1, 1, 1, 21, 6, 21, 1, 1};
constexpr std::uint8_t kRumbleBit = 0x01;
constexpr std::uint8_t kAckBit = 0x02;
constexpr std::uint8_t kOnBit = 0x04;
constexpr std::uint8_t kLowBattery = 0x20;
constexpr std::uint8_t kDotRegisters = 0x37;

// What a data report holds behind its id, in this order.
struct Layout {
  std::uint8_t id;
  std::size_t buttons, acceleration, dots, extension;
};
constexpr std::array<Layout, 11> kLayouts = {{{0x30, 2, 0, 0, 0},
                                              {0x31, 2, 3, 0, 0},
                                              {0x32, 2, 0, 0, 8},
                                              {0x33, 2, 3, 12, 0},
                                              {0x34, 2, 0, 0, 19},
                                              {0x35, 2, 3, 0, 16},
                                              {0x36, 2, 0, 10, 9},
                                              {0x37, 2, 3, 10, 6},
                                              {0x3d, 0, 0, 0, 21},
                                              {0x3e, 2, 1, 18, 0},
                                              {0x3f, 2, 1, 18, 0}}};

const Layout* layout_of(std::uint8_t id) {
  const auto found = std::ranges::find(kLayouts, id, &Layout::id);
  return found == kLayouts.end() ? nullptr : &*found;
}

// The camera's mode whose bytes a report shows: 10 of basic, 12 of extended, half of full.
std::uint8_t camera_mode_for(const Layout& layout) {
  return layout.dots == 10 ? 1 : layout.dots == 12 ? 3 : 5;
}

std::uint8_t low_byte(std::size_t value) { return static_cast<std::uint8_t>(value % 256); }

std::array<std::uint8_t, 2> button_bytes(std::uint8_t buttons_1, std::uint8_t buttons_2) {
  return {low_byte(buttons_1 % 32u), low_byte(buttons_2 % 32u + buttons_2 / 128 * 128u)};
}

/// The high bytes, and the low bits among the buttons: x1 x0 in 6 and 5 of the first button byte,
/// z1 in 6 and y1 in 5 of the second.
std::array<std::uint8_t, 3> accelerate(std::span<std::uint8_t, 2> buttons,
                                       const std::array<int, 3>& raw) {
  const auto [x, y, z] = raw;
  assert(x >= 0 && x < 1024 && y >= 0 && y < 1024 && z >= 0 && z < 1024);
  buttons[0] = static_cast<std::uint8_t>(buttons[0] + x % 4 * 32);
  buttons[1] = static_cast<std::uint8_t>(buttons[1] + y % 4 / 2 * 32 + z % 4 / 2 * 64);
  return {low_byte(x / 4u), low_byte(y / 4u), low_byte(z / 4u)};
}

/// Of a pair 0x3e, 0x3f: the first carries x and z's bits 7..4 of its high byte, the second y and
/// bits 3..0; two of them in bits 6 and 5 of each button byte, the higher pair in the second.
std::uint8_t accelerate_half(std::span<std::uint8_t, 2> buttons, const std::array<int, 3>& raw,
                             bool first) {
  const int z = raw[2] / 4;
  const int nibble = first ? z / 16 : z % 16;
  buttons[0] = static_cast<std::uint8_t>(buttons[0] + nibble % 4 * 32);
  buttons[1] = static_cast<std::uint8_t>(buttons[1] + nibble / 4 * 32);
  return low_byte(static_cast<std::size_t>(raw[first ? 0 : 1]) / 4);
}

}  // namespace

WiimoteEmulator::WiimoteEmulator(EmulatorOptions options, Look look)
    : options_(std::move(options)),
      look_(std::move(look)),
      memory_(options_.eeprom, options_.motion_plus),
      battery_(options_.battery),
      next_sample_(options_.start + options_.phase) {
  assert(options_.report_period > Duration::zero());
  if (options_.camera_already_on) memory_.camera().start(3);
}

bool WiimoteEmulator::output(std::span<const std::uint8_t> report, Time at) {
  if (!alive() || report.empty() || report[0] < 0x10 || report[0] > 0x1a) return false;
  if (report.size() != 1 + kOutputBytes[report[0] - 0x10u]) return true;
  rumbling_ = (report[1] & kRumbleBit) != 0;
  obey(report[0], report.subspan(1), at);
  return true;
}

void WiimoteEmulator::obey(std::uint8_t id, std::span<const std::uint8_t> payload, Time at) {
  if (id == 0x10 || id == 0x18) return;
  if (id == 0x15) return send_status(at);
  if (id == 0x16) return write_memory(payload, at);
  if (id == 0x17) return read_memory(payload, at);
  if (id == 0x12 && !layout_of(payload[1])) return;
  if (id == 0x11) leds_ = payload[0] / 16;
  if (id == 0x12) set_mode(payload, at);
  if (id == 0x13 || id == 0x14 || id == 0x1a) enable(id, (payload[0] & kOnBit) != 0);
  if ((payload[0] & kAckBit) != 0) acknowledge(id, MemoryError::none, at);
}

void WiimoteEmulator::enable(std::uint8_t id, bool on) {
  if (id == 0x13) memory_.camera().set_power(on);
  if (id == 0x1a) memory_.camera().set_logic(on);
  if (id == 0x14) speaker_ = on;
}

void WiimoteEmulator::set_mode(std::span<const std::uint8_t> payload, Time at) {
  continuous_ = (payload[0] & kOnBit) != 0;
  mode_ = payload[1];
  forced_ = at + options_.command_time;
  second_half_.reset();
  last_.reset();
}

void WiimoteEmulator::send_status(Time at) {
  const int flags = (battery_ < kLowBattery ? 0x01 : 0) + (memory_.extension_answers() ? 0x02 : 0) +
                    (speaker_ ? 0x04 : 0) + (memory_.camera().powered() ? 0x08 : 0) + leds_ * 16;
  reply({0x20, static_cast<std::uint8_t>(flags), 0, 0, battery_}, at);
}

void WiimoteEmulator::plug_extension(bool plugged, Time at) {
  memory_.plug_extension(plugged);
  report_plug(at);
}

void WiimoteEmulator::report_plug(Time at) {
  if (memory_.extension_answers() == extension_seen_) return;
  extension_seen_ = !extension_seen_;
  send_status(at);
}

void WiimoteEmulator::write_memory(std::span<const std::uint8_t> payload, Time at) {
  const std::size_t size = payload[4];
  if (size == 0 || size > 16) return;
  if (writing_ && options_.loses_early_writes) return;
  const std::uint32_t address = payload[1] * 0x10000u + payload[2] * 0x100u + payload[3];
  const MemoryError error = memory_.write(payload[0], address, payload.subspan(5, size));
  writing_ = true;
  acknowledge(0x16, error, at, After::write_done);
  report_plug(at);
}

void WiimoteEmulator::read_memory(std::span<const std::uint8_t> payload, Time at) {
  const std::size_t size = payload[4] * 0x100u + payload[5];
  if (reading_) return acknowledge(0x17, MemoryError::busy, at);
  if (size == 0) return;
  const std::uint32_t address = payload[1] * 0x10000u + payload[2] * 0x100u + payload[3];
  std::vector<std::uint8_t> memory(size);
  const MemoryError error = memory_.read(payload[0], address, memory);
  reading_ = true;
  if (error != MemoryError::none) {
    std::vector<std::uint8_t> bytes(20);
    bytes[0] = 0x21;
    bytes[1] = static_cast<std::uint8_t>(0xf0 + static_cast<int>(error));
    bytes[2] = payload[2], bytes[3] = payload[3];
    return reply(std::move(bytes), at, After::read_done);
  }
  for (std::size_t done = 0; done < size; done += 16, at += options_.chunk_time) {
    const std::size_t part = std::min<std::size_t>(16, size - done);
    std::vector<std::uint8_t> bytes(20);
    bytes[0] = 0x21;
    bytes[1] = low_byte((part - 1) * 16);
    bytes[2] = low_byte((address + done) / 256), bytes[3] = low_byte(address + done);
    std::copy_n(memory.begin() + static_cast<std::ptrdiff_t>(done), part, bytes.begin() + 4);
    reply(std::move(bytes), at, done + part == size ? After::read_done : After::nothing);
  }
}

void WiimoteEmulator::acknowledge(std::uint8_t id, MemoryError error, Time at, After after) {
  reply({0x22, id, static_cast<std::uint8_t>(error)}, at, after);
}

void WiimoteEmulator::reply(std::vector<std::uint8_t> bytes, Time at, After after) {
  Reply reply{at + options_.command_time, std::move(bytes), after};
  const auto later = std::ranges::upper_bound(replies_, reply.at, {}, &Reply::at);
  replies_.insert(later, std::move(reply));
}

Time WiimoteEmulator::next_event() const {
  if (!alive()) return Time::max();
  Time soonest = next_sample_;
  if (forced_) soonest = std::min(soonest, *forced_);
  if (!replies_.empty()) soonest = std::min(soonest, replies_.front().at);
  return soonest;
}

std::optional<EmulatedReport> WiimoteEmulator::next(Time until) {
  for (Time at = next_event(); at <= until && alive(); at = next_event()) {
    if (!replies_.empty() && replies_.front().at == at) {
      const Reply reply = std::move(replies_.front());
      replies_.pop_front();
      return leave(reply);
    }
    const bool forced = forced_ == at;
    if (forced) forced_.reset();
    if (!forced) next_sample_ += options_.report_period;
    if (reading_) continue;  // answers to a read take the place of data reports
    if (auto report = data_report(at, forced || continuous_)) return report;
  }
  return std::nullopt;
}

EmulatedReport WiimoteEmulator::leave(const Reply& reply) {
  if (reply.after == After::write_done) writing_ = false;
  if (reply.after == After::read_done) reading_ = false;
  if (reply.bytes[0] == 0x20) {  // resets the mode
    mode_ = 0x30;
    continuous_ = false;
    second_half_.reset();
    last_.reset();
  }
  const SensorView view = look_(reply.at);
  const auto buttons = button_bytes(view.buttons_1, view.buttons_2);
  EmulatedReport report{{reply.bytes[0], buttons[0], buttons[1]}, reply.bytes.size() + 2, reply.at};
  std::copy(reply.bytes.begin() + 1, reply.bytes.end(), report.bytes.begin() + 3);
  return report;
}

// Of a pair 0x3e, 0x3f the second shows the same sample as the first.
std::optional<EmulatedReport> WiimoteEmulator::data_report(Time at, bool always) {
  const bool pair = mode_ >= 0x3e;
  if (pair && second_half_) {
    const EmulatedReport report = compose(*second_half_, 0x3f, at);
    second_half_.reset();
    return report;
  }
  const Sample sample = take(at);
  const EmulatedReport report = compose(sample, pair ? std::uint8_t{0x3e} : mode_, at);
  const bool changed = last_ && last_->bytes != report.bytes;
  last_ = report;
  if (!always && !changed) return std::nullopt;
  if (pair) second_half_ = sample;
  return report;
}

WiimoteEmulator::Sample WiimoteEmulator::take(Time at) {
  Sample sample{look_(at), {}, {}};
  sample.acceleration_raw = memory_.acceleration_raw(sample.view.acceleration_g);
  EmulatedCamera& camera = memory_.camera();
  camera.expose(sample.view.spots);
  const Layout& layout = *layout_of(mode_);
  sample.dots.fill(0xff);
  if (layout.dots > 0 && camera.mode() == camera_mode_for(layout))
    camera.read(kDotRegisters, sample.dots);
  return sample;
}

EmulatedReport WiimoteEmulator::compose(const Sample& sample, std::uint8_t id, Time at) const {
  const Layout& layout = *layout_of(id);
  EmulatedReport report{{id}, 1, at};
  const auto add = [&](std::span<const std::uint8_t> bytes) {
    std::ranges::copy(bytes, report.bytes.begin() + static_cast<std::ptrdiff_t>(report.size));
    report.size += bytes.size();
  };
  if (layout.buttons > 0) add(button_bytes(sample.view.buttons_1, sample.view.buttons_2));
  const auto buttons = std::span(report.bytes).subspan<1, 2>();
  if (layout.acceleration == 3) add(accelerate(buttons, sample.acceleration_raw));
  if (layout.acceleration == 1)
    add(std::array{accelerate_half(buttons, sample.acceleration_raw, id == 0x3e)});
  add(std::span(sample.dots).subspan(id == 0x3f ? 18 : 0, layout.dots));
  std::array<std::uint8_t, 21> extension;
  memory_.extension_data(std::span(extension).first(layout.extension));
  add(std::span(extension).first(layout.extension));
  return report;
}

std::array<std::uint8_t, 18> encode_report_0x33(const SensorState& state) {
  std::array<std::uint8_t, 18> bytes{0x33};
  std::ranges::copy(button_bytes(state.buttons_1, state.buttons_2), bytes.begin() + 1);
  std::ranges::copy(accelerate(std::span(bytes).subspan<1, 2>(), state.acceleration_raw),
                    bytes.begin() + 3);
  std::ranges::copy(extended_dot_bytes(state.slots), bytes.begin() + 6);
  return bytes;
}

}  // namespace vindu
