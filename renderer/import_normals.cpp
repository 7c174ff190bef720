#include "renderer/import_normals.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "renderer/import_dedupe.h"

namespace vindu {
namespace {

/// Above this a position is the pole of a fan; comparing all its faces with each other would take
/// for ever.
constexpr std::size_t kMaxFacesPerPosition = 256;

struct Corner {
  Eigen::Vector3f face_normal;  ///< zero where the face has no area
  float angle_rad;
};

std::vector<Corner> corners_of(std::span<const Eigen::Vector3f> positions) {
  std::vector<Corner> corners(positions.size());
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    std::array<Eigen::Vector3f, 3> edges;  // edges[k] leads from corner k to the next
    for (int k = 0; k < 3; ++k)
      edges[k] = (positions[i + (k + 1) % 3] - positions[i + k]).stableNormalized();
    const Eigen::Vector3f normal = edges[0].cross(edges[1]).stableNormalized();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f back = -edges[(k + 2) % 3];
      const float angle_rad = std::atan2(edges[k].cross(back).norm(), edges[k].dot(back));
      corners[i + k] = {normal, angle_rad};
    }
  }
  return corners;
}

/// Corners that share a position, position by position: those of position p are
/// corners[starts[p]] to corners[starts[p + 1]].
struct PositionGroups {
  std::vector<std::uint32_t> position_of_corner;
  std::vector<std::uint32_t> starts;
  std::vector<std::uint32_t> corners;

  explicit PositionGroups(std::span<const Eigen::Vector3f> positions)
      : position_of_corner(positions.size()), corners(positions.size()) {
    std::vector<Eigen::Vector3f> distinct;
    Deduplicator<Eigen::Vector3f> table(distinct, positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
      position_of_corner[i] = table.index_of(positions[i]);
    starts.assign(distinct.size() + 1, 0);
    for (const std::uint32_t position : position_of_corner) ++starts[position + 1];
    for (std::size_t p = 1; p < starts.size(); ++p) starts[p] += starts[p - 1];
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (std::uint32_t i = 0; i < positions.size(); ++i) corners[next[position_of_corner[i]]++] = i;
  }

  std::span<const std::uint32_t> around(std::uint32_t corner) const {
    const std::uint32_t p = position_of_corner[corner];
    return {corners.data() + starts[p], starts[p + 1] - starts[p]};
  }
};

Eigen::Vector3f smooth_normal(const Corner& own, std::span<const std::uint32_t> around,
                              const std::vector<Corner>& corners) {
  static const float limit =
      static_cast<float>(std::cos(kSmoothingLimit_deg * EIGEN_PI / 180.0)) - 1e-4f;
  const bool flat = own.face_normal.isZero();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t other : around)
    if (flat || own.face_normal.dot(corners[other].face_normal) >= limit)
      sum += corners[other].angle_rad * corners[other].face_normal;
  sum.stableNormalize();
  if (!sum.isZero()) return sum;
  return flat ? Eigen::Vector3f::UnitZ() : own.face_normal;
}

}  // namespace

std::vector<Eigen::Vector3f> corner_normals(std::span<const Eigen::Vector3f> positions) {
  const std::vector<Corner> corners = corners_of(positions);
  const PositionGroups groups(positions);
  std::vector<Eigen::Vector3f> normals(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    std::span<const std::uint32_t> around = groups.around(i);
    if (around.size() > kMaxFacesPerPosition) around = around.first(kMaxFacesPerPosition);
    normals[i] = smooth_normal(corners[i], around, corners);
  }
  return normals;
}

}  // namespace vindu
