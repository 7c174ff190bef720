// vindu check: reads a wall file, prints the expanded wall, and draws it: from the front, and the
// room from above.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/site_json.h"
#include "app/site_remarks.h"
#include "core/error.h"
#include "tracker/camera_model.h"

namespace vindu::app {
namespace {

struct CheckOptions {
  std::string wall_file;
  std::string drawing;
  bool json = false;
};

std::string shown(const Vec3& point) {
  return fmt::format("({:7.3f} {:7.3f} {:7.3f})", point.x(), point.y(), point.z());
}

/// ", calibrated by wand on 2010-06-01 12:00 UTC: rms 0.50 px, place to 5 mm"
std::string shown(const std::optional<CalibrationNote>& note) {
  if (!note) return "";
  std::string text = fmt::format(", calibrated by {} on {}: rms {:.2f} px", note->method,
                                 note->date, note->rms_px);
  if (note->focal_sigma_px > 0)
    text += fmt::format(", focal length to {:.1f} px", note->focal_sigma_px);
  if (note->position_sigma_mm > 0)
    text += fmt::format(", place to {:.1f} mm", note->position_sigma_mm);
  return text;
}

void print_heads(const std::vector<HeadConfig>& heads) {
  for (const HeadConfig& head : heads) {
    const std::size_t leds = head.leds_in_head.size();
    fmt::print("  head {:<12} {} {}, eye at {} in head{}\n", head.name, leds,
               leds == 1 ? "LED" : "LEDs", shown(head.eye_in_head), shown(head.calibration));
  }
}

void print_wall(const Site& site) {
  const Wall& wall = site.wall;
  std::printf("%zu %s, %d x %d, %.3f x %.3f m; corners in wall, metres\n", wall.tiles.size(),
              wall.tiles.size() == 1 ? "tile" : "tiles", wall.grid.columns, wall.grid.rows,
              wall.grid.width_m, wall.grid.height_m);
  for (const Tile& tile : wall.tiles) {
    const TileCorners& corners = tile.corners;
    std::string mount = tile.mount.mirror ? "  mirrored" : "";
    if (!tile.monitor.empty()) mount = "  on " + tile.monitor + mount;
    if (tile.mount.rotate_deg) mount += fmt::format("  turned {} deg", tile.mount.rotate_deg);
    fmt::print("  {:<10} {:<12} {}x{}  lower left {}  lower right {}  upper left {}{}\n", tile.name,
               tile.host, tile.width_px, tile.height_px, shown(corners.lower_left_in_wall),
               shown(corners.lower_right_in_wall), shown(corners.upper_left_in_wall), mount);
  }
  for (const CameraConfig& camera : site.cameras)
    fmt::print("  camera {:<10} {:<9} at {} in room, focal length {:.0f} px{}\n", camera.name,
               name_of(camera.source), shown(camera.room_from_camera.translation),
               camera.intrinsics.fx_px, shown(camera.calibration));
  print_heads(site.heads);
  for (const std::string& remark : remarks_on(site)) fmt::print("  warning: {}\n", remark);
}

/// Drawing units a metre; programs that set small letters badly get large ones.
constexpr double kUnits = 200;

/// An SVG drawing of two plans, in metres; y grows downwards.
class Drawing {
 public:
  void line(const Vec2& from, const Vec2& to, const char* colour, double width_m) {
    include(from);
    include(to);
    body_ += fmt::format(
        "<line x1='{:.4f}' y1='{:.4f}' x2='{:.4f}' y2='{:.4f}' stroke='{}' stroke-width='{}'/>\n",
        kUnits * from.x(), kUnits * from.y(), kUnits * to.x(), kUnits * to.y(), colour,
        kUnits * width_m);
  }
  void area(const std::vector<Vec2>& points, const char* fill, const char* stroke) {
    std::string list;
    for (const Vec2& point : points) {
      include(point);
      list += fmt::format("{:.2f},{:.2f} ", kUnits * point.x(), kUnits * point.y());
    }
    body_ += fmt::format("<polygon points='{}' fill='{}' stroke='{}' stroke-width='2.4'/>\n", list,
                         fill, stroke);
  }
  void text(const Vec2& at, const std::string& words, double height_m,
            const char* anchor = "middle") {
    body_ += fmt::format(
        "<text x='{:.4f}' y='{:.4f}' font-size='{:.3f}' text-anchor='{}' fill='#333'>{}</text>\n",
        kUnits * at.x(), kUnits * at.y(), kUnits * height_m, anchor, words);
  }
  void dot(const Vec2& at, double radius_m, const char* colour) {
    include(at);
    body_ += fmt::format("<circle cx='{:.4f}' cy='{:.4f}' r='{}' fill='{}'/>\n", kUnits * at.x(),
                         kUnits * at.y(), kUnits * radius_m, colour);
  }
  const Vec2& least() const { return least_; }
  const Vec2& largest() const { return largest_; }
  std::string svg() const {
    const Vec2 low = kUnits * (least_ - Vec2(0.4, 0.5));
    const Vec2 size = kUnits * (largest_ - least_ + Vec2(0.8, 0.9));
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='1200' height='{:.0f}' viewBox='{:.3f} "
        "{:.3f} {:.3f} {:.3f}' "
        "font-family='DejaVu Sans, sans-serif'>\n<rect x='{:.3f}' y='{:.3f}' width='{:.3f}' "
        "height='{:.3f}' fill='white'/>\n{}</svg>\n",
        1200 * size.y() / size.x(), low.x(), low.y(), size.x(), size.y(), low.x(), low.y(),
        size.x(), size.y(), body_);
  }

