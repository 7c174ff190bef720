#include "app/plan_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "renderer/diagram.h"
#include "tracker/camera_model.h"

namespace vindu::app {
namespace {

constexpr Rgba8 kFloor{244, 245, 247, 255};
constexpr Rgba8 kSight{213, 94, 0, 30};
constexpr Rgba8 kSightEdge{213, 94, 0, 150};
constexpr Rgba8 kNowhere{226, 226, 226, 255};

constexpr int kMargin_px = 36;
constexpr int kGap_px = 48;
constexpr int kHeader_px = 96;
constexpr int kPanel_px = 700;  // width
constexpr int kCaption_px = 30;
constexpr int kLegend_px = 74;
constexpr double kSightLength_m = 6;

// Okabe & Ito's colours (Color Universal Design, 2008), which people of every colour vision tell
// apart; from good to bad also from dark to light.
Rgba8 colour_of(TrackingLevel level) {
  switch (level) {
    case TrackingLevel::six_dof:
      return kBlue;
    case TrackingLevel::hybrid:
      return {86, 180, 233, 255};
    case TrackingLevel::position:
      return {230, 159, 0, 255};
    case TrackingLevel::bearing:
      return {240, 228, 66, 255};
    default:
      return kNowhere;
  }
}

// Steps of cividis (Nunez, Anderton & Renslow 2018), from dark to light.
struct ErrorStep {
  double up_to_mm;
  Rgba8 colour;
  const char* name;
};
constexpr ErrorStep kErrorSteps[] = {
    {2, {0, 34, 78, 255}, "to 2"},    {4, {53, 69, 108, 255}, "4"},
    {6, {102, 105, 112, 255}, "6"},   {10, {149, 143, 120, 255}, "10"},
    {20, {202, 185, 105, 255}, "20"}, {1e9, {254, 232, 56, 255}, "more mm"}};

Rgba8 colour_of_error(double eye_m) {
  if (!std::isfinite(eye_m)) return kNowhere;
  return std::ranges::find_if(kErrorSteps,
                              [&](const ErrorStep& step) { return 1e3 * eye_m <= step.up_to_mm; })
      ->colour;
}

/// Two of a point's coordinates in room, drawn into a rectangle.
class Panel {
 public:
  Panel(Diagram& diagram, const Vec2& corner_px, double scale_px_m, const Vec2& least_m,
        const Vec2& largest_m, bool upwards)
      : diagram_(diagram),
        corner_px_(corner_px),
        scale_px_m_(scale_px_m),
        least_m_(least_m),
        largest_m_(largest_m),
        upwards_(upwards) {}

  Vec2 size_px() const { return scale_px_m_ * (largest_m_ - least_m_); }
  double scale_px_m() const { return scale_px_m_; }
  const Vec2& corner_px() const { return corner_px_; }

  Vec2 at(const Vec2& point_m) const {
    const double y_m = upwards_ ? largest_m_.y() - point_m.y() : point_m.y() - least_m_.y();
    return corner_px_ + scale_px_m_ * Vec2(point_m.x() - least_m_.x(), y_m);
  }

  /// Floor or air, with a line each metre.
  void ground() {
    diagram_.clip(corner_px_, corner_px_ + size_px());
    diagram_.rectangle(corner_px_, corner_px_ + size_px(), kFloor);
    for (double x = std::ceil(least_m_.x()); x <= largest_m_.x(); ++x)
      diagram_.line(at({x, least_m_.y()}), at({x, largest_m_.y()}), 1, kFaint);
    for (double y = std::ceil(least_m_.y()); y <= largest_m_.y(); ++y)
      diagram_.line(at({least_m_.x(), y}), at({largest_m_.x(), y}), 1, kFaint);
  }

  void cells(const CellGrid& grid, const std::function<Rgba8(const Cell&)>& colour) {
    const Vec2 size_m = grid.largest - grid.least;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const auto corner = [&](int x, int y) -> Vec2 {
          const Vec2 point_m =
              grid.least + size_m.cwiseProduct(Vec2(static_cast<double>(x) / grid.columns,
                                                    static_cast<double>(y) / grid.rows));
          return at(point_m).array().round();
        };
        const Vec2 a = corner(column, row), b = corner(column + 1, row + 1);
        const std::size_t index = static_cast<std::size_t>(row) * grid.columns + column;
        diagram_.rectangle(a.cwiseMin(b), a.cwiseMax(b), colour(grid.cells[index]));
      }
  }

  void outline(const CellGrid& grid) {
    const Vec2 corners[] = {grid.least, Vec2(grid.largest.x(), grid.least.y()), grid.largest,
                            Vec2(grid.least.x(), grid.largest.y())};
    for (int i = 0; i < 4; ++i) diagram_.line(at(corners[i]), at(corners[(i + 1) % 4]), 1.5, kInk);
  }

  Diagram& diagram() { return diagram_; }

