// What the viewer sees: the tiles' pictures where they hang, through an ordinary camera at the eye.
#pragma once

#include "renderer/wall_renderer.h"

namespace vindu {

/// As it is saved.
constexpr SizePx kEyePicture{1600, 900};

/// The wall must have been drawn for that eye. Around the wall it is dark.
Image picture_from_eye(WallRenderer& wall, const Vec3& eye_in_wall, SizePx size);

}  // namespace vindu
