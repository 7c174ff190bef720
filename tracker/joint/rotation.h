// Rotation vectors: axis times angle, in radians. Small rotations stand on the left, so they are in
// the frame that a rotation leads to: turned = rotation_of(vector) * before. Formulas: Solà, "A
// micro Lie theory for state estimation in robotics", 2018, appendix B.
#pragma once

#include <cmath>

#include "core/rigid3.h"

namespace vindu {

/// The cross product as a matrix: cross_matrix(a) * b = a x b.
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

inline Quat rotation_of(const Vec3& vector_rad) {
  const double angle_rad = vector_rad.norm();
  const double half = 0.5 * angle_rad;
  const double scale = angle_rad > 1e-6 ? std::sin(half) / angle_rad : 0.5;
  const Vec3 imaginary = scale * vector_rad;
  return Quat(std::cos(half), imaginary.x(), imaginary.y(), imaginary.z()).normalized();
}

/// Angle from 0 to pi.
inline Vec3 vector_of(const Quat& rotation) {
  const Eigen::AngleAxisd turn(rotation.w() < 0 ? Quat(-rotation.coeffs()) : rotation);
  return turn.angle() * turn.axis();
}

/// d vector_of(rotation_of(e) * rotation) / d e at e = 0, with `vector_rad` that of the rotation.
inline Mat3 inverse_left_jacobian(const Vec3& vector_rad) {
  const double angle_rad = vector_rad.norm();
  const Mat3 cross = cross_matrix(vector_rad);
  const double square = angle_rad > 1e-3
                            ? 1 / (angle_rad * angle_rad) -
                                  (1 + std::cos(angle_rad)) / (2 * angle_rad * std::sin(angle_rad))
                            : 1.0 / 12;
  return Mat3::Identity() - 0.5 * cross + square * cross * cross;
}

}  // namespace vindu
