#include "simulator/room_view.h"

#include <cmath>

#include "renderer/import.h"
#include "renderer/resources.h"

namespace vindu {
namespace {

GpuScene load(const char* asset) {
  return uploaded(pack(import_scene(find_asset(asset)).scene), Look{});
}

}  // namespace

RoomView::RoomView(const Site& site, SizePx size, const Look& look)
    : site_(site),
      canvas_(size, look),
      picture_(size, Style::lit),
      lab_(load("lab/lab.glb")),
      head_(load("lab/head.glb")),
      body_(load("lab/body.glb")) {
  for (const CameraConfig& camera : site.cameras) {
    cameras_.push_back(std::make_unique<GpuScene>(load("lab/wiimote.glb")));
    cameras_.back()->pose(matrix_of(camera.room_from_camera), 0);
  }
}

std::vector<const GpuScene*> RoomView::pose_all(const Rigid3& room_from_head) {
  head_.pose(matrix_of(room_from_head), 0);
  body_.pose(matrix_of(room_from_body(room_from_head)), 0);
  std::vector<const GpuScene*> scenes = {&lab_, &head_, &body_};
  for (const auto& camera : cameras_) scenes.push_back(camera.get());
  return scenes;
}

void RoomView::draw(WallRenderer& wall, const Rigid3& room_from_head) {
  wall.picture().make_mipmaps();
  const double aspect = static_cast<double>(canvas_.size().width) / canvas_.size().height;
  const View view = camera_view(onlooker(site_, aspect));
  const std::vector<Panel> panels = wall.panels(site_.wall.room_from_wall);
  canvas_.begin();
  wall.renderer().draw(view, pose_all(room_from_head), panels);
  canvas_.resolve(picture_);
}

Camera onlooker(const Site& site, double aspect) {
  const double width_m = site.wall.grid.width_m;
  return {.eye_in_world = {0.62 * width_m, 2.5, 1.33 * width_m},
          .target_in_world = {0.0, 1.28, 0.16 * width_m},
          .fov_y_rad = radians(41),
          .aspect = aspect};
}

Rigid3 room_from_body(const Rigid3& room_from_head) {
  const Vec3 forward = room_from_head.rotation * -Vec3::UnitZ();
  const double heading_rad = std::atan2(-forward.x(), -forward.z());
  const Vec3 place = room_from_head.translation;
  return {Quat(Eigen::AngleAxisd(heading_rad, Vec3::UnitY())), {place.x(), 0, place.z()}};
}

}  // namespace vindu
