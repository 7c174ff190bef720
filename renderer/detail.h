// How fine a scene must be for an eye before a wall: what an error in the scene measures on the
// screens at most. Computed from the eye, all tiles and one pixel pitch, never from one tile, so
// that neighbours choose the same levels of detail and their pictures meet.
#pragma once

#include <vector>

#include "core/wall.h"
#include "renderer/scene.h"

namespace vindu {

/// A level of detail is fine enough where its error is less than this on any screen.
constexpr double kLargestError_px = 0.5;

/// The plane of one or more tiles, as the eye stands before it.
struct ScreenPlane {
  Vec3 normal_in_world = Vec3::UnitZ();  ///< towards the eye
  double eye_off_m = 0;                  ///< the eye's distance from the plane, above 0
  /// Of the points x that the tiles show, the largest |x - eye|^2 / eye_off_m.
  double steepest_m = 0;
  bool operator==(const ScreenPlane&) const = default;
};

struct DetailNeed {
  double pixel_m = 0;  ///< the smallest pitch; 0: full detail everywhere
  std::vector<ScreenPlane> planes;
  bool operator==(const DetailNeed&) const = default;
};

/// Tiles that the eye has reached show nothing and need nothing. `scale`: drawn pixels for each of
/// the wall's.
DetailNeed detail_need(const Wall& wall, const Vec3& eye_in_wall, double scale = 1);
/// One screen alone, drawn in so many pixels.
DetailNeed detail_need(const TileCorners& screen, SizePx size, const Vec3& eye_in_world);

/// An upper bound, in metres on a screen, of what a change by `error_m` of a thing within the box
/// can look like; never less for a box around it. Infinite where the eye is in the box.
///
/// A point at distance d from the eye and z from the plane through the eye that is parallel to the
/// screen, D away from it, is projected by a map whose derivative is largest away from the middle:
/// D d / z^2. That is at most D sqrt(z^2 + r^2) / z^2 for the box's least z and its largest
/// distance r from the eye's perpendicular. It is also L^2 / (D d) for the point of the screen at
/// distance L that shows it, so at most steepest_m / d for the box's least d, whatever its z. The
/// lesser counts.
double largest_on_screen_m(const ScreenPlane& plane, const Vec3& eye_in_world, const Box3f& box,
                           double error_m);

bool fine_enough(const DetailNeed& need, const Vec3& eye_in_world, const Box3f& box_in_world,
                 double error_m);

/// The largest error that may be fine enough, for each metre from the eye: the projection above
/// makes things at least D / d as large.
double largest_error_per_m(const DetailNeed& need);

}  // namespace vindu
