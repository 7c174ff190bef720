// What it costs that a wall has many tiles: the show on 1 to 112 of them in one process, beside the
// same pixels as one picture; once for as many pixels whatever the number of tiles, once for tiles
// of one size. The picture of the last wall is kept.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "bench/command.h"
#include "bench/log_plot.h"
#include "bench/quantile.h"
#include "core/error.h"
#include "renderer/chunks.h"
#include "renderer/diagram.h"
#include "renderer/import.h"
#include "renderer/levels.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"

namespace vindu {
namespace {

constexpr double kWidth_m = 5.185, kHeight_m = 2.238;  // of the show's opening
const Rigid3 kRoomFromWall = room_from_wall_at(1.55, 0);

struct Grid {
  int columns = 1;
  int rows = 1;
};

/// Wider than high, as walls are: 7 x 4, 14 x 8.
Grid grid_of(int tiles) {
  Grid grid{tiles, 1};
  while (grid.columns % 2 == 0 && grid.columns > 4 * grid.rows)
    grid = {grid.columns / 2, 2 * grid.rows};
  return grid;
}

struct Options {
  std::vector<int> tiles = {1, 2, 4, 7, 14, 28, 56, 112};
  std::vector<int> wall_px = {1792, 768};
  std::vector<int> tile_px = {128, 96};
  int frames = 20;
  bool unlit = false;
  std::string out = "out";
  std::string plot;
};

Wall wall_of(Grid grid, SizePx tile) {
  WallGrid all;
  all.columns = grid.columns;
  all.rows = grid.rows;
  all.width_m = kWidth_m;
  all.height_m = kHeight_m;
  all.tile_width_px = tile.width;
  all.tile_height_px = tile.height;
  return expand_wall(all, {}, kRoomFromWall);
}

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Measured {
  double tiles_ms = 0, one_ms = 0;
  WallFrame frame;
};

/// In turn, so that other work on the machine meets both alike; medians.
Measured measure(const PackedScene& scene, Grid grid, SizePx tile, const Options& options) {
  const Look look{options.unlit ? Style::unlit : Style::lit, 1, Shadows::none};
  WallRenderer tiles(wall_of(grid, tile), 1, look);
  WallRenderer one(
      single_screen(kWidth_m, kHeight_m, grid.columns * tile.width, grid.rows * tile.height), 1,
      look);
  tiles.show(scene);
  one.show(scene);
  Measured measured;
  std::vector<double> tiles_ms, one_ms;
  for (int frame = -2; frame < options.frames; ++frame) {
    const FrameState state{.eye_in_wall = {0.3 + 1e-3 * frame, 0.1, 1.8}, .animation_time_s = 3};
    const double start_s = now_s();
    measured.frame = tiles.draw(state);
    tiles.finish();
    const double between_s = now_s();
    one.draw(state);
    one.finish();
    if (frame < 0) continue;
    tiles_ms.push_back(1e3 * (between_s - start_s));
    one_ms.push_back(1e3 * (now_s() - between_s));
  }
  measured.tiles_ms = quantile(tiles_ms, 0.5);
  measured.one_ms = quantile(one_ms, 0.5);
  write_png(tiles.picture().read(), options.out + "/tiles.png");
  return measured;
}

PackedScene show() {
  Scene scene = import_scene(find_asset("show/show.glb")).scene;
  cut_into_chunks(scene);
  make_levels(scene);
  return pack(std::move(scene));
}

void print(int tiles, SizePx picture, const Measured& measured) {
  const DrawCount& count = measured.frame.count;
  fmt::print("{:>6}{:>7} x {:<5}{:>9.1f}{:>9.1f}{:>8.2f}{:>9}{:>9.2f}{:>11}\n", tiles,
             picture.width, picture.height, measured.tiles_ms, measured.one_ms,
             measured.tiles_ms / measured.one_ms, count.draws - count.culled,
             static_cast<double>(count.culled) / static_cast<double>(count.draws),
             count.triangles - count.culled_triangles);
  std::fflush(stdout);
}

/// Of walls of more and more tiles, each of the size that `tile_of` says; prints and draws them.
struct Series {
  Curve tiles, one;
};
template <class TileOf>
Series series(const PackedScene& scene, const Options& options, const std::string& name,
              Rgba8 colour, const TileOf& tile_of) {
  Series series{{name, colour, {}}, {"", kDim, {}}};
  for (const int tiles : options.tiles) {
    const Grid grid = grid_of(tiles);
    const SizePx tile = tile_of(grid);
    const Measured measured = measure(scene, grid, tile, options);
    print(tiles, {tile.width * grid.columns, tile.height * grid.rows}, measured);
    series.tiles.points.emplace_back(tiles, measured.tiles_ms);
    series.one.points.emplace_back(tiles, measured.one_ms);
  }
  return series;
}

void run(const Options& options) {
  const auto surface = make_headless_surface();
  std::filesystem::create_directories(options.out);
  const PackedScene scene = show();
  const std::string words =
      fmt::format("the show, {} thousand triangles, {}, one sample a pixel; {}",
                  scene.scene.triangle_count() / 1000, options.unlit ? "unlit" : "lit",
                  reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  fmt::print("{}; medians of {} frames\n{:>6}{:>15}{:>9}{:>9}{:>8}{:>9}{:>9}{:>11}\n", words,
             options.frames, "tiles", "pixels", "ms", "one, ms", "ratio", "draws", "culled",
             "triangles");
  const auto& wall = options.wall_px;
  const auto& tile = options.tile_px;
  Series same = series(scene, options, fmt::format("{} x {} pixels together", wall[0], wall[1]),
                       kBlue, [&](Grid grid) {
                         return SizePx{wall[0] / grid.columns, wall[1] / grid.rows};
                       });
  const Series grows =
      series(scene, options, fmt::format("{} x {} each", tile[0], tile[1]), kVermilion, [&](Grid) {
        return SizePx{tile[0], tile[1]};
      });
  if (options.plot.empty()) return;
  same.one.name = "as one picture";
  const LogAxis axis{"tiles in one process", {1, 2, 4, 7, 14, 28, 56, 112}};
  write_png(log_plot({same.one, grows.one, same.tiles, grows.tiles}, axis, words), options.plot);
}

int main_of(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Frames of a wall of many tiles in one process, beside the same pixels as one picture.\n"
      "Example: tiles_bench --tiles 1,28,112 --plot tiles.png\n"
      "         tiles_bench --tiles 28 --wall-px 7168 3072 --frames 5");
  app.add_option("--tiles", options.tiles, "Numbers of tiles (default: 1,2,4,7,14,28,56,112)")
      ->delimiter(',')
      ->check(CLI::Range(1, 112));
  app.add_option("--wall-px", options.wall_px, "Of all tiles together (default: 1792 768)")
      ->expected(2)
      ->check(CLI::Range(112, 16384));
  app.add_option("--tile-px", options.tile_px, "Of each tile, then (default: 128 96)")
      ->expected(2)
      ->check(CLI::Range(1, 1170));
  app.add_option("--frames", options.frames, "Of each (default: 20)")->check(CLI::Range(1, 10000));
  app.add_flag("--unlit", options.unlit, "Base colours alone");
  app.add_option("--out", options.out, "Folder for the picture (default: out)");
  app.add_option("--plot", options.plot, "Writes the times as a picture")->type_name("PNG");
  return run_command(app, argc, argv, [&] {
    run(options);
    return 0;
  });
}

}  // namespace
}  // namespace vindu

int main(int argc, char** argv) { return vindu::main_of(argc, argv); }
