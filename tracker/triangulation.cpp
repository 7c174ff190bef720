#include "tracker/triangulation.h"

namespace vindu {

// With w = a0 - b0 and unit directions d, e, the points a0 + s d and b0 + t e are nearest where the
// segment between them is perpendicular to both: s = (c q - p) / (1 - c^2), t = (q - c p) / (1 -
// c^2), with c = d.e, p = d.w, q = e.w (Eberly, "Distance between lines", GeometricTools). 1 - c^2
// is taken as |d x e|^2, which keeps its digits for rays that are nearly parallel.
std::optional<TriangulatedPoint> triangulate(const Ray& a, const Ray& b) {
  constexpr double kParallel_rad = 1e-6;
  const Vec3& d = a.direction_in_room;
  const Vec3& e = b.direction_in_room;
  const double sine2 = d.cross(e).squaredNorm();
  if (!(sine2 > kParallel_rad * kParallel_rad)) return std::nullopt;
  const Vec3 w = a.origin_in_room - b.origin_in_room;
  const double c = d.dot(e), p = d.dot(w), q = e.dot(w);
  const double s_m = (c * q - p) / sine2, t_m = (q - c * p) / sine2;
  if (s_m <= 0 || t_m <= 0) return std::nullopt;
  const Vec3 on_a = a.origin_in_room + s_m * d, on_b = b.origin_in_room + t_m * e;
  return TriangulatedPoint{0.5 * (on_a + on_b), (on_a - on_b).norm()};
}

}  // namespace vindu
