// What a frame of the whole wall costs in one process: 28 tiles against the same pixels as one
// picture, lit and unlit, of the show; what one pixel of a lit surface costs; and what many parts
// do. The counters are the ratio and what was culled; the pictures that were timed are kept beside
// the program.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "core/site.h"
#include "renderer/chunks.h"
#include "renderer/culling.h"
#include "renderer/import.h"
#include "renderer/resources.h"
#include "renderer/still_parts.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"

namespace vindu {
namespace {

constexpr double kScale = 0.25;
const FrameState kFrame{.eye_in_wall = {0.3, 0.1, 1.8}, .animation_time_s = 3};

/// One context for all benches of this program.
void need_context() { static const std::unique_ptr<Surface> surface = make_headless_surface(); }

const Scene& show() {
  static const Scene scene = [] {
    Scene imported = import_scene(find_asset("show/show.glb")).scene;
    cut_into_chunks(imported);
    return imported;
  }();
  return scene;
}

Wall wall_of_28() { return read_site(find_asset("walls/tromso.toml")).wall; }

Wall same_as_one() {
  const WallGrid grid = wall_of_28().grid;
  return single_screen(grid.width_m, grid.height_m, grid.columns * grid.tile_width_px,
                       grid.rows * grid.tile_height_px);
}

double frame_s(WallRenderer& renderer) {
  const auto start = std::chrono::steady_clock::now();
  renderer.draw(kFrame);
  renderer.finish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double best_frame_s(WallRenderer& renderer) {
  double best_s = 1e9;
  for (int round = 0; round < 10; ++round) best_s = std::min(best_s, frame_s(renderer));
  return best_s;
}

void wall_of_28_tiles(benchmark::State& state, Look look, const char* picture) {
  need_context();
  WallRenderer tiles(wall_of_28(), kScale, look), one(same_as_one(), kScale, look);
  tiles.show(pack(show()));
  one.show(pack(show()));
  WallFrame frame;
  for (auto _ : state) {
    frame = tiles.draw(kFrame);
    tiles.finish();
  }
  state.counters["ratio_to_one_picture"] = best_frame_s(tiles) / best_frame_s(one);
  state.counters["culled_share"] = static_cast<double>(frame.count.culled) / frame.count.draws;
  state.counters["triangles"] = static_cast<double>(show().triangle_count());
  std::filesystem::create_directories("out");
  write_png(tiles.picture().read(), picture);
}
BENCHMARK_CAPTURE(wall_of_28_tiles, lit_1_sample, Look{Style::lit, 1, Shadows::none},
                  "out/wall_lit_1.png")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(wall_of_28_tiles, lit_1_sample_crisp_shadows, Look{Style::lit, 1, Shadows::crisp},
                  "out/wall_lit_1_crisp.png")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(wall_of_28_tiles, lit_4_samples, Look{Style::lit, 4}, "out/wall_lit_4.png")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(wall_of_28_tiles, unlit, Look{Style::unlit}, "out/wall_unlit.png")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void one_picture_of_the_same_pixels(benchmark::State& state) {
  need_context();
  WallRenderer one(same_as_one(), kScale, Look{Style::lit, 1});
  one.show(pack(show()));
  for (auto _ : state) frame_s(one);
}
BENCHMARK(one_picture_of_the_same_pixels)->Unit(benchmark::kMillisecond);

/// A plate that fills the wall, with a picture in each of these roles.
Scene plate(std::initializer_list<TextureRole> roles) {
  Scene scene;
  for (const float y : {-4.0f, 4.0f})
    for (const float x : {-4.0f, 4.0f})
      scene.vertices.push_back({.position_in_node = {x, y, -1},
                                .uv = {x, -y},
                                .tangent_in_node = Eigen::Vector3f::UnitX()});
  scene.indices = {0, 1, 3, 0, 3, 2};
  scene.meshes.push_back(
      {.index_count = 6,
       .bounds_in_node = {Eigen::Vector3f(-4, -4, -1), Eigen::Vector3f(4, 4, -1)}});
  Material& material = scene.materials.emplace_back();
  for (const TextureRole role : roles) material.texture(role).image = 0;
  if (roles.size()) scene.textures.push_back(Image::filled(256, 256, {128, 128, 255, 255}));
  Node& node = scene.nodes.emplace_back();
  node.meshes = {0};
  return scene;
}

/// The CPU's time is of all threads: what counts where a CPU draws.
void lit_plate(benchmark::State& state, Look look, std::initializer_list<TextureRole> roles) {
  need_context();
  WallRenderer one(same_as_one(), kScale, look);
  one.show(pack(plate(roles)));
  for (auto _ : state) frame_s(one);
  const SizePx size = one.layout().size;
  state.counters["pixels"] = static_cast<double>(size.width) * size.height;
}
BENCHMARK_CAPTURE(lit_plate, plain, Look{Style::lit, 1, Shadows::none}, {})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(lit_plate, crisp_shadows, Look{Style::lit, 1, Shadows::crisp}, {})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(lit_plate, soft_shadows, Look{Style::lit, 1, Shadows::soft}, {})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(lit_plate, base_colour, Look{Style::lit, 1, Shadows::none},
                  {TextureRole::base_colour})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(lit_plate, base_colour_isotropic, (Look{Style::lit, 1, Shadows::none, 1}),
                  {TextureRole::base_colour})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(lit_plate, five_textures, Look{Style::lit, 1, Shadows::none},
                  {TextureRole::base_colour, TextureRole::metallic_roughness, TextureRole::normal,
                   TextureRole::occlusion, TextureRole::emissive})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// A block of 22 x 22 x 22 small boxes, each at a node of its own, of 20 materials: as buildings
/// come from the programs of architects.
Scene parts() {
  Scene scene;
  scene.materials.resize(20);
  for (Material& material : scene.materials) material.double_sided = true;
  scene.nodes.emplace_back();
  constexpr int kSide = 22;
  for (int part = 0; part < kSide * kSide * kSide; ++part) {
    const auto first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    const auto first_index = static_cast<std::uint32_t>(scene.indices.size());
    for (int corner = 0; corner < 8; ++corner)
      scene.vertices.push_back(
          {.position_in_node = {corner & 1 ? 0.035f : 0.0f, corner & 2 ? 0.035f : 0.0f,
                                corner & 4 ? 0.035f : 0.0f}});
    for (const std::uint32_t corner : {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5})
      scene.indices.push_back(first_vertex + corner);
    scene.meshes.push_back(
        {.first_index = first_index,
         .index_count = 36,
         .material = part % 20,
         .bounds_in_node = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Constant(0.035f)}});
    Node node{.name = {}, .parent = 0, .meshes = {part}};
    const Eigen::Array3i place(part % kSide, part / kSide % kSide, part / kSide / kSide);
    node.parent_from_node.topRightCorner<3, 1>() =
        0.05f * (place - Eigen::Array3i(11, 11, 25)).cast<float>();
    scene.nodes.push_back(node);
  }
  return scene;
}

/// 16 thousand boxes around the wall, as the pieces of a large scan are.
std::vector<Box3f> many_boxes() {
  std::vector<Box3f> boxes;
  for (int index = 0; index < 16000; ++index) {
    const Eigen::Vector3f low(0.05f * static_cast<float>(index % 160) - 4,
                              0.05f * static_cast<float>(index / 160 % 100) - 2.5f,
                              -0.3f * static_cast<float>(index % 7));
    boxes.emplace_back(low, low + Eigen::Vector3f::Constant(0.05f));
  }
  return boxes;
}

/// Which of them each of 28 tiles sees, beside a test of each box by its corners' signs, as one
/// would write it with Eigen.
void boxes_seen_by_28_tiles(benchmark::State& state) {
  std::vector<Mat4> views;
  for (const Tile& tile : wall_of_28().tiles)
    views.push_back(tile_view(tile.corners, kFrame.eye_in_wall)->clip_from_world);
  const std::vector<Box3f> boxes = many_boxes();
  BoxRows rows;
  for (const Box3f& box : boxes) rows.add(box);
  const auto one_by_one = [](const Mat4& clip_from_world, const Box3f& box) {
    Eigen::Matrix<double, 4, 8> corners;
    for (int i = 0; i < 8; ++i)
      corners.col(i) = box.corner(static_cast<Box3f::CornerType>(i)).cast<double>().homogeneous();
    const Eigen::Array<double, 4, 8> clip = clip_from_world * corners;
    const auto all_beyond = [&](int axis, double side) {
      return (side * clip.row(axis) > clip.row(3)).all();
    };
    return !(all_beyond(0, 1) || all_beyond(0, -1) || all_beyond(1, 1) || all_beyond(1, -1) ||
             all_beyond(2, 1));
  };
  std::size_t seen = 0, seen_one_by_one = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const Mat4& view : views)
    for (const Box3f& box : boxes) seen_one_by_one += one_by_one(view, box);
  const double reference_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto began = std::chrono::steady_clock::now();
  for (auto _ : state) {
    seen = 0;
    for (const Mat4& view : views) seen += rows.seen_by(ViewPlanes(view)).size();
  }
  const double taken_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() /
      static_cast<double>(state.iterations());
  if (seen < seen_one_by_one) state.SkipWithError("boxes are missing");
  state.counters["ratio_to_one_by_one"] = taken_s / reference_s;
  state.counters["seen"] = static_cast<double>(seen);
}
BENCHMARK(boxes_seen_by_28_tiles)->Unit(benchmark::kMicrosecond);

/// What a wall of 28 tiles pays for parts that vindu pack has joined, beside those that it has not.
void ten_thousand_parts(benchmark::State& state) {
  need_context();
  Scene as_they_come = parts(), joined = parts();
  join_still_parts(joined);
  for (Scene* scene : {&as_they_come, &joined}) cut_into_chunks(*scene);
  const Look look{Style::lit, 1, Shadows::none};
  WallRenderer tiles(wall_of_28(), kScale, look), reference(wall_of_28(), kScale, look);
  tiles.show(pack(joined));
  reference.show(pack(as_they_come));
  for (auto _ : state) frame_s(tiles);
  state.counters["ratio_to_parts_as_they_come"] = best_frame_s(tiles) / best_frame_s(reference);
  write_png(tiles.picture().read(), "out/parts.png");
}
BENCHMARK(ten_thousand_parts)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace vindu
