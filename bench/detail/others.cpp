#include "bench/detail/others.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/error.h"

namespace vindu {
namespace {

/// Under a virtual screen; what it prints, or empty where it fails.
std::optional<std::string> output_of(const std::string& command, SizePx size) {
  const std::string line = fmt::format(
      "LIBGL_ALWAYS_SOFTWARE=1 vblank_mode=0 xvfb-run -a -s '-screen 0 {}x{}x24' {} "
      "2> /dev/null",
      size.width, size.height, command);
  FILE* const pipe = popen(line.c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string output;
  std::array<char, 256> piece{};
  while (std::fgets(piece.data(), piece.size(), pipe)) output += piece.data();
  return pclose(pipe) == 0 ? std::optional(output) : std::nullopt;
}

std::optional<double> osgviewer_run_s(const std::string& model, SizePx size, int frames) {
  const auto start = std::chrono::steady_clock::now();
  const auto output =
      output_of(fmt::format("env OSG_WINDOW='0 0 {} {}' OSG_RUN_FRAME_COUNT={} osgviewer '{}'",
                            size.width, size.height, frames, model),
                size);
  if (!output) return std::nullopt;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void write_ply(const Scene& scene, const std::string& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << scene.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
            "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
            "property uchar blue\nelement face "
         << scene.indices.size() / 3 << "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](const void* data, std::streamsize size) {
    stream.write(static_cast<const char*>(data), size);
  };
  for (const Vertex& vertex : scene.vertices) {
    put(vertex.position_in_node.data(), 12);
    put(vertex.normal_in_node.data(), 12);
    put(vertex.colour.data(), 3);
  }
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
    stream.put(3);
    put(&scene.indices[i], 12);
  }
  if (!stream.flush()) throw Error({"cannot be written", file, "see whether the disk is full"});
}

std::optional<ViewerTimes> osgviewer_times(const std::string& model, SizePx size, int frames) {
  const auto one_s = osgviewer_run_s(model, size, 1);
  const auto many_s = osgviewer_run_s(model, size, 1 + frames);
  if (!one_s || !many_s || *many_s <= *one_s) return std::nullopt;
  return ViewerTimes{(*many_s - *one_s) / frames, *one_s};
}

std::optional<ViewerTimes> pvbatch_times(const std::string& model, double half_diagonal,
                                         SizePx size, int frames, const std::string& picture) {
  const auto output = output_of(
      fmt::format("pvbatch '" VINDU_SOURCE_DIR "/bench/detail/pvbatch.py' '{}' {} {} {} {} {} '{}'",
                  model, size.width, size.height, osgviewer_distance(half_diagonal),
                  osgviewer_fov_y_rad() * 180 / M_PI, frames, picture),
      size);
  ViewerTimes times;
  if (!output ||
      std::sscanf(output->c_str(), "%lf %lf", &times.frame_s, &times.first_picture_s) != 2)
    return std::nullopt;
  return times;
}

// osg::View and osgGA::CameraManipulator::computeHomePosition of OpenSceneGraph 3.6: a screen of
// 0.26 m seen from 0.5 m, and the ball around the model's box touching its upper and lower edge.
double osgviewer_fov_y_rad() { return 2 * std::atan(0.13 / 0.5); }

double osgviewer_distance(double half_diagonal) {
  return half_diagonal / std::sin(0.5 * osgviewer_fov_y_rad());
}

}  // namespace vindu
