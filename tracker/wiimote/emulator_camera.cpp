#include "tracker/wiimote/emulator_camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace vindu {
namespace {

constexpr int kWidth_px = 1024;
constexpr int kHeight_px = 768;
constexpr int kUnitsPerPixel = 8;  // the sensor has 128 x 96 pixels

// Where things lie among the registers.
constexpr std::size_t kLargestBlobAt = 0x06;
constexpr std::size_t kGainAt = 0x08;
constexpr std::size_t kSmallestBlobAt = 0x1b;
constexpr std::size_t kEnableAt = 0x30;
constexpr std::size_t kModeAt = 0x33;
constexpr std::size_t kDotsAt = 0x37;
constexpr std::size_t kDotBytes = 36;
constexpr std::uint8_t kStarted = 0x08;

// The model of the sensitivity; only its directions are documented, its figures are ours. A cluster
// seen from 3 m has diameter 3 with the Wii's levels 3 and 4, as real ones have.
constexpr double kUsualGain = 0x36;  // of level 4; less is more
constexpr double kDiameter = 9;      // at signal 1
constexpr double kFaintest = 1.0 / 64;
constexpr double kFinest = 1.0 / 36;  // below, light falls on one pixel: its place is the pixel's
constexpr double kSaturated = 0.2;    // above, all are equally bright to the logic
constexpr double kSmallestUnit = 1.0 / 3;  // of register 0x1b, in diameters
constexpr double kLeavesSlot_px = 64;      // that a dot moves between two pictures

double diameter_of(double signal) { return kDiameter * std::sqrt(signal); }

int whole(double value, int largest) {
  return static_cast<int>(std::clamp(std::lround(value), 0L, static_cast<long>(largest)));
}

bool on_sensor(const SensorSpot& spot) {
  return spot.x_px > -0.5 && spot.x_px < kWidth_px - 0.5 && spot.y_px > -0.5 &&
         spot.y_px < kHeight_px - 0.5;
}

double placed(double value_px, double signal) {
  if (signal >= kFinest) return value_px;
  return kUnitsPerPixel * std::floor(value_px / kUnitsPerPixel) + 0.5 * kUnitsPerPixel;
}

std::uint8_t byte(int value) {
  assert(value >= 0 && value <= 255);
  return static_cast<std::uint8_t>(value);
}

void check([[maybe_unused]] const SensorDot& dot) {
  assert(dot.x_px >= 0 && dot.x_px < kWidth_px && dot.y_px >= 0 && dot.y_px < kHeight_px);
  assert(dot.size >= 0 && dot.size <= 15);
}

// Two bits each: y, then x.
int high_bits(const SensorDot& dot) { return dot.y_px / 256 * 4 + dot.x_px / 256; }

// x7..x0, y7..y0, then y9 y8 x9 x8 s3 s2 s1 s0.
std::array<std::uint8_t, 3> three_bytes(const SensorDot& dot) {
  check(dot);
  return {byte(dot.x_px % 256), byte(dot.y_px % 256), byte(high_bits(dot) * 16 + dot.size)};
}

// The blob's box in sensor pixels, and its area there as intensity.
std::array<std::uint8_t, 9> nine_bytes(const SensorDot& dot) {
  const auto [x, y, rest] = three_bytes(dot);
  const int column = dot.x_px / kUnitsPerPixel, row = dot.y_px / kUnitsPerPixel;
  const int before = dot.size / 2, after = (dot.size + 1) / 2;
  const int left = std::max(0, column - before), right = std::min(127, column + after);
  const int top = std::max(0, row - before), bottom = std::min(95, row + after);
  const int area = std::min(255, (right - left) * (bottom - top));
  return {x, y, rest, byte(left), byte(top), byte(right), byte(bottom), 0, byte(area)};
}

}  // namespace

void EmulatedCamera::set_power(bool on) {
  if (powered_ == on) return;
  powered_ = on;
  registers_ = {};
  slots_ = {};
}

void EmulatedCamera::start(std::uint8_t mode) {
  set_power(true);
  set_logic(true);
  registers_[kLargestBlobAt] = 0xc8;
  registers_[kGainAt] = 0x36;
  registers_[kSmallestBlobAt] = 0x03;
  registers_[kModeAt] = mode;
  registers_[kEnableAt] = kStarted;
}

bool EmulatedCamera::write(std::uint8_t offset, std::span<const std::uint8_t> bytes) {
  if (!powered_ || offset + bytes.size() > registers_.size()) return false;
  std::ranges::copy(bytes, registers_.begin() + offset);
  return true;
}

bool EmulatedCamera::read(std::uint8_t offset, std::span<std::uint8_t> bytes) const {
  if (!powered_ || offset + bytes.size() > registers_.size()) return false;
  std::copy_n(registers_.begin() + offset, bytes.size(), bytes.begin());
  return true;
}

std::uint8_t EmulatedCamera::mode() const { return reg(kModeAt); }

