#include "app/site_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/common.h"

namespace vindu::app {
namespace {

template <class Items>
std::string array_of(const Items& items, std::string (*text)(const typename Items::value_type&)) {
  std::vector<std::string> texts;
  for (const auto& item : items) texts.push_back(text(item));
  return fmt::format("[{}]", fmt::join(texts, ",\n  "));
}

std::string tile_json(const Tile& tile) {
  return fmt::format(
      R"({{"name": {}, "host": {}, "monitor": {}, "width_px": {}, "height_px": {}, )"
      R"("lower_left_in_wall_m": {}, "lower_right_in_wall_m": {}, "upper_left_in_wall_m": {}, )"
      R"("mirror": {}, "rotate_deg": {}}})",
      json_text(tile.name), json_text(tile.host), json_text(tile.monitor), tile.width_px,
      tile.height_px, json_vec(tile.corners.lower_left_in_wall),
      json_vec(tile.corners.lower_right_in_wall), json_vec(tile.corners.upper_left_in_wall),
      tile.mount.mirror, tile.mount.rotate_deg);
}

std::string camera_json(const CameraConfig& camera) {
  const Quat& turn = camera.room_from_camera.rotation;
  return fmt::format(
      R"({{"name": {}, "source": "{}", "position_in_room_m": {}, "quaternion_xyzw": )"
      R"([{},{},{},{}], "focal_px": {}, "calibrated": {}}})",
      json_text(camera.name), name_of(camera.source), json_vec(camera.room_from_camera.translation),
      turn.x(), turn.y(), turn.z(), turn.w(), camera.intrinsics.fx_px,
      camera.calibration.has_value());
}

std::string head_json(const HeadConfig& head) {
  return fmt::format(
      R"({{"name": {}, "leds_in_head_m": {}, "eye_in_head_m": {}, "calibrated": {}}})",
      json_text(head.name), array_of(head.leds_in_head, json_vec), json_vec(head.eye_in_head),
      head.calibration.has_value());
}

}  // namespace

std::string json_of(const Site& site, const std::vector<std::string>& warnings) {
  const WallGrid& grid = site.wall.grid;
  return fmt::format(
      R"({{"columns": {}, "rows": {}, "width_m": {}, "height_m": {}, "rate_hz": {}, )"
      R"("centre_height_m": {}, "default_eye_in_wall_m": {},)"
      "\n\"tiles\": {},\n\"cameras\": {},\n\"heads\": {},\n\"warnings\": {}}}\n",
      grid.columns, grid.rows, grid.width_m, grid.height_m, site.rate_hz,
      site.wall.room_from_wall.translation.y(), json_vec(site.viewer.default_eye_in_wall),
      array_of(site.wall.tiles, tile_json), array_of(site.cameras, camera_json),
      array_of(site.heads, head_json), array_of(warnings, json_text));
}

}  // namespace vindu::app
