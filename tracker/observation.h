// What one camera saw at one time: the bright dots of one report, as the device gave them. Dots
// stay raw; the camera model alone knows how a device's axes run.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "core/clock.h"
#include "core/rigid3.h"

namespace vindu {

/// A bright spot in the raw coordinates of its device.
struct Dot {
  double x_px = 0;
  double y_px = 0;
  int size = 0;  ///< 0..15 as a Wiimote says, no unit; a video camera's blob: its pixels

  bool operator==(const Dot&) const = default;
};

inline Vec2 raw_px_of(const Dot& dot) { return {dot.x_px, dot.y_px}; }

constexpr std::size_t kMaxDots = 16;

/// Up to kMaxDots dots, held in place: the frame loop allocates nothing.
class DotList {
 public:
  using value_type = Dot;
  using iterator = Dot*;
  using const_iterator = const Dot*;

  void push_back(const Dot& dot) {
    assert(count_ < kMaxDots);
    dots_[count_++] = dot;
  }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  Dot& operator[](std::size_t index) {
    assert(index < count_);
    return dots_[index];
  }
  const Dot& operator[](std::size_t index) const {
    assert(index < count_);
    return dots_[index];
  }
  Dot* begin() { return dots_.data(); }
  Dot* end() { return dots_.data() + count_; }
  const Dot* begin() const { return dots_.data(); }
  const Dot* end() const { return dots_.data() + count_; }

  bool operator==(const DotList&) const = default;

 private:
  std::array<Dot, kMaxDots> dots_{};  // those from count_ on stay as made
  std::size_t count_ = 0;
};

struct Observation {
  int camera = 0;  ///< index in the site's list of cameras
  Time arrival{};  ///< when the report reached this machine; later than the light by the link's
                   ///< delay
  DotList dots;
  std::uint16_t buttons = 0;  ///< held down, of a Wiimote: as in wiimote/report.h
};

}  // namespace vindu
