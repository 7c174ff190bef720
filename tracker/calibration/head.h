// Measures a helmet: where its LEDs sit, and where the eye is among them, from a capture by
// calibrated cameras. The wearer stands still at first and faces the wall, then turns and walks.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tracker/calibration/capture.h"

namespace vindu {

struct HeadOptions {
  int leds = 3;        ///< of the helmet
  double still_s = 2;  ///< at the beginning: facing the wall, upright
  int max_moments = 400;
  /// Where the eye is while the wearer stands still; empty: it stays as it was from the rearmost
  /// LED.
  std::optional<Vec3> eye_in_room;
};

struct HeadResult {
  HeadConfig head;  ///< origin at the rearmost LED, axes as the wall's while still
  double rms_px = 0;
  double led_sigma_mm = 0;  ///< of an LED's place: what its solutions scatter over the moments
  int moments = 0;
};

/// The same helmet with its origin at the rearmost LED, as helmets are measured.
HeadConfig from_rearmost(HeadConfig head);

/// Throws Error for fewer than two cameras, and for fewer than three LEDs, more than eight, or more
/// than two cameras tell of at once.
void expect_measurable(int leds, const HeadConfig& head, std::span<const CameraConfig> cameras);

/// `head` is what is known: its eye, where that is not measured. Throws Error for LEDs that are not
/// seen, for a wearer who moves while he should stand, and for dots that are no rigid body.
HeadResult calibrate_head(const Capture& capture, const std::vector<CameraConfig>& cameras,
                          const Rigid3& room_from_wall, const HeadConfig& head,
                          const HeadOptions& options);

}  // namespace vindu
