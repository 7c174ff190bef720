// What a surface asks of its shader, as a set of bits. Each set that a scene holds is a program of
// its own, linked when it is first seen: a CPU that draws runs both sides of every branch.
#pragma once

#include "renderer/scene.h"

namespace vindu {

using SurfaceKind = unsigned;

/// Bits 0 to 4: has a texture of this role.
constexpr SurfaceKind textured(TextureRole role) { return 1u << static_cast<unsigned>(role); }
constexpr SurfaceKind kSecondUv = 1u << 5;
constexpr SurfaceKind kUnlit = 1u << 6;
constexpr SurfaceKind kMasked = 1u << 7;
constexpr SurfaceKind kShadowed = 1u << 8;  ///< the key light may be hidden
constexpr SurfaceKind kSkinned = 1u << 9;   ///< joints move its vertices

/// What counts where all is unlit, for measuring.
constexpr SurfaceKind kMeasured =
    textured(TextureRole::base_colour) | kSecondUv | kMasked | kSkinned;

/// An unlit one has no other texture than that of its base colour.
SurfaceKind kind_of(const Material& material);

}  // namespace vindu
