// What core costs in a frame: the matrices of all tiles, and the question for a pose. Each stands
// beside a named reference in the same run; the counter is the ratio.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "core/frustum.h"
#include "core/pose_history.h"
#include "core/site.h"

namespace vindu {
namespace {

Wall tromso_wall() { return read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml").wall; }

const Vec3 kEye_in_wall(0.3, 0.1, 1.8);

void our_matrices(const Wall& wall) {
  for (const Tile& tile : wall.tiles)
    benchmark::DoNotOptimize(clip_from_wall(tile.corners, kEye_in_wall));
}

/// The usual way for a flat wall at right angles to the view: GLM's frustum and lookAt, doubles.
void glm_matrices(const Wall& wall) {
  const glm::dvec3 eye(kEye_in_wall.x(), kEye_in_wall.y(), kEye_in_wall.z());
  for (const Tile& tile : wall.tiles) {
    const auto extents = frustum_extents(tile.corners, kEye_in_wall, kNear_m);
    benchmark::DoNotOptimize(glm::frustum(extents->left_m, extents->right_m, extents->bottom_m,
                                          extents->top_m, kNear_m, 100.0) *
                             glm::lookAt(eye, eye - glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)));
  }
}

Time at_ms(int time_ms) { return Time{} + std::chrono::milliseconds(time_ms); }

/// Two seconds of two cameras at 100 Hz each.
std::vector<PoseSample> samples() {
  std::vector<PoseSample> all(400);
  for (int i = 0; i < 400; ++i) {
    all[i].capture_time = at_ms(5 * i);
    all[i].level = TrackingLevel::six_dof;
    all[i].room_from_head.translation = {0.001 * i, 1.7, 2};
  }
  return all;
}

/// The plainest history: the newest sample not after the time, found by going through all.
Vec3 linear_scan(const std::vector<PoseSample>& all, Time time) {
  const PoseSample* newest = &all.front();
  for (const PoseSample& sample : all)
    if (sample.capture_time <= time) newest = &sample;
  return newest->room_from_head.translation;
}

/// Seconds that one call takes, the best of several rounds.
template <class Call>
double cost_s(Call call) {
  double best_s = 1e9;
  for (int round = 0; round < 20; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 1000; ++i) call();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best_s = std::min(best_s, taken.count() / 1000);
  }
  return best_s;
}

void matrices_of_28_tiles(benchmark::State& state) {
  const Wall wall = tromso_wall();
  for (auto _ : state) our_matrices(wall);
  state.counters["ratio_to_glm"] =
      cost_s([&] { our_matrices(wall); }) / cost_s([&] { glm_matrices(wall); });
}
BENCHMARK(matrices_of_28_tiles);

void matrices_of_28_tiles_by_glm_frustum_and_look_at(benchmark::State& state) {
  const Wall wall = tromso_wall();
  for (auto _ : state) glm_matrices(wall);
}
BENCHMARK(matrices_of_28_tiles_by_glm_frustum_and_look_at);

void pose_from_a_history_of_400(benchmark::State& state) {
  PoseHistory history;
  const std::vector<PoseSample> all = samples();
  for (const PoseSample& sample : all) history.add(sample);
  const Time time = at_ms(1002);
  for (auto _ : state) benchmark::DoNotOptimize(history.at(time));
  state.counters["ratio_to_scan"] =
      cost_s([&] { benchmark::DoNotOptimize(history.at(time)); }) /
      cost_s([&] { benchmark::DoNotOptimize(linear_scan(all, time)); });
}
BENCHMARK(pose_from_a_history_of_400);

void pose_by_linear_scan_without_interpolation(benchmark::State& state) {
  const std::vector<PoseSample> all = samples();
  const Time time = at_ms(1002);
  for (auto _ : state) benchmark::DoNotOptimize(linear_scan(all, time));
}
BENCHMARK(pose_by_linear_scan_without_interpolation);

}  // namespace
}  // namespace vindu
