#include "core/internal/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vindu::internal {

void expect_a_helmet(TomlTable& table, const std::vector<Vec3>& leds_in_head) {
  constexpr double kNearest_m = 0.005, kFarthest_m = 2;
  double nearest_m = kFarthest_m, farthest_m = 0;
  for (std::size_t a = 0; a < leds_in_head.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double apart_m = (leds_in_head[a] - leds_in_head[b]).norm();
      nearest_m = std::min(nearest_m, apart_m);
      farthest_m = std::max(farthest_m, apart_m);
    }
  if (nearest_m < kNearest_m)
    table.fail("leds_m", fmt::format("has two LEDs {:.1f} mm apart; at least {:g} mm is allowed; "
                                     "measure them again, in metres",
                                     1e3 * nearest_m, 1e3 * kNearest_m));
  if (farthest_m > kFarthest_m)
    table.fail("leds_m", fmt::format("has two LEDs {:.2f} m apart; at most {:g} m is allowed on "
                                     "one head; measure them again, in metres",
                                     farthest_m, kFarthest_m));
}

void expect_a_view(TomlTable& table, const CameraConfig& camera) {
  constexpr double kWidest_deg = 150, kWiimoteWidth_px = 1024;
  const double width_px =
      camera.source == CameraSource::video ? camera.video.width_px : kWiimoteWidth_px;
  const double half_px = 0.5 * width_px, focal_px = camera.intrinsics.fx_px;
  const double view_deg = 2 * degrees(std::atan(half_px / focal_px));
  if (view_deg <= kWidest_deg || !table.has("focal_px")) return;
  table.fail("focal_px",
             fmt::format("is {:g}: a picture of {:g} pixels across would show {:.0f} degrees; at "
                         "least {:.0f} px, for {:g} degrees, is allowed; it is in pixels, not mm",
                         focal_px, width_px, view_deg,
                         std::ceil(half_px / std::tan(0.5 * radians(kWidest_deg))), kWidest_deg));
}

}  // namespace vindu::internal
