// What limits a frame of the whole wall: a generated scan before all 28 tiles, as walls draw it and
// with one thing after another taken away. What is left without its triangles is what its pixels
// cost, and what is left without its pixels is what its triangles cost: no frame can take less than
// the larger of the two. Meant for GPUs; the picture that was timed is kept.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "bench/command.h"
#include "bench/detail/others.h"
#include "bench/detail/scan.h"
#include "bench/quantile.h"
#include "core/error.h"
#include "core/site.h"
#include "renderer/chunks.h"
#include "renderer/gpu_timer.h"
#include "renderer/levels.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"

namespace vindu {
namespace {

struct Options {
  int triangles = 1600000;
  double scale = 0;  // of the tiles' pixels; 0: by who draws
  int frames = 0;    // the same
  std::string out = "out";
  std::string ply;
};

double now_ms() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Medians of frames between which the eye moves, as a viewer's does.
struct Times {
  double frame_ms = 0;   // until the GPU has drawn it
  double submit_ms = 0;  // of it, until all calls are made
  double gpu_ms = 0;     // by the GPU's own clock
  DrawCount count;
};

/// The ball fills what the eye sees of the wall; its nearest point is a metre before it.
FrameState frame_state(int frame) {
  FrameState state{.eye_in_wall = {0.3 + 1e-3 * (frame % 97), 0.1, 1.8}};
  state.navigation.scale = 4;
  state.navigation.wall_from_scene.translation = Vec3(0.3, 0.1, -3);
  return state;
}

Times measure(WallRenderer& renderer, int frames) {
  GpuTimer timer;
  Times times;
  std::vector<double> frame_ms, submit_ms, gpu_ms;
  for (int frame = -3; frame < frames; ++frame) {
    const double start_ms = now_ms();
    timer.begin();
    const WallFrame drawn = renderer.draw(frame_state(frame));
    timer.end();
    const double submitted_ms = now_ms();
    renderer.finish();
    const double finished_ms = now_ms();
    if (frame < 0) continue;
    frame_ms.push_back(finished_ms - start_ms);
    submit_ms.push_back(submitted_ms - start_ms);
    if (const auto newest = timer.newest()) gpu_ms.push_back(1e3 * seconds(*newest));
    times.count = drawn.count;
  }
  times.frame_ms = quantile(frame_ms, 0.5);
  times.submit_ms = quantile(submit_ms, 0.5);
  times.gpu_ms = gpu_ms.empty() ? 0 : quantile(gpu_ms, 0.5);
  return times;
}

Wall wall_of_28() { return read_site(find_asset("walls/tromso.toml")).wall; }

void print(const std::string& what, const Times& times) {
  fmt::print("{:<36}{:>9.2f}{:>8.0f}{:>9.2f}{:>9.2f}{:>8}{:>11}\n", what, times.frame_ms,
             1e3 / times.frame_ms, times.gpu_ms, times.submit_ms,
             times.count.draws - times.count.culled,
             times.count.triangles - times.count.culled_triangles);
  std::fflush(stdout);
}

Times draw(const std::string& what, const PackedScene& scene, const Look& look, double scale,
           const Options& options, const std::string& picture = "") {
  WallRenderer renderer(wall_of_28(), scale, look);
  renderer.show(scene);
  const Times times = measure(renderer, options.frames);
  print(what, times);
  if (!picture.empty()) write_png(renderer.picture().read(), options.out + "/" + picture);
  return times;
}

/// Two triangles before the whole wall, of the scan's material.
PackedScene plate() {
  Scene scene;
  for (const float y : {-2.0f, 2.0f})
    for (const float x : {-2.0f, 2.0f})
      scene.vertices.push_back({.position_in_node = {x, y, 0.7f}});
  scene.indices = {0, 1, 3, 0, 3, 2};
  scene.meshes.push_back(
      {.index_count = 6,
       .bounds_in_node = {Eigen::Vector3f(-2, -2, 0.7f), Eigen::Vector3f(2, 2, 0.7f)}});
  scene.materials.emplace_back();
  scene.nodes.emplace_back().meshes = {0};
  return pack(std::move(scene));
}

void run(Options options) {
  Scene scan = scan_scene({options.triangles});
  if (!options.ply.empty()) return write_ply(scan, options.ply);
  const auto surface = make_headless_surface();
  const bool slow = draws_in_software();
  if (options.scale == 0) options.scale = slow ? 0.125 : 1;
  if (options.frames == 0) options.frames = slow ? 5 : 60;
  std::filesystem::create_directories(options.out);
  cut_into_chunks(scan);
  const PackedScene full = pack(scan);
  make_levels(scan);
  const PackedScene levels = pack(std::move(scan));
  const SizePx size = layout_of(wall_of_28(), options.scale).size;
  fmt::print("28 tiles, {} x {} pixels together; a scan of {} triangles; {}; medians of {}\n",
             size.width, size.height, full.scene.triangle_count(), gl_description(),
             options.frames);
  fmt::print("{:<36}{:>9}{:>8}{:>9}{:>9}{:>8}{:>11}\n", "", "frame ms", "fps", "GPU ms", "calls ms",
             "draws", "triangles");
  const double scale = options.scale;
  const Look lit{};
  const Times wall = draw("as walls draw it", levels, lit, scale, options, "limits.png");
  const Times pixels = draw("two triangles in its place", plate(), lit, scale, options);
  const std::pair<std::string, Look> looks[] = {
      {"without shadows", {Style::lit, 4, Shadows::none}},
      {"crisp shadows, one sample", {Style::lit, 1, Shadows::crisp}},
      {"one sample, without shadows", {Style::lit, 1, Shadows::none}},
      {"base colours alone", {Style::unlit}}};
  for (const auto& [what, look] : looks) {
    draw(what, levels, look, scale, options);
    draw("  two triangles in its place", plate(), look, scale, options);
  }
  draw("in full detail", full, lit, scale, options);
  const Times triangles =
      draw("full detail on 1/256 of the pixels", full, lit, scale / 16, options);
  const auto drawn = [](const Times& times) {
    return static_cast<double>(times.count.triangles - times.count.culled_triangles);
  };
  const double triangles_ms = triangles.frame_ms * drawn(wall) / drawn(triangles);
  const double limit_ms = std::max(pixels.frame_ms, triangles_ms);
  fmt::print(
      "Of a frame as walls draw it its pixels alone take {:.2f}, as many triangles alone "
      "{:.2f}, the calls {:.2f}: it takes {:.2f} times its limit, the {}.\n",
      pixels.frame_ms / wall.frame_ms, triangles_ms / wall.frame_ms, wall.submit_ms / wall.frame_ms,
      wall.frame_ms / limit_ms, pixels.frame_ms > triangles_ms ? "pixels" : "triangles");
}

int main_of(int argc, char** argv) {
  Options options;
  CLI::App app(
      "What limits a frame of 28 tiles that a scan fills: its pixels, its triangles, or the "
      "calls.\n"
      "Example: limits_bench --triangles 1600000");
  app.add_option("--triangles", options.triangles, "Of the scan (default: 1600000)")
      ->check(CLI::Range(100, 60000000));
  app.add_option("--scale", options.scale,
                 "Of the tiles' pixels (default: 1; 0.125 where the CPU draws)")
      ->check(CLI::Range(0.02, 1.0));
  app.add_option("--frames", options.frames, "Of each (default: 60; 5 where the CPU draws)")
      ->check(CLI::Range(1, 10000));
  app.add_option("--out", options.out, "Folder for the picture (default: out)");
  app.add_option("--ply", options.ply, "Writes the scan to this file, and no more")
      ->type_name("FILE");
  return run_command(app, argc, argv, [&] {
    run(options);
    return 0;
  });
}

}  // namespace
}  // namespace vindu

int main(int argc, char** argv) { return vindu::main_of(argc, argv); }