 private:
  Diagram& diagram_;
  Vec2 corner_px_;
  double scale_px_m_;
  Vec2 least_m_, largest_m_;
  bool upwards_;
};

using Flat = std::function<Vec2(const Vec3&)>;
Vec2 from_above(const Vec3& x_in_room) { return {x_in_room.x(), x_in_room.z()}; }
Vec2 from_aside(const Vec3& x_in_room) { return {x_in_room.z(), x_in_room.y()}; }

/// The middles of two opposite edges of the picture: left and right, or above and below.
std::array<Vec3, 2> sight_edges(const CameraConfig& camera, bool across) {
  const Intrinsics& lens = camera.intrinsics;
  const Vec2 size = picture_size_px(camera);
  std::array<Vec3, 2> ends;
  for (int edge = 0; edge < 2; ++edge) {
    const Vec3 ray = across ? Vec3((edge * size.x() - lens.cx_px) / lens.fx_px, 0, 1)
                            : Vec3(0, (edge * size.y() - lens.cy_px) / lens.fy_px, 1);
    ends[edge] = camera.room_from_camera * (kSightLength_m * ray.normalized());
  }
  return ends;
}

/// Below what is coloured by cells: it would tint them.
void draw_sights(Panel& panel, const Study& study, const Flat& flat, bool above) {
  for (const CameraConfig& camera : study.cameras) {
    const Vec2 place = panel.at(flat(camera.room_from_camera.translation));
    const auto ends = sight_edges(camera, above);
    const Vec2 corners[] = {place, panel.at(flat(ends[0])), panel.at(flat(ends[1]))};
    panel.diagram().polygon(corners, kSight);
  }
}

void draw_cameras(Panel& panel, const Study& study, const Flat& flat, bool above) {
  for (const CameraConfig& camera : study.cameras) {
    const Vec2 place = panel.at(flat(camera.room_from_camera.translation));
    for (const Vec3& end : sight_edges(camera, above))
      panel.diagram().line(place, panel.at(flat(end)), 1.2, kSightEdge);
  }
  for (const CameraConfig& camera : study.cameras)
    panel.diagram().disc(panel.at(flat(camera.room_from_camera.translation)), 6, kVermilion);
}

void draw_wall(Panel& panel, const Wall& wall, const Flat& flat) {
  for (const Tile& tile : wall.tiles) {
    const TileCorners& corners = tile.corners;
    const auto at = [&](const Vec3& x_in_wall) {
      return panel.at(flat(wall.room_from_wall * x_in_wall));
    };
    panel.diagram().line(at(corners.lower_left_in_wall), at(corners.lower_right_in_wall), 6, kInk);
    panel.diagram().line(at(corners.lower_left_in_wall), at(corners.upper_left_in_wall), 6, kInk);
  }
}

void caption(Panel& panel, const std::string& words) {
  panel.diagram().clear_clip();
  panel.diagram().text(panel.corner_px() - Vec2(0, kCaption_px), words, {19, kInk, true});
}

void name_cameras(Panel& panel, const Study& study) {
  panel.diagram().clear_clip();
  for (const CameraConfig& camera : study.cameras)
    panel.diagram().text(panel.at(from_above(camera.room_from_camera.translation)) + Vec2(0, 8),
                         camera.name, {15, kInk}, Diagram::Align::middle);
}

void scale_bar(Panel& panel) {
  const Vec2 at = panel.corner_px() + Vec2(12, panel.size_px().y() - 16);
  panel.diagram().line(at, at + Vec2(panel.scale_px_m(), 0), 3, kInk);
  panel.diagram().text(at + Vec2(panel.scale_px_m() + 8, -11), "1 m", {15, kInk});
}

struct Key {
  Rgba8 colour;
  std::string name;
};

void legend(Diagram& diagram, Vec2 at, const std::vector<Key>& keys) {
  for (const Key& key : keys) {
    diagram.rectangle(at, at + Vec2(22, 18), key.colour);
    diagram.text(at + Vec2(28, -1), key.name, {16, kInk});
    at.x() += 28 + text_width_px(key.name, {16, kInk}) + 22;
  }
}

std::vector<Key> level_keys(const Study& study) {
  std::vector<Key> keys;
  for (const TrackingLevel level :
       {TrackingLevel::six_dof, TrackingLevel::hybrid, TrackingLevel::position,
        TrackingLevel::bearing, TrackingLevel::lost})
    keys.push_back(
        {colour_of(level), fmt::format("{} {:.0f} %", name_of(level),
                                       100 * study.levels[static_cast<int>(level)].share)});
  return keys;
}

std::vector<Key> error_keys() {
  std::vector<Key> keys;
  for (const ErrorStep& step : kErrorSteps) keys.push_back({step.colour, step.name});
  keys.push_back({kNowhere, "not known"});
  return keys;
}

struct Extent {
  Vec3 least = Vec3::Constant(1e9);
  Vec3 largest = Vec3::Constant(-1e9);
  void include(const Vec3& x_in_room) {
    least = least.cwiseMin(x_in_room);
    largest = largest.cwiseMax(x_in_room);
  }
};

/// All that must be seen.
Extent extent_of(const Site& site, const WalkingArea& area, const Study& study) {
  Extent extent;
  for (const Tile& tile : site.wall.tiles) {
    extent.include(site.wall.room_from_wall * tile.corners.lower_left_in_wall);
    extent.include(site.wall.room_from_wall * tile.corners.upper_right_in_wall());
  }
  for (const CameraConfig& camera : study.cameras)
    extent.include(camera.room_from_camera.translation);
  extent.include({area.least_in_room.x(), 0, area.least_in_room.y()});
  extent.include({area.largest_in_room.x(), study.section.largest.y(), area.largest_in_room.y()});
  extent.least -= Vec3(0.4, 0, 0.25);
  extent.largest += Vec3(0.4, 0.25, 0.45);
  return extent;
}

void figures(Diagram& diagram, Vec2 at, const Study& study) {
  diagram.text(at, "Bound of one unfiltered picture of each camera, over all places and headings",
               {16, kDim});
  at.y() += 30;
  const double columns[] = {0, 150, 240, 340, 430, 520, 610};
  const char* heads[] = {"", "share", "eye median", "p95", "lateral", "depth", "rotation"};
  for (int i = 0; i < 7; ++i)
    diagram.text(at + Vec2(columns[i] + (i ? 70 : 0), 0), heads[i], {16, kDim},
                 i ? Diagram::Align::right : Diagram::Align::left);
  for (int level = 0; level <= static_cast<int>(TrackingLevel::position); ++level) {
    at.y() += 28;
    const LevelFigures& row = study.levels[level];
    const std::string cells[] = {std::string(name_of(static_cast<TrackingLevel>(level))),
                                 fmt::format("{:.0f} %", 100 * row.share),
                                 fmt::format("{:.1f} mm", 1e3 * row.eye_median_m),
                                 fmt::format("{:.1f} mm", 1e3 * row.eye_p95_m),
                                 fmt::format("{:.1f} mm", 1e3 * row.lateral_median_m),
                                 fmt::format("{:.1f} mm", 1e3 * row.depth_median_m),
                                 fmt::format("{:.1f}°", degrees(row.rotation_median_rad))};
    for (int i = 0; i < (row.share > 0 ? 7 : 2); ++i)
      diagram.text(at + Vec2(columns[i] + (i ? 70 : 0), 0), cells[i], {17, kInk, i == 0},
                   i ? Diagram::Align::right : Diagram::Align::left);
  }
}

}  // namespace

