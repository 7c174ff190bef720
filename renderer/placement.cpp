#include "renderer/placement.h"

#include <algorithm>
#include <sstream>

namespace vindu {
namespace {

/// Puts the box's front middle at the wall's origin.
Navigation centred(const Box3f& box, double scale) {
  Navigation navigation;
  const Vec3 middle = box.center().cast<double>();
  const Vec3 front(middle.x(), middle.y(), box.max().z());
  navigation.scale = scale;
  navigation.wall_from_scene.translation = -scale * front;
  return navigation;
}

double fit_scale(const Box3f& box, const Wall& wall) {
  const Vec3 size = box.sizes().cast<double>();
  const double longest = std::max(size.maxCoeff(), 1e-12);
  const double across = std::max(size.x(), 1e-6 * longest),
               along = std::max(size.y(), 1e-6 * longest);
  const double deep = std::max(size.z(), 1e-6 * longest);
  // A depth of twice the wall's width is as much as a window shows well.
  return std::min({0.8 * wall.grid.width_m / across, 0.8 * wall.grid.height_m / along,
                   2 * wall.grid.width_m / deep});
}

std::string shown_size(const Box3f& box, double scale) {
  std::ostringstream text;
  const Vec3 size = scale * box.sizes().cast<double>();
  text.precision(3);
  text << size.x() << " x " << size.y() << " x " << size.z() << " m";
  return text.str();
}

}  // namespace

PlacedScene place_scene(const PackedScene& packed, Placement placement, const Wall& wall) {
  if (placement == Placement::as_is) return {};
  const Box3f& box = packed.bounds_in_scene;
  if (placement == Placement::life_size && packed.scene.metres_per_unit) {
    const double scale = *packed.scene.metres_per_unit;
    return {centred(box, scale), "shown life-size: " + shown_size(box, scale)};
  }
  const double scale = fit_scale(box, wall);
  const std::string fitted = "fitted to the wall: " + shown_size(box, scale);
  if (placement == Placement::life_size)
    return {centred(box, scale), "the file does not state its unit, so the model is " + fitted};
  return {centred(box, scale), fitted};
}

}  // namespace vindu
