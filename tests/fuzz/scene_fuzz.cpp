// Any bytes as a packed scene, behind its header and checksum: an error, or a scene whose every
// number leads somewhere. For libFuzzer; tests/fuzz/run.sh builds and runs it.
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.h"
#include "renderer/scene_archive.h"
#include "renderer/scene_file.h"

namespace {

using namespace vindu;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Reads all that a renderer would; its sum, so that nothing is left out.
double walk(const PackedScene& packed) {
  double sum = 0;
  for (const Mesh& mesh : packed.scene.meshes)
    for (std::uint32_t i = 0; i < mesh.index_count; ++i) {
      const std::uint32_t vertex = packed.geometry.indices[mesh.first_index + i];
      sum += packed.geometry.vertices[vertex].position_in_node.x();
      if (mesh.skinned) sum += packed.geometry.influences[vertex].weights[0];
    }
  for (const PackedTexture& texture : packed.textures) sum += texture.pixels.back()[0];
  const auto nodes = node_transforms(packed.scene, 0.7);
  sum += nodes.front()(0, 0);
  for (const Eigen::Matrix4f& joint : joint_transforms(packed.scene.joints, nodes))
    sum += joint(0, 0);
  return sum;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // At a multiple of 16 bytes, as a file is mapped.
  const std::vector<std::uint8_t> bytes(data, data + size);
  try {
    const PackedScene packed = scene_from(bytes, "fuzzed");
    static volatile double seen;
    seen = walk(packed);
    SceneWriter writer;
    writer(packed);
    const std::vector<std::uint8_t> again = writer.take();
    require(fault_of(scene_from(again, "again")).empty());
  } catch (const Error&) {
  }
  return 0;
}
