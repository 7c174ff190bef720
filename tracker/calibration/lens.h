// A lens as a vector of parameters with priors, and its projection for automatic differentiation.
// Private to the calibrations.
#pragma once

#include <Eigen/Core>

#include "core/site.h"

namespace vindu {

/// Focal length across, that up over it, centre, k1, k2, p1, p2, k3.
using Lens = Eigen::Matrix<double, 9, 1>;
Lens lens_of(const Intrinsics& intrinsics);
Intrinsics intrinsics_of(const Lens& lens);

/// What is known of a lens before; a sigma of zero: held.
struct LensPrior {
  Lens mean = Lens::Zero();
  Lens sigma = Lens::Zero();
};
/// A Wiimote's (emulated, too): the published ones, of which f, aspect, centre and k1 are free. A
/// video camera's: the wall file's, all free.
LensPrior lens_prior(const CameraConfig& camera);

/// OpenCV's model ("Camera Calibration and 3D Reconstruction"), image pixels. False for what is not
/// before the camera.
template <class T>
bool project(const T* lens, const Eigen::Matrix<T, 3, 1>& x_in_camera,
             Eigen::Matrix<T, 2, 1>& image_px) {
  if (x_in_camera.z() < T(0.02)) return false;
  const T u = x_in_camera.x() / x_in_camera.z(), v = x_in_camera.y() / x_in_camera.z();
  const T r2 = u * u + v * v;
  const T *c = lens + 2, *k = lens + 4;
  const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const T bent_u = u * radial + T(2) * k[2] * u * v + k[3] * (r2 + T(2) * u * u);
  const T bent_v = v * radial + k[2] * (r2 + T(2) * v * v) + T(2) * k[3] * u * v;
  image_px.x() = lens[0] * bent_u + c[0];
  image_px.y() = lens[0] * lens[1] * bent_v + c[1];
  return true;
}

}  // namespace vindu