void EmulatedCamera::expose(std::span<const SensorSpot> spots) {
  const auto dots = registers_.begin() + kDotsAt;
  std::fill_n(dots, kDotBytes, std::uint8_t{0xff});
  if (!powered_ || !logic_ || reg(kEnableAt) != kStarted) return;
  track(spots);
  if (mode() == 1) std::ranges::copy(basic_dot_bytes(slots_), dots);
  if (mode() == 3) std::ranges::copy(extended_dot_bytes(slots_), dots);
  if (mode() == 5) std::ranges::copy(full_dot_bytes(slots_), dots);
}

const SensorSlots& EmulatedCamera::track(std::span<const SensorSpot> spots) {
  const auto blobs = in_slots(blobs_in(spots));
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    slots_[i].reset();
    if (!blobs[i]) continue;
    const auto& [x_px, y_px, signal] = *blobs[i];
    slots_[i] = SensorDot{whole(placed(x_px, signal), kWidth_px - 1),
                          whole(placed(y_px, signal), kHeight_px - 1),
                          std::max(1, whole(diameter_of(signal), 15))};
  }
  return slots_;
}

// The brightest first; those that saturate in the order in which the rows are read.
std::vector<EmulatedCamera::Blob> EmulatedCamera::blobs_in(
    std::span<const SensorSpot> spots) const {
  const double gain = std::sqrt(kUsualGain / std::max<double>(1, reg(kGainAt)));
  std::vector<Blob> blobs;
  for (const SensorSpot& spot : spots) {
    const double signal = gain * spot.brightness;
    const double diameter = diameter_of(signal);
    const bool too_small = diameter < kSmallestUnit * reg(kSmallestBlobAt);
    const bool too_large = std::numbers::pi / 4 * diameter * diameter > reg(kLargestBlobAt);
    if (on_sensor(spot) && signal >= kFaintest && !too_small && !too_large)
      blobs.push_back({spot.x_px, spot.y_px, signal});
  }
  std::ranges::stable_sort(blobs, [](const Blob& a, const Blob& b) {
    const double seen_a = std::min(a.signal, kSaturated), seen_b = std::min(b.signal, kSaturated);
    return seen_a != seen_b ? seen_a > seen_b : seen_a == kSaturated && a.y_px < b.y_px;
  });
  if (blobs.size() > 4) blobs.resize(4);
  return blobs;
}

// Every dot goes on in the slot whose dot of the picture before is nearest; what is new fills up.
std::array<std::optional<EmulatedCamera::Blob>, 4> EmulatedCamera::in_slots(
    std::vector<Blob> blobs) const {
  std::array<std::optional<Blob>, 4> kept;
  while (true) {
    double nearest_px = kLeavesSlot_px;
    std::size_t from = 0, to = 4;
    for (std::size_t slot = 0; slot < 4; ++slot)
      for (std::size_t i = 0; slots_[slot] && !kept[slot] && i < blobs.size(); ++i) {
        const double step_px =
            std::hypot(blobs[i].x_px - slots_[slot]->x_px, blobs[i].y_px - slots_[slot]->y_px);
        if (step_px < nearest_px) nearest_px = step_px, from = i, to = slot;
      }
    if (to == 4) break;
    kept[to] = blobs[from];
    blobs.erase(blobs.begin() + static_cast<std::ptrdiff_t>(from));
  }
  for (const Blob& blob : blobs)
    *std::ranges::find_if(kept, [](const auto& slot) { return !slot; }) = blob;
  return kept;
}

std::array<std::uint8_t, 10> basic_dot_bytes(const SensorSlots& slots) {
  std::array<std::uint8_t, 10> bytes;
  bytes.fill(0xff);
  for (std::size_t slot = 0; slot < 4; ++slot) {
    if (!slots[slot]) continue;
    check(*slots[slot]);
    const bool second = slot % 2 == 1;
    std::uint8_t* pair = &bytes[slot / 2 * 5];
    pair[second ? 3 : 0] = byte(slots[slot]->x_px % 256);
    pair[second ? 4 : 1] = byte(slots[slot]->y_px % 256);
    const int high = high_bits(*slots[slot]);
    pair[2] = second ? byte(pair[2] / 16 * 16 + high) : byte(high * 16 + pair[2] % 16);
  }
  return bytes;
}

std::array<std::uint8_t, 12> extended_dot_bytes(const SensorSlots& slots) {
  std::array<std::uint8_t, 12> bytes;
  bytes.fill(0xff);
  for (std::size_t slot = 0; slot < 4; ++slot)
    if (slots[slot]) std::ranges::copy(three_bytes(*slots[slot]), &bytes[3 * slot]);
  return bytes;
}

std::array<std::uint8_t, 36> full_dot_bytes(const SensorSlots& slots) {
  std::array<std::uint8_t, 36> bytes;
  bytes.fill(0xff);
  for (std::size_t slot = 0; slot < 4; ++slot)
    if (slots[slot]) std::ranges::copy(nine_bytes(*slots[slot]), &bytes[9 * slot]);
  return bytes;
}

}  // namespace vindu
