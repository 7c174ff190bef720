#include "bench/detail/osgviewer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/error.h"

namespace vindu {
namespace {

std::optional<double> run_s(const std::string& model, SizePx size, int frames) {
  const std::string command = fmt::format(
      "LIBGL_ALWAYS_SOFTWARE=1 OSG_WINDOW='0 0 {0} {1}' OSG_RUN_FRAME_COUNT={2} vblank_mode=0 "
      "xvfb-run -a -s '-screen 0 {0}x{1}x24' osgviewer '{3}' > /dev/null 2>&1",
      size.width, size.height, frames, model);
  const auto start = std::chrono::steady_clock::now();
  if (std::system(command.c_str()) != 0) return std::nullopt;
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

std::optional<double> osgviewer_frame_s(const std::string& model, SizePx size, int frames) {
  constexpr int kWarmUp = 3;
  const auto few_s = run_s(model, size, kWarmUp);
  const auto many_s = run_s(model, size, kWarmUp + frames);
  if (!few_s || !many_s || *many_s <= *few_s) return std::nullopt;
  return (*many_s - *few_s) / frames;
}

// osg::View and osgGA::CameraManipulator::computeHomePosition of OpenSceneGraph 3.6: a screen of
// 0.26 m seen from 0.5 m, and the ball around the model's box touching its upper and lower edge.
double osgviewer_fov_y_rad() { return 2 * std::atan(0.13 / 0.5); }

double osgviewer_distance(double half_diagonal) {
  return half_diagonal / std::sin(0.5 * osgviewer_fov_y_rad());
}

}  // namespace vindu