 private:
  void include(const Vec2& point) {
    least_ = least_.cwiseMin(point);
    largest_ = largest_.cwiseMax(point);
  }
  std::string body_;
  Vec2 least_{1e9, 1e9};
  Vec2 largest_{-1e9, -1e9};
};

std::vector<Vec3> outline(const TileCorners& corners) {
  return {corners.lower_left_in_wall, corners.lower_right_in_wall, corners.upper_right_in_wall(),
          corners.upper_left_in_wall};
}

void draw_front(Drawing& drawing, const Wall& wall) {
  for (const Tile& tile : wall.tiles) {
    std::vector<Vec2> points;
    for (const Vec3& corner : outline(tile.corners)) points.emplace_back(corner.x(), -corner.y());
    drawing.area(points, "#dbe9f4", "#2b5d86");
    const Vec3 middle = tile.corners.centre_in_wall();
    drawing.text({middle.x(), -middle.y()}, tile.name, 0.13 * tile.corners.width_m());
  }
  drawing.text({drawing.least().x(), drawing.least().y() - 0.12}, "Front, as the viewer sees it",
               0.14, "start");
}

/// A camera's horizontal field of view, 4.5 m deep.
void draw_camera(Drawing& drawing, const CameraConfig& camera, double down_m) {
  const auto plan = [&](const Vec3& x_in_room) {
    return Vec2(x_in_room.x(), x_in_room.z() + down_m);
  };
  const Intrinsics& lens = camera.intrinsics;
  const Vec3 place = camera.room_from_camera.translation;
  for (const double edge_px : {0.0, picture_size_px(camera).x()}) {
    const Vec3 ray =
        camera.room_from_camera.rotation * Vec3((edge_px - lens.cx_px) / lens.fx_px, 0, 1);
    drawing.line(plan(place), plan(place + 4.5 * ray), "#d08a2e", 0.01);
  }
  drawing.dot(plan(place), 0.05, "#d08a2e");
  drawing.text(plan(place) + Vec2(0, 0.2), camera.name, 0.12);
}

/// The room from above, below the front view: the wall at its upper edge.
void draw_plan(Drawing& drawing, const Site& site) {
  const double down_m = drawing.largest().y() + 0.9;
  const auto plan = [&](const Vec3& x_in_wall) {
    const Vec3 x_in_room = site.wall.room_from_wall * x_in_wall;
    return Vec2(x_in_room.x(), x_in_room.z() + down_m);
  };
  drawing.text({drawing.least().x(), down_m - 0.25},
               "The room from above: wall, default eye, cameras", 0.14, "start");
  for (const Tile& tile : site.wall.tiles) {
    drawing.line(plan(tile.corners.lower_left_in_wall), plan(tile.corners.lower_right_in_wall),
                 "#2b5d86", 0.03);
    drawing.line(plan(tile.corners.upper_left_in_wall), plan(tile.corners.upper_right_in_wall()),
                 "#2b5d86", 0.03);
  }
  drawing.dot(plan(site.viewer.default_eye_in_wall), 0.06, "#b03a2e");
  drawing.text(plan(site.viewer.default_eye_in_wall) + Vec2(0, 0.22), "default eye", 0.12);
  for (const CameraConfig& camera : site.cameras) draw_camera(drawing, camera, down_m);
}

int check(const CheckOptions& options) {
  const Site site = load_site(options.wall_file);
  if (options.json)
    std::fputs(json_of(site, remarks_on(site)).c_str(), stdout);
  else
    print_wall(site);
  if (options.drawing.empty()) return 0;
  Drawing drawing;
  draw_front(drawing, site.wall);
  draw_plan(drawing, site);
  std::ofstream file(options.drawing);
  file << drawing.svg();
  if (!file.flush()) throw Error({"cannot be written", options.drawing, "choose another --draw"});
  if (!options.json) std::printf("%s\n", options.drawing.c_str());
  return 0;
}

}  // namespace

void add_check(CLI::App& parent, Action& chosen) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* app = parent.add_subcommand(
      "check", "Reads a wall file, prints every tile's corners, and draws the wall");
  app->add_option("WALL", options->wall_file, "Wall file (default: the 7x4 Tromsø wall)");
  app->add_option("--draw", options->drawing, "Drawing of the wall and of the room from above")
      ->type_name("FILE.svg");
  app->add_flag("--json", options->json, "The same as JSON, for other programs");
  app->footer("\nExamples:\n  vindu check wall.toml\n  vindu check wall.toml --draw wall.svg\n");
  app->callback([options, &chosen] { chosen = [options] { return check(*options); }; });
}

}  // namespace vindu::app
