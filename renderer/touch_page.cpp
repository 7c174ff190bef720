#include "renderer/touch_page.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "renderer/diagram.h"

namespace vindu {
namespace {

constexpr Rgba8 kTouchPaper{14, 16, 20, 255};
constexpr Rgba8 kBorder{44, 48, 56, 255};
constexpr Rgba8 kTask{240, 240, 240, 255};
constexpr Rgba8 kLater{120, 128, 140, 255};
constexpr Rgba8 kTouched{0, 190, 140, 255};
constexpr Rgba8 kRefused{255, 130, 60, 255};

/// Draws in metres about one point of the wall, on one tile's picture.
class Mark {
 public:
  Mark(Diagram& diagram, const TileCorners& tile, const Vec3& x_in_wall, SizePx size)
      : diagram_(diagram), tile_(tile), x_in_wall_(x_in_wall), size_(size) {
    right_ = (tile.lower_right_in_wall - tile.lower_left_in_wall).normalized();
    up_ = tile.normal_in_wall().cross(right_);
  }
  Vec2 at(double right_m, double up_m) const {
    return pixel_of(tile_, x_in_wall_ + right_m * right_ + up_m * up_, size_);
  }
  void line(const Vec2& from_m, const Vec2& to_m, double width_px, Rgba8 colour) {
    diagram_.line(at(from_m.x(), from_m.y()), at(to_m.x(), to_m.y()), width_px, colour);
  }
  /// `share` of each quarter of a ring, all alike: a corner of a tile shows one of them only.
  void ring(double radius_m, double share, double width_px, Rgba8 colour) {
    constexpr int kParts = 24;  // a quarter
    for (int quarter = 0; quarter < 4; ++quarter) {
      const auto on_ring = [&](double part) {
        const double angle_rad = 0.5 * kPi * (quarter + std::min(part / kParts, share));
        return Vec2(radius_m * Vec2(std::cos(angle_rad), std::sin(angle_rad)));
      };
      for (int part = 0; part < share * kParts; ++part)
        line(on_ring(part), on_ring(part + 1.1), width_px, colour);  // overlaps: no gaps between
    }
  }
  void disc(double radius_px, Rgba8 colour) { diagram_.disc(at(0, 0), radius_px, colour); }