Image plan_picture(const Site& site, const WalkingArea& area, const Study& study,
                   const PlanText& text) {
  const Extent extent = extent_of(site, area, study);
  const Vec3 size_m = extent.largest - extent.least;
  const double scale = kPanel_px / size_m.x();
  const double aside_scale = std::min(scale, kPanel_px / size_m.z());
  const int plan_px = static_cast<int>(scale * size_m.z());
  const int aside_px = static_cast<int>(aside_scale * size_m.y());
  const int second_px = kHeader_px + kCaption_px + plan_px + kLegend_px + kCaption_px;
  Diagram diagram(
      {2 * kMargin_px + 2 * kPanel_px + kGap_px, second_px + std::max(aside_px, 160) + kMargin_px},
      kPaper);
  diagram.text({kMargin_px, 20}, text.title, {32, kInk, true});
  diagram.text({kMargin_px, 60}, text.subtitle, {18, kDim});
  const Vec2 least = from_above(extent.least), largest = from_above(extent.largest);
  const auto draw = [&](Panel panel, const CellGrid& grid, bool above, const auto& colour) {
    const Flat flat = above ? from_above : from_aside;
    panel.ground();
    draw_sights(panel, study, flat, above);
    panel.cells(grid, colour);
    draw_wall(panel, site.wall, flat);
    panel.outline(grid);
    draw_cameras(panel, study, flat, above);
    return panel;
  };
  const auto level = [](const Cell& cell) { return colour_of(cell.level); };
  const auto error = [](const Cell& cell) { return colour_of_error(cell.eye_m); };
  const double top = kHeader_px + kCaption_px, right = kMargin_px + kPanel_px + kGap_px;
  Panel plan =
      draw({diagram, {kMargin_px, top}, scale, least, largest, false}, study.plan, true, level);
  caption(plan, "From above: what is known of most headings");
  name_cameras(plan, study);
  scale_bar(plan);
  legend(diagram, {kMargin_px, top + plan_px + 14}, level_keys(study));
  Panel errors =
      draw({diagram, {right, top}, scale, least, largest, false}, study.plan, true, error);
  caption(errors, "From above: error of the eye (bound), median of the headings");
  name_cameras(errors, study);
  legend(diagram, {right, top + plan_px + 14}, error_keys());
  Panel section = draw({diagram,
                        {kMargin_px, static_cast<double>(second_px)},
                        aside_scale,
                        from_aside(extent.least),
                        from_aside(extent.largest),
                        true},
                       study.section, false, level);
  caption(section, "From the side, through the middle: the wall on the left");
  figures(diagram, {right, second_px - kCaption_px + 6.0}, study);
  return diagram.image();
}

}  // namespace vindu::app
