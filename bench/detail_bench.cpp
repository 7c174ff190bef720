// What a frame of a large scan costs: the generated scan of bench/detail/scan.h with 10 thousand to
// 10 million triangles, with levels of detail and without them, how far the two pictures differ,
// and, where they are asked for, osgviewer and ParaView on the same model from the same place in
// the same run. The pictures that were timed are kept.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "bench/command.h"
#include "bench/detail/others.h"
#include "bench/detail/scan.h"
#include "bench/log_plot.h"
#include "bench/quantile.h"
#include "core/error.h"
#include "renderer/chunks.h"
#include "renderer/diagram.h"
#include "renderer/levels.h"
#include "renderer/scene_renderer.h"
#include "renderer/surface.h"

namespace vindu {
namespace {

struct Options {
  std::vector<int> triangles = {10000, 100000, 1000000};
  std::vector<int> size_px = {1024, 768};
  int frames = 40;
  float noise = ScanOptions{}.noise_of_spacing;
  bool osgviewer = false, pvbatch = false, unlit = false, shadows = false;
  std::string out = "out";
  std::string plot;
};

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The screen through which the model is seen as osgviewer shows it at first.
struct Stage {
  TileCorners screen;
  Vec3 eye;
};

Stage stage_for(const Box3f& bounds, SizePx size) {
  const double distance = osgviewer_distance(0.5 * bounds.diagonal().norm());
  const double half_height = distance * std::tan(0.5 * osgviewer_fov_y_rad());
  const double half_width = half_height * size.width / size.height;
  return {{{-half_width, -half_height, 0},
           {half_width, -half_height, 0},
           {-half_width, half_height, 0}},
          {0, 0, distance}};
}

/// The scan's z is up, and its -y towards the viewer.
Mat4 world_from_scan(const Box3f& bounds) {
  Mat4 world_from_scan = Mat4::Identity();
  world_from_scan.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  Mat4 from_middle = Mat4::Identity();
  from_middle.topRightCorner<3, 1>() = -bounds.center().cast<double>();
  return world_from_scan * from_middle;
}

struct Drawn {
  double frame_s = 0;
  std::uint64_t triangles = 0;
  Image picture;
};

/// The eye moves a little from frame to frame, as a viewer's does: nothing is kept for it.
Drawn draw(const Scene& scene, const Box3f& bounds, const Options& options, bool levels) {
  const SizePx size{options.size_px[0], options.size_px[1]};
  const Look look{options.unlit ? Style::unlit : Style::lit, 1,
                  options.shadows ? Shadows::crisp : Shadows::none};
  const Stage stage = stage_for(bounds, size);
  GpuScene gpu_scene = uploaded(pack(scene), look);
  gpu_scene.pose(world_from_scan(bounds), 0);
  const SceneRenderer renderer(look);
  Canvas canvas(size, look);
  Picture picture(size, look.style);
  const GpuScene* const scenes[] = {&gpu_scene};
  std::unique_ptr<ShadowMap> shadow;
  if (options.shadows) {
    shadow = std::make_unique<ShadowMap>(look);
    shadow->update(scenes, Box3f(Eigen::Vector3f::Constant(-9), Eigen::Vector3f::Constant(9)));
  }
  Drawn drawn;
  std::vector<double> times_s;
  for (int frame = -2; frame < options.frames; ++frame) {
    const Vec3 eye = stage.eye + Vec3(1e-4 * (frame % 7), 0, 0);
    const double start_s = now_s();
    View view = *tile_view(stage.screen, eye);
    if (levels) view.detail = detail_need(stage.screen, size, eye);
    canvas.begin();
    const DrawCount count = renderer.draw(view, scenes, {}, shadow.get());
    canvas.resolve(picture);
    glFinish();
    if (frame >= 0) times_s.push_back(now_s() - start_s);
    drawn.triangles = count.triangles - count.culled_triangles;
  }
  drawn.frame_s = quantile(times_s, 0.5);
  drawn.picture = picture.read();
  return drawn;
}

struct PictureDifference {
  double mean = 0;
  int largest = 0;
};

PictureDifference difference_of(const Image& a, const Image& b) {
  PictureDifference difference;
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t part = 0; part < 3; ++part) {
      const int levels = std::abs(int{a.pixels[i][part]} - int{b.pixels[i][part]});
      sum += levels;
      difference.largest = std::max(difference.largest, levels);
    }
  difference.mean = sum / (3.0 * static_cast<double>(a.pixels.size()));
  return difference;
}

struct Row {
  double triangles = 0;
  Drawn full, levels;
  double levels_s = 0;  // to make them
  std::optional<ViewerTimes> osgviewer, pvbatch;
  double first_picture_s = 0;  // of the program, by the packed model; 0: not measured
};

/// `vindu render` of one screen of that size, from its start to its end: the way of who wants a
/// picture of a model that was packed before. With soft shadows and four samples a pixel, as it
/// draws pictures.
double first_picture_s(const std::string& model, const Options& options) {
  const std::string wall = options.out + "/screen.toml", packed = options.out + "/scan.vscene";
  std::ofstream(wall) << fmt::format(
      "[wall]\ncolumns = 1\nrows = 1\nwidth_m = 2.0\nheight_m = 1.5\ntile_width_px = {}\n"
      "tile_height_px = {}\nhosts = \"screen\"\n",
      options.size_px[0], options.size_px[1]);
  const auto run = [](const std::string& words) {
    if (std::system(("'" VINDU_PROGRAM "' " + words + " > /dev/null 2>&1").c_str()) != 0)
      throw Error({"fails", "vindu " + words, ""});
  };
  run(fmt::format("pack '{}' --out '{}'", model, packed));
  const double start_s = now_s();
  run(fmt::format("render '{}' --wall '{}' --tile tile-0-0 --out '{}'", packed, wall, options.out));
  const double took_s = now_s() - start_s;
  std::filesystem::remove(packed);
  return took_s;
}

void measure_others(const Scene& scene, const Options& options, Row& row) {
  const std::string file = options.out + "/scan.ply";
  write_ply(scene, file);
  const SizePx size{options.size_px[0], options.size_px[1]};
  const int frames = row.triangles > 300000 ? 30 : 300;
  const double half_diagonal = 0.5 * scene.meshes.front().bounds_in_node.diagonal().norm();
  if (options.osgviewer) row.osgviewer = osgviewer_times(file, size, frames);
  if (options.pvbatch)
    row.pvbatch =
        pvbatch_times(file, half_diagonal, size, options.frames,
                      fmt::format("{}/scan_{:.0f}_pvbatch.png", options.out, row.triangles));
  row.first_picture_s = first_picture_s(file, options);
  std::filesystem::remove(file);
}

Row measure(const Options& options, int triangles) {
  Scene scene = scan_scene({triangles, options.noise});
  Row row;
  row.triangles = static_cast<double>(scene.triangle_count());
  const Box3f bounds = scene.meshes.front().bounds_in_node;
  if (options.osgviewer || options.pvbatch) measure_others(scene, options, row);
  cut_into_chunks(scene);
  row.full = draw(scene, bounds, options, false);
  const double start_s = now_s();
  make_levels(scene);
  row.levels_s = now_s() - start_s;
  row.levels = draw(scene, bounds, options, true);
  const std::string name = fmt::format("{}/scan_{}", options.out, triangles);
  write_png(row.full.picture, name + "_full.png");
  write_png(row.levels.picture, name + "_levels.png");
  return row;
}

void print(const Row& row, const Row& first) {
  const auto [mean, largest] = difference_of(row.full.picture, row.levels.picture);
  fmt::print("{:>10.0f}{:>9.1f} |{:>9.1f}{:>10}{:>8.1f}x{:>9.2f}{:>8.2f}{:>6}{:>9.1f}",
             row.triangles, 1e3 * row.full.frame_s, 1e3 * row.levels.frame_s, row.levels.triangles,
             row.full.frame_s / row.levels.frame_s, row.levels.frame_s / first.levels.frame_s, mean,
             largest, row.levels_s);
  for (const auto& other : {row.osgviewer, row.pvbatch})
    if (other)
      fmt::print(" |{:>9.1f}{:>8.1f}x{:>7.1f}x", 1e3 * other->frame_s,
                 other->frame_s / row.levels.frame_s, other->first_picture_s / row.first_picture_s);
  if (row.first_picture_s > 0) fmt::print(" |{:>8.2f}", row.first_picture_s);
  fmt::print("\n");
  std::fflush(stdout);
}

std::string words(const Options& options) {
  double load = 0;
  getloadavg(&load, 1);
  return fmt::format("{} x {} pixels, {}{}, one sample a pixel; {}; {} cores, load {:.1f} before",
                     options.size_px[0], options.size_px[1], options.unlit ? "unlit" : "lit",
                     options.shadows ? " with crisp shadows" : "",
                     reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                     std::thread::hardware_concurrency(), load);
}

void plot(const Options& options, const std::vector<Row>& rows, const std::string& title) {
  Curve levels{"with levels of detail", kBlue, {}}, full{"full detail", kVermilion, {}},
      osgviewer{"osgviewer", kDim, {}}, pvbatch{"pvbatch", kInk, {}};
  for (const Row& row : rows) {
    levels.points.emplace_back(row.triangles, 1e3 * row.levels.frame_s);
    full.points.emplace_back(row.triangles, 1e3 * row.full.frame_s);
    if (row.osgviewer) osgviewer.points.emplace_back(row.triangles, 1e3 * row.osgviewer->frame_s);
    if (row.pvbatch) pvbatch.points.emplace_back(row.triangles, 1e3 * row.pvbatch->frame_s);
  }
  std::vector<Curve> curves = {levels, full};
  for (const Curve& other : {osgviewer, pvbatch})
    if (!other.points.empty()) curves.push_back(other);
  LogAxis axis{"triangles of the model", {1e4, 1e5}};
  while (axis.marks.back() < 0.95 * rows.back().triangles)
    axis.marks.push_back(10 * axis.marks.back());
  write_png(log_plot(curves, axis, title), options.plot);
}

void run(const Options& options) {
  const auto surface = make_headless_surface();
  std::filesystem::create_directories(options.out);
  const std::string title = words(options);
  fmt::print("{}; medians of {} frames\n", title, options.frames);
  fmt::print("{:>10}{:>9} |{:>9}{:>10}{:>9}{:>9}{:>8}{:>6}{:>9}{}\n", "triangles", "full ms",
             "levels ms", "drawn", "faster", "of first", "mean", "max", "made, s",
             options.osgviewer || options.pvbatch
                 ? " | other's ms  faster  first (osgviewer, then pvbatch) | first picture, s"
                 : "");
  std::vector<Row> rows;
  for (const int triangles : options.triangles) {
    rows.push_back(measure(options, triangles));
    print(rows.back(), rows.front());
    for (Image* picture : {&rows.back().full.picture, &rows.back().levels.picture}) *picture = {};
  }
  if (!options.plot.empty()) plot(options, rows, title);
}

int main_of(int argc, char** argv) {
  Options options;
  CLI::App app(
      "A generated scan with and without levels of detail: time of a frame, triangles drawn, "
      "difference of the pictures (levels of 255, mean and largest), time to make the levels.\n"
      "Example: detail_bench --triangles 100000,1600000 --osgviewer --pvbatch");
  app.add_option("--triangles", options.triangles,
                 "Sizes of the scan (default: 10000,100000,1000000)")
      ->delimiter(',')
      ->check(CLI::Range(100, 60000000));
  app.add_option("--size", options.size_px, "Of the picture (default: 1024 768)")
      ->expected(2)
      ->check(CLI::Range(16, 8192));
  app.add_option("--frames", options.frames, "Of each (default: 40)")->check(CLI::Range(1, 10000));
  app.add_option("--noise", options.noise,
                 "Of the scan, of the distance of its points (default: 0.02)")
      ->check(CLI::Range(0.0, 1.0));
  app.add_flag("--unlit", options.unlit, "Vertex colours alone");
  app.add_flag("--shadows", options.shadows, "With crisp shadows");
  app.add_flag("--osgviewer", options.osgviewer, "Debian's osgviewer under Xvfb beside it");
  app.add_flag("--pvbatch", options.pvbatch, "Debian's ParaView beside it: python3-paraview");
  app.add_option("--out", options.out, "Folder for the pictures (default: out)");
  app.add_option("--plot", options.plot, "Writes the times as a picture")->type_name("PNG");
  return run_command(app, argc, argv, [&] {
    run(options);
    return 0;
  });
}

}  // namespace
}  // namespace vindu

int main(int argc, char** argv) { return vindu::main_of(argc, argv); }
