#include "tracker/calibration/lens.h"

namespace vindu {

Lens lens_of(const Intrinsics& intrinsics) {
  const auto& [k1, k2, p1, p2, k3] = intrinsics.distortion;
  Lens lens;
  lens << intrinsics.fx_px, intrinsics.fy_px / intrinsics.fx_px, intrinsics.cx_px, intrinsics.cy_px,
      k1, k2, p1, p2, k3;
  return lens;
}

Intrinsics intrinsics_of(const Lens& lens) {
  return {
      lens[0], lens[0] * lens[1], lens[2], lens[3], {lens[4], lens[5], lens[6], lens[7], lens[8]}};
}

LensPrior lens_prior(const CameraConfig& camera) {
  LensPrior prior;
  if (camera.source != CameraSource::video) {
    prior.mean = lens_of(Intrinsics{});
    prior.sigma << 50, 0.01, 20, 20, 0.1, 0, 0, 0, 0;
    return prior;
  }
  prior.mean = lens_of(camera.intrinsics);
  const double f_px = camera.intrinsics.fx_px;
  prior.sigma << 0.1 * f_px, 0.02, 0.03 * f_px, 0.03 * f_px, 0.3, 0.3, 0.01, 0.01, 0.3;
  return prior;
}

}  // namespace vindu
