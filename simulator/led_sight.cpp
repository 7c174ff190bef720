#include "simulator/led_sight.h"

#include <cmath>

namespace vindu {
namespace {

// The emulated camera at the Wii's level 4 (tracker/wiimote/emulator_camera.cpp).
constexpr double kFaintest = 1.0 / 64;
constexpr double kFinest = 1.0 / 36;
constexpr double kUnitsPerPixel = 8;

}  // namespace

DotNoise helmet_dot_noise(const HeadConfig& head, double sigma0_px) {
  const double coarse_px = std::hypot(sigma0_px, kUnitsPerPixel / std::sqrt(12.0));
  return [helmet = Helmet(head), fine_px = rounded_noise_px(sigma0_px), coarse_px](
             std::size_t led, const Vec3& viewer_in_head) -> std::optional<double> {
    const double brightness = helmet.brightness(helmet.clusters()[led], viewer_in_head);
    if (brightness < kFaintest) return std::nullopt;
    return brightness < kFinest ? coarse_px : fine_px;
  };
}

}  // namespace vindu
