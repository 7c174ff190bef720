#include "tracker/calibration/wand_noise.h"

#include <algorithm>
#include <cmath>

namespace vindu {
namespace {

/// One noise for each kind of camera: what a single one's residuals scatter says little, since the
/// wand's poses follow whom they trust most.
void set_sigma(const std::vector<CameraSource>& kinds, CameraSource kind, double sigma_px,
               WandWorld& world) {
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i] == kind) world.cameras[i].sigma_px = std::clamp(sigma_px, 0.05, 20.0);
}

}  // namespace

std::vector<CameraSource> kinds_of(const std::vector<CameraConfig>& cameras) {
  std::vector<CameraSource> kinds;
  for (const CameraConfig& camera : cameras)
    kinds.push_back(camera.source == CameraSource::video ? camera.source : CameraSource::emulated);
  return kinds;
}

std::vector<Scatter> scatter_of(const std::vector<WandMoment>& moments, const WandWorld& world,
                                bool held_out) {
  std::vector<Scatter> scatter(world.cameras.size());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (!moments[i].used || moments[i].held_out != held_out) continue;
    for (const WandView& view : moments[i].views)
      for (std::size_t led = 0; led < view.used.size(); ++led) {
        if (!view.used[led]) continue;
        const Vec2 off_px = residual_px(world, world.poses[i], moments[i], view, led);
        const auto index = static_cast<std::size_t>(view.camera);
        const double usual = world.cameras[index].sigma_px;
        const double grown = sigma_px(world.cameras[index], view, led) / usual;
        scatter[index].sum2 += off_px.squaredNorm() / (grown * grown);
        scatter[index].coordinates += 2;
      }
  }
  return scatter;
}

void learn_sigma(const std::vector<WandMoment>& moments, const std::vector<CameraSource>& kinds,
                 WandWorld& world) {
  const auto scatter = scatter_of(moments, world, false);
  int coordinates = 0, poses = 0;
  for (const Scatter& of_camera : scatter) coordinates += of_camera.coordinates;
  for (const WandMoment& moment : moments) poses += moment.used && !moment.held_out ? 1 : 0;
  const double left = std::max(0.1, 1 - 5.0 * poses / std::max(1, coordinates));
  for (const CameraSource kind : {CameraSource::emulated, CameraSource::video}) {
    Scatter of_kind;
    for (std::size_t i = 0; i < scatter.size(); ++i)
      if (kinds[i] == kind) {
        of_kind.sum2 += scatter[i].sum2;
        of_kind.coordinates += scatter[i].coordinates;
      }
    if (of_kind.coordinates > 0) set_sigma(kinds, kind, of_kind.rms() / std::sqrt(left), world);
  }
}

void guess_sigma(const std::vector<WandMoment>& moments, const std::vector<CameraSource>& kinds,
                 WandWorld& world) {
  for (const CameraSource kind : {CameraSource::emulated, CameraSource::video}) {
    std::vector<double> off_px;
    for (std::size_t i = 0; i < moments.size(); ++i)
      for (const WandView& view : moments[i].views)
        for (std::size_t led = 0; moments[i].used && led < view.used.size(); ++led)
          if (kinds[static_cast<std::size_t>(view.camera)] == kind)
            off_px.push_back(residual_px(world, world.poses[i], moments[i], view, led).norm());
    if (off_px.empty()) continue;
    const auto middle = off_px.begin() + static_cast<std::ptrdiff_t>(off_px.size() / 2);
    std::ranges::nth_element(off_px, middle);
    // of a 2-D Gauss the median length is 1.18 sigma; a third of the freedom is the wand's
    set_sigma(kinds, kind, std::max(0.2, *middle / 1.18 / 0.8), world);
  }
}

void drop_outliers(std::vector<WandMoment>& moments, const WandWorld& world) {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (world.poses[i].tail<3>().isZero()) continue;
    int whole = 0;
    for (WandView& view : moments[i].views) {
      const AdjustedCamera& camera = world.cameras[static_cast<std::size_t>(view.camera)];
      for (std::size_t led = 0; led < view.used.size(); ++led)
        view.used[led] = residual_px(world, world.poses[i], moments[i], view, led).norm() <
                         kGate * sigma_px(camera, view, led);
      if (view.used.front() && view.used.back()) ++whole;
    }
    moments[i].used = whole >= 2;
  }
}

double outliers_of(const std::vector<WandMoment>& moments, const WandWorld& world) {
  std::size_t out = 0, all = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const bool placed = !world.poses[i].tail<3>().isZero();
    if (!placed) out += world.leds_m.size();
    for (const WandView& view : moments[i].views) {
      all += view.used.size();
      if (placed) out += static_cast<std::size_t>(std::ranges::count(view.used, false));
    }
  }
  return static_cast<double>(out) / static_cast<double>(std::max<std::size_t>(1, all));
}

}  // namespace vindu
