// Values that are allowed each by itself, and together describe no helmet and no view that there
// is: mostly a slip of the pen or of the unit.
#pragma once

#include <vector>

#include "core/internal/toml_table.h"
#include "core/site.h"

namespace vindu::internal {

/// Fails `leds_m` of the table where two LEDs are one or are not on one head.
void expect_a_helmet(TomlTable& table, const std::vector<Vec3>& leds_in_head);

/// Fails `focal_px` of a [[camera]] whose lens would see almost half of all that is about it.
void expect_a_view(TomlTable& table, const CameraConfig& camera);

}  // namespace vindu::internal
