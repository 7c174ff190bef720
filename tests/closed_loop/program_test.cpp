// The closed loop through the program itself: a model file, a wall file and an eye go in by the
// command line, the tiles' PNG files come out, and the eye's ordinary camera judges them.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "core/site.h"
#include "renderer/surface.h"
#include "tests/closed_loop/displacement.h"
#include "tests/closed_loop/position_code.h"

namespace vindu::test {
namespace {

namespace fs = std::filesystem;

/// Binary PLY with vertex colours.
void write_ply(const Scene& scene, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << scene.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty "
         "uchar green\nproperty uchar blue\nelement face "
      << scene.triangle_count() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vertex& vertex : scene.vertices) {
    out.write(reinterpret_cast<const char*>(vertex.position_in_node.data()), 12);
    out.write(reinterpret_cast<const char*>(vertex.colour.data()), 3);
  }
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
    out.put(3);
    out.write(reinterpret_cast<const char*>(&scene.indices[i]), 12);
  }
}

constexpr const char* kWallFile = R"([wall]
columns = 7
rows = 4
width_m = 5.185
height_m = 2.238
tile_width_px = 1024
tile_height_px = 768
bezel_x_mm = 8

[[tile]]
name = "tile-5-2"
lower_left_m = [1.14, 0.01, 0.05]
lower_right_m = [1.84, 0.02, 0.16]
upper_left_m = [1.13, 0.55, 0.0]
)";

TEST(ClosedLoopOfTheProgram, RenderedTilesShowWhatTheEyeSees) {
  const fs::path folder = fs::path(::testing::TempDir()) / "vindu_closed_loop";
  fs::create_directories(folder);
  const Scene code = position_coded_scene(0.05);
  write_ply(code, folder / "code.ply");
  std::ofstream(folder / "wall.toml") << kWallFile;
  const std::string command =
      std::string(VINDU_PROGRAM) + " --quiet render " + (folder / "code.ply").string() +
      " --wall " + (folder / "wall.toml").string() +
      " --eye -0.7,0.3,1.6 --all --place as-is --unlit --out " + folder.string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);

  const Site site = read_site((folder / "wall.toml").string());
  const auto surface = make_headless_surface();
  const SceneRenderer reference(Style::unlit);
  const GpuScene scene = uploaded(pack(code), Look{Style::unlit});
  for (const std::string name : {"tile-0-0", "tile-3-1", "tile-5-2", "tile-6-3"}) {
    const Displacements found =
        displacements(read_png((folder / (name + ".png")).string()),
                      reference_of_tile(*site.wall.find(name), {-0.7, 0.3, 1.6}, reference, scene));
    std::printf("  vindu render, %s: mean %.3f px, p99 %.3f px over %.0f %% of the pixels\n",
                name.c_str(), found.mean_px(), found.quantile_px(0.99),
                100 * found.readable_share());
    EXPECT_TRUE(shows_what_the_eye_sees(found)) << name;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace vindu::test
