// Infrared pictures as a sensor would take them: Gaussian spots on a dark, noisy ground, in 8 bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tracker/ir_camera/blobs.h"

namespace vindu::testing {

struct Spot {
  double x_px = 0;
  double y_px = 0;
  double sigma_px = 1.5;
  double peak = 180;  ///< grey values above the ground; beyond 255 the sensor saturates
};

class IrPicture {
 public:
  IrPicture(int width_px, int height_px, double ground = 10)
      : width_px_(width_px), values_(static_cast<std::size_t>(width_px) * height_px, ground) {}

  double& at(int x, int y) { return values_[static_cast<std::size_t>(y) * width_px_ + x]; }

  IrPicture& add(const Spot& spot) {
    const int reach = static_cast<int>(std::ceil(6 * spot.sigma_px));
    const int cx = static_cast<int>(spot.x_px), cy = static_cast<int>(spot.y_px);
    const int height_px = static_cast<int>(values_.size()) / width_px_;
    for (int y = std::max(0, cy - reach); y <= std::min(height_px - 1, cy + reach); ++y)
      for (int x = std::max(0, cx - reach); x <= std::min(width_px_ - 1, cx + reach); ++x) {
        const double r2 = std::pow(x - spot.x_px, 2) + std::pow(y - spot.y_px, 2);
        at(x, y) += spot.peak * std::exp(-r2 / (2 * spot.sigma_px * spot.sigma_px));
      }
    return *this;
  }

  IrPicture& add_noise(double sigma, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0, sigma);
    for (double& value : values_) value += noise(generator);
    return *this;
  }

  std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> bytes;
    for (const double value : values_)
      bytes.push_back(static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0)));
    return bytes;
  }

  DotList dots(const BlobOptions& options = {}) const {
    const auto pixels = bytes();
    const int height_px = static_cast<int>(pixels.size()) / width_px_;
    return detect_blobs({pixels.data(), width_px_, height_px, width_px_}, options);
  }

 private:
  int width_px_;
  std::vector<double> values_;
};

}  // namespace vindu::testing