 private:
  Diagram& diagram_;
  const TileCorners& tile_;
  Vec3 x_in_wall_, right_, up_;
  SizePx size_;
};

void draw_next(Mark& mark, const TouchPage& page, double unit_px) {
  const double r = page.ring_m;
  mark.ring(r, 1, 0.8 * unit_px, kBorder);
  mark.ring(r, 1, 0.16 * unit_px, kYellow);
  mark.ring(r, std::clamp(page.held, 0.0, 1.0), 0.8 * unit_px, kYellow);
  for (const Vec2& way : {Vec2(r, 0), Vec2(0, r)})
    mark.line(-0.85 * way, 0.85 * way, 0.16 * unit_px, kYellow);
  mark.disc(0.4 * unit_px, kYellow);
}

void draw_other(Mark& mark, double ring_m, double unit_px, Rgba8 colour) {
  const double r = 0.4 * ring_m;
  mark.ring(r, 1, 0.2 * unit_px, colour);
  for (const Vec2& way : {Vec2(r, 0), Vec2(0, r)})
    mark.line(-0.5 * way, 0.5 * way, 0.2 * unit_px, colour);
}

/// In the middle between left and right; smaller where it is too long.
void write_line(Diagram& diagram, SizePx size, double y_px, TextStyle style,
                const std::string& words) {
  const double room_px = 0.92 * size.width;
  const int width_px = text_width_px(words, style);
  if (width_px > room_px) style.height_px *= room_px / width_px;
  diagram.text({0.5 * size.width, y_px}, words, style, Diagram::Align::middle);
}

/// Words beside a point, on the side of it on which there is more of the tile.
void write_beside(Diagram& diagram, const Vec2& point_px, SizePx size, double away_px,
                  const std::string& words, const TextStyle& style) {
  const bool to_right = point_px.x() < 0.5 * size.width, below = point_px.y() < 0.5 * size.height;
  const double x_px = point_px.x() + (to_right ? away_px : -away_px);
  const double y_px = point_px.y() + (below ? away_px : -away_px) - 0.5 * style.height_px;
  diagram.text({x_px, y_px}, words, style, Diagram::Align::middle);
}

/// In the half of the tile, upper or lower, where the point is not.
void write_request(Diagram& diagram, const TouchPage& page, const Vec2& point_px, SizePx size,
                   double unit_px) {
  const double top_px = point_px.y() < 0.5 * size.height ? 0.7 * size.height : 0.06 * size.height;
  write_line(diagram, size, top_px, {2.2 * unit_px, kTask, true}, "Hold the LED to the cross");
  const std::string count =
      "point " + std::to_string(page.done + 1) + " of " + std::to_string(page.points.size());
  write_line(diagram, size, top_px + 2.5 * unit_px, {1.5 * unit_px, kLater}, count);
  if (!page.remark.empty())
    write_line(diagram, size, top_px + 4.4 * unit_px, {1.5 * unit_px, kRefused, true}, page.remark);
}

bool near_plane(const TileCorners& tile, const Vec3& x_in_wall, double within_m) {
  return std::abs(tile.normal_in_wall().dot(x_in_wall - tile.lower_left_in_wall)) < within_m;
}

void draw_point(Diagram& diagram, const TouchPage& page, std::size_t index, const Tile& tile,
                SizePx size, double unit_px) {
  const TouchPage::Point& point = page.points[index];
  if (!near_plane(tile.corners, point.x_in_wall, page.ring_m)) return;
  Mark mark(diagram, tile.corners, point.x_in_wall, size);
  const bool next = index == page.done, touched = index < page.done;
  const bool after_next = index == page.done + 1;
  const Rgba8 colour = next ? kYellow : touched ? kTouched : after_next ? kTask : kLater;
  next ? draw_next(mark, page, unit_px) : draw_other(mark, page.ring_m, unit_px, colour);
  if (point.tile != tile.name) return;
  const Vec2 point_px = mark.at(0, 0);
  const double ring_px = (mark.at(page.ring_m, 0) - point_px).norm();
  write_beside(diagram, point_px, size, next ? 1.05 * ring_px : 0.65 * ring_px,
               touched ? "\u2713" : std::to_string(index + 1),
               {next || touched ? 3 * unit_px : 2 * unit_px, colour, true});
  if (next) write_request(diagram, page, point_px, size, unit_px);
  if (page.done == page.points.size())
    write_line(diagram, size, 0.46 * size.height, {2.2 * unit_px, kTouched, true},
               "All points are touched");
}

}  // namespace

Vec2 pixel_of(const TileCorners& tile, const Vec3& x_in_wall, SizePx size) {
  Eigen::Matrix<double, 3, 2> edges;
  edges.col(0) = tile.lower_right_in_wall - tile.lower_left_in_wall;
  edges.col(1) = tile.lower_left_in_wall - tile.upper_left_in_wall;
  const Eigen::Matrix2d gram = edges.transpose() * edges;
  const Vec2 share = gram.inverse() * (edges.transpose() * (x_in_wall - tile.upper_left_in_wall));
  return {share.x() * size.width, share.y() * size.height};
}

Image draw_touch_page(const TouchPage& page, const Tile& tile, SizePx size) {
  Diagram diagram(size, kTouchPaper);
  const double unit_px = size.height / 32.0;  // of a line of small words
  const Vec2 end_px(size.width, size.height);
  const double edge_px = std::max(1.0, 0.06 * unit_px);
  for (const double y : {0.5 * edge_px, end_px.y() - 0.5 * edge_px})
    diagram.line({0, y}, {end_px.x(), y}, edge_px, kBorder);
  for (const double x : {0.5 * edge_px, end_px.x() - 0.5 * edge_px})
    diagram.line({x, 0}, {x, end_px.y()}, edge_px, kBorder);
  for (std::size_t index = 0; index < page.points.size(); ++index)
    draw_point(diagram, page, index, tile, size, unit_px);
  return diagram.image();
}

}  // namespace vindu
