#include "tests/closed_loop/position_code.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vindu::test {
namespace {

/// Patches are culled one by one.
constexpr double kPatch_m = 1;

/// Seen under a small angle, through the outer tiles, by an eye close to the wall.
constexpr double kSideCell_m = 0.1;

/// A flat surface of whole cells: a cell's corner is origin + cell_m * (u * across + v * up).
struct Surface {
  Eigen::Vector3d origin_in_wall;
  Eigen::Vector3d across;  // of length 1
  Eigen::Vector3d up;
  double across_m = 0;
  double up_m = 0;
  std::uint8_t name = 0;  // blue
};

std::uint8_t zigzag(int cell) { return cell % 2 ? 255 : 0; }

/// Cells from `first` up to, not including, `last`.
struct Cells {
  int first = 0;
  int last = 0;
};

void add_patch(const Surface& surface, double cell_m, Cells across, Cells up, Scene& scene) {
  const auto [first_u, last_u] = across;
  const auto [first_v, last_v] = up;
  const auto base = static_cast<std::uint32_t>(scene.vertices.size());
  const auto columns = static_cast<std::uint32_t>(last_u - first_u + 1);
  Mesh mesh;
  mesh.first_index = static_cast<std::uint32_t>(scene.indices.size());
  for (int v = first_v; v <= last_v; ++v)
    for (int u = first_u; u <= last_u; ++u) {
      const Eigen::Vector3d place =
          surface.origin_in_wall + cell_m * (u * surface.across + v * surface.up);
      scene.vertices.push_back({.position_in_node = place.cast<float>(),
                                .colour = {zigzag(u), zigzag(v), surface.name, 255}});
      mesh.bounds_in_node.extend(place.cast<float>());
    }
  for (int v = 0; v < last_v - first_v; ++v)
    for (int u = 0; u < last_u - first_u; ++u) {
      const std::uint32_t corner =
          base + static_cast<std::uint32_t>(v) * columns + static_cast<std::uint32_t>(u);
      for (const std::uint32_t step : {0u, 1u, columns + 1, 0u, columns + 1, columns})
        scene.indices.push_back(corner + step);
    }
  mesh.index_count = static_cast<std::uint32_t>(scene.indices.size()) - mesh.first_index;
  scene.nodes.front().meshes.push_back(static_cast<int>(scene.meshes.size()));
  scene.meshes.push_back(mesh);
}

/// A length in cells, cut into patches.
std::vector<Cells> patches(double length_m, double cell_m) {
  const int cells = static_cast<int>(std::lround(length_m / cell_m));
  const int step = static_cast<int>(std::lround(kPatch_m / cell_m));
  std::vector<Cells> found;
  for (int first = 0; first < cells; first += step)
    found.push_back({first, std::min(first + step, cells)});
  return found;
}

void add_surface(const Surface& surface, double cell_m, Scene& scene) {
  for (const Cells& up : patches(surface.up_m, cell_m))
    for (const Cells& across : patches(surface.across_m, cell_m))
      add_patch(surface, cell_m, across, up, scene);
}

}  // namespace

Scene position_coded_scene(double cell_m) {
  Scene scene;
  scene.name = "position code";
  scene.nodes.emplace_back();
  Material material;
  material.double_sided = true;
  scene.materials.push_back(material);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d slanted = Eigen::Vector3d(1, 0, 1).normalized();
  const auto add = [&](const Surface& surface) { add_surface(surface, cell_m, scene); };
  add({{-12, -8, -2.0}, x, y, 24, 16, 40});         // behind everything
  add({{-1.5, -0.9, -0.8}, x, y, 1.25, 1.75, 90});  // half as deep
  add({{0.4, -0.5, 0.0}, x, y, 0.75, 0.75, 140});   // in the screen plane
  add({{-0.5, 0.1, 0.15}, x, y, 0.5, 0.5, 190});    // before it
  add({{1.2, -1.0, -0.9}, slanted, y, 1, 2, 240});  // slanted through depth
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  add_surface({{-12, -8, -2}, z, y, 3, 16, 15}, kSideCell_m, scene);  // to the left, as far as it
  add_surface({{12, -8, -2}, z, y, 3, 16, 65}, kSideCell_m, scene);   // is seen, and to the right
  return scene;
}

}  // namespace vindu::test
