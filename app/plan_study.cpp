#include "app/plan_study.h"

#include <algorithm>
#include <cmath>

namespace vindu::app {
namespace {

constexpr double kCell_m = 0.1;
constexpr double kMostCells = 80;  // along a side; larger areas have larger cells
constexpr int kYaws = 9;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

template <class Part>
double quantile(std::span<const PoseBound> bounds, Part part, double share) {
  std::vector<double> values;
  for (const PoseBound& bound : bounds) values.push_back(bound.*part);
  return quantile(std::move(values), share);
}

int cells_along(double length_m, double step_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / step_m - 1e-9)));
}

/// The middle of a cell's side.
double middle(double least, double largest, int cell, int cells) {
  return least + (largest - least) * (cell + 0.5) / cells;
}

void add_headings(const Vec3& eye_in_room, double yaw_deg, int yaws, const HeadConfig& head,
                  std::vector<Rigid3>& poses) {
  for (int i = 0; i < yaws; ++i) {
    const double share = yaws > 1 ? 2.0 * i / (yaws - 1) - 1 : 0;
    poses.push_back(head_at(eye_in_room, radians(yaw_deg * share), head));
  }
}

Cell cell_of(std::span<const PoseBound> bounds, double good_eye_m) {
  std::vector<TrackingLevel> levels;
  for (const PoseBound& bound : bounds) levels.push_back(bound.level);
  const auto half = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::ranges::nth_element(levels, half);
  return {*half, quantile(bounds, &PoseBound::eye_m, 0.5),
          std::ranges::all_of(bounds, [&](const PoseBound& b) { return covered(b, good_eye_m); })};
}

void fill(CellGrid& grid, std::span<const PoseBound> bounds, double good_eye_m) {
  const std::size_t cells = static_cast<std::size_t>(grid.columns) * grid.rows;
  const std::size_t each = bounds.size() / cells;
  for (std::size_t cell = 0; cell < cells; ++cell)
    grid.cells.push_back(cell_of(bounds.subspan(cell * each, each), good_eye_m));
}

double cell_size_m(const Vec2& size_m) { return std::max(kCell_m, size_m.maxCoeff() / kMostCells); }

CellGrid grid_over(const Vec2& least, const Vec2& largest) {
  const Vec2 size_m = largest - least;
  const double step_m = cell_size_m(size_m);
  return {least, largest, cells_along(size_m.x(), step_m), cells_along(size_m.y(), step_m), {}};
}

LevelFigures figures_of(const std::vector<PoseBound>& all, TrackingLevel level) {
  std::vector<PoseBound> bounds;
  std::ranges::copy_if(all, std::back_inserter(bounds),
                       [&](const PoseBound& bound) { return bound.level == level; });
  LevelFigures figures;
  figures.share = static_cast<double>(bounds.size()) / static_cast<double>(all.size());
  if (level > TrackingLevel::position) return figures;
  figures.eye_median_m = quantile(bounds, &PoseBound::eye_m, 0.5);
  figures.eye_p95_m = quantile(bounds, &PoseBound::eye_m, 0.95);
  figures.lateral_median_m = quantile(bounds, &PoseBound::lateral_m, 0.5);
  figures.depth_median_m = quantile(bounds, &PoseBound::depth_m, 0.5);
  figures.rotation_median_rad = quantile(bounds, &PoseBound::rotation_rad, 0.5);
  return figures;
}

CellGrid section_of(const Study& study, const HeadConfig& head, const DotNoise& noise,
                    const WalkingArea& area, double good_eye_m) {
  constexpr double kAbove_m = 0.3, kBelow_m = 0.5;
  const auto [lowest, highest] = std::ranges::minmax(area.eye_heights_m);
  CellGrid grid = grid_over({area.least_in_room.y(), lowest - kBelow_m},
                            {area.largest_in_room.y(), highest + kAbove_m});
  const double x_m = 0.5 * (area.least_in_room.x() + area.largest_in_room.x());
  std::vector<Rigid3> poses;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      add_headings({x_m, middle(grid.least.y(), grid.largest.y(), row, grid.rows),
                    middle(grid.least.x(), grid.largest.x(), column, grid.columns)},
                   area.yaw_deg, kYaws, head, poses);
  fill(grid, survey(study.cameras, head, noise, poses), good_eye_m);
  return grid;
}

}  // namespace

WalkingArea area_before(const Site& site) {
  const double width_m = site.wall.grid.width_m;
  const Vec3 eye = site.wall.room_from_wall * site.viewer.default_eye_in_wall;
  WalkingArea area;
  const double half_m = std::max(0.25, 0.5 * width_m);
  const double near_m = std::max(0.3, 0.15 * width_m);
  area.least_in_room = {eye.x() - half_m, std::min(near_m, eye.z() - 0.2)};
  area.largest_in_room = {eye.x() + half_m, std::max(near_m + 0.6 * width_m, eye.z() + 0.2)};
  area.eye_heights_m = {eye.y() - 0.1, eye.y() + 0.1};
  return area;
}

std::vector<Rigid3> poses_in(const WalkingArea& area, double step_m, int yaws,
                             const HeadConfig& head) {
  const Vec2 size_m = area.largest_in_room - area.least_in_room;
  const int columns = cells_along(size_m.x(), step_m), rows = cells_along(size_m.y(), step_m);
  std::vector<Rigid3> poses;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      for (const double height_m : area.eye_heights_m)
        add_headings(
            {middle(area.least_in_room.x(), area.largest_in_room.x(), column, columns), height_m,
             middle(area.least_in_room.y(), area.largest_in_room.y(), row, rows)},
            area.yaw_deg, yaws, head, poses);
  return poses;
}

Study study(const std::vector<CameraConfig>& cameras, const HeadConfig& head, const DotNoise& noise,
            const WalkingArea& area, double good_eye_m) {
  Study result;
  result.cameras = cameras;
  const std::vector<PoseBound> bounds =
      survey(cameras, head, noise,
             poses_in(area, cell_size_m(area.largest_in_room - area.least_in_room), kYaws, head));
  result.plan = grid_over(area.least_in_room, area.largest_in_room);
  fill(result.plan, bounds, good_eye_m);
  for (int level = 0; level < kLevels; ++level)
    result.levels[level] = figures_of(bounds, static_cast<TrackingLevel>(level));
  const auto good = std::ranges::count_if(
      bounds, [&](const PoseBound& bound) { return covered(bound, good_eye_m); });
  result.covered_share = static_cast<double>(good) / static_cast<double>(bounds.size());
  const auto always = std::ranges::count_if(result.plan.cells, &Cell::always_covered);
  result.always_covered_m2 =
      area.size_m2() * static_cast<double>(always) / static_cast<double>(result.plan.cells.size());
  result.section = section_of(result, head, noise, area, good_eye_m);
  return result;
}

}  // namespace vindu::app
