// Computed normals: sharp where faces meet at a sharp edge, smooth elsewhere, always of unit
// length.
#include "renderer/import_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vindu {
namespace {

using Eigen::Vector3f;

/// Two unit squares that share an edge on the z axis, folded by `fold_deg`; 0 is flat, facing +y.
std::vector<Vector3f> folded_squares(float fold_deg) {
  const float fold_rad = fold_deg * std::numbers::pi_v<float> / 180;
  const Vector3f out(std::cos(fold_rad), -std::sin(fold_rad), 0);
  const Vector3f near(0, 0, 1), far(0, 0, 0);
  const Vector3f left_near(-1, 0, 1), left_far(-1, 0, 0);
  return {left_near, near,       far,       left_near, far,       left_far,
          near,      near + out, far + out, near,      far + out, far};
}

TEST(CornerNormals, OfAFlatFaceAreItsNormal) {
  for (const Vector3f& normal : corner_normals(folded_squares(0)))
    EXPECT_TRUE(normal.isApprox(Vector3f::UnitY(), 1e-6f)) << normal;
}

TEST(CornerNormals, AreSharedOverASoftEdge) {
  const std::vector<Vector3f> corners = folded_squares(40);

  const std::vector<Vector3f> normals = corner_normals(corners);

  const float half_rad = 20 * std::numbers::pi_v<float> / 180;
  const Vector3f mean(std::sin(half_rad), std::cos(half_rad), 0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i].head<2>().isZero()) {
      EXPECT_TRUE(normals[i].isApprox(mean, 1e-5f)) << i << ": " << normals[i].transpose();
    }
}

TEST(CornerNormals, StaySeparateOverASharpEdge) {
  const std::vector<Vector3f> normals = corner_normals(folded_squares(80));

  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(normals[i].isApprox(Vector3f::UnitY(), 1e-6f)) << i;
  EXPECT_GT(normals[6].x(), 0.9f);
}

TEST(CornerNormals, DoNotDependOnHowAFaceIsCut) {
  // The corner of a cube with one face cut into many thin triangles that all meet there.
  std::vector<Vector3f> corners = {{0, 0, 0}, {0, 1, 0},      {-0.5f, 1, -1},
                                   {0, 0, 0}, {-0.5f, 1, -1}, {-0.5f, 0, -1}};
  constexpr int slices = 30;
  for (int i = 0; i < slices; ++i) {
    const float from = static_cast<float>(i) / slices, to = static_cast<float>(i + 1) / slices;
    corners.insert(corners.end(), {{0, 0, 0}, {1, from, 0}, {1, to, 0}});
  }

  const std::vector<Vector3f> normals = corner_normals(corners);

  // Weights are the angles at the corner: 30 slices weigh as much as one triangle of 45 degrees.
  const std::vector<Vector3f> whole = corner_normals(std::vector<Vector3f>{{0, 0, 0},
                                                                           {0, 1, 0},
                                                                           {-0.5f, 1, -1},
                                                                           {0, 0, 0},
                                                                           {-0.5f, 1, -1},
                                                                           {-0.5f, 0, -1},
                                                                           {0, 0, 0},
                                                                           {1, 0, 0},
                                                                           {1, 1, 0}});
  EXPECT_TRUE(normals[6].isApprox(whole[6], 1e-4f))
      << normals[6].transpose() << " and " << whole[6].transpose();
}

TEST(CornerNormals, OfATriangleWithoutAreaAreUnitVectors) {
  const std::vector<Vector3f> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Vector3f> point(3, Vector3f(1, 2, 3));

  for (const auto& corners : {line, point})
    for (const Vector3f& normal : corner_normals(corners))
      EXPECT_TRUE(normal.isApprox(Vector3f::UnitZ())) << normal;
}

TEST(CornerNormals, OfAFanWithVeryManyFacesAreFound) {
  constexpr int faces = 20'000;
  std::vector<Vector3f> corners;
  const auto rim = [](int i) {
    const float angle_rad = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / faces;
    return Vector3f(std::cos(angle_rad), 0, -std::sin(angle_rad));
  };
  for (int i = 0; i < faces; ++i)
    corners.insert(corners.end(), {Vector3f::Zero(), rim(i), rim(i + 1)});

  const std::vector<Vector3f> normals = corner_normals(corners);

  for (const int i : {0, 3, 30'000}) EXPECT_NEAR(normals[i].y(), 1, 1e-4f) << i;
}

}  // namespace
}  // namespace vindu
