// Rigid transforms between named frames. A transform is called target_from_source and a point
// x_in_frame, so adjacent frame names must match when they are composed: room_from_head *
// head_from_led * x_in_led.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vindu {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;
using Quat = Eigen::Quaterniond;

/// x_in_target = rotation * x_in_source + translation; metres.
struct Rigid3 {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();

  static Rigid3 from(const Mat3& rotation, const Vec3& translation) {
    return {Quat(rotation).normalized(), translation};
  }
};

inline Vec3 operator*(const Rigid3& target_from_source, const Vec3& x_in_source) {
  return target_from_source.rotation * x_in_source + target_from_source.translation;
}

inline Rigid3 operator*(const Rigid3& target_from_middle, const Rigid3& middle_from_source) {
  return {(target_from_middle.rotation * middle_from_source.rotation).normalized(),
          target_from_middle * middle_from_source.translation};
}

inline Rigid3 inverse(const Rigid3& target_from_source) {
  const Quat source_rotation = target_from_source.rotation.conjugate();
  return {source_rotation, -(source_rotation * target_from_source.translation)};
}

/// Homogeneous 4x4 of a rigid transform with a uniform scale applied first.
inline Mat4 matrix_of(const Rigid3& target_from_source, double scale = 1.0) {
  Mat4 matrix = Mat4::Identity();
  matrix.topLeftCorner<3, 3>() = scale * target_from_source.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = target_from_source.translation;
  return matrix;
}

/// Linear in translation, spherical-linear in rotation.
inline Rigid3 interpolate(const Rigid3& from, const Rigid3& to, double fraction) {
  return {from.rotation.slerp(fraction, to.rotation),
          from.translation + fraction * (to.translation - from.translation)};
}

constexpr double kPi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * kPi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / kPi; }

/// Rotation of the thesis' heading, pitch and roll (HTSIM, thesis 3.4): about Z, then the turned X,
/// then the twice turned Y of a frame with z up. Used for cameras that look along their own -z with
/// y up.
inline Mat3 thesis_rotation(double heading_rad, double pitch_rad, double roll_rad) {
  return (Eigen::AngleAxisd(heading_rad, Vec3::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Vec3::UnitX()) * Eigen::AngleAxisd(roll_rad, Vec3::UnitY()))
      .toRotationMatrix();
}

/// The thesis' world has z up and y into the wall; room has y up and z out of the wall. Determinant
/// +1.
inline Mat3 room_from_thesis_world() {
  Mat3 rotation;
  rotation << 1, 0, 0,  //
      0, 0, 1,          //
      0, -1, 0;
  return rotation;
}

}  // namespace vindu
