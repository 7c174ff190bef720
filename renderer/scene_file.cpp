#include "renderer/scene_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/error.h"
#include "renderer/scene_archive.h"

namespace vindu {
namespace {

constexpr std::array<char, 8> kMagic = {'V', 'S', 'C', 'E', 'N', 'E', '\r', '\n'};
/// To be raised with any change of what scene_archive.h describes.
constexpr std::uint32_t kFormat = 2;

struct Header {
  std::array<char, 8> magic{};
  std::uint32_t format = 0;
  std::uint32_t vertex_bytes = 0;
  std::uint64_t content_bytes = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) == 32);

/// Notices damage, not malice: eight bytes at a time, mixed as in FNV-1a.
std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), 8);
    sum = std::rotl((sum ^ word) * kPrime, 29);
  }
  for (const std::uint8_t byte : bytes) sum = (sum ^ byte) * kPrime;
  return sum;
}

/// A file's bytes, mapped into memory while it lives.
class MappedFile {
 public:
  explicit MappedFile(const std::string& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw Error({"cannot be opened", file, "pack the model: vindu pack MODEL"});
    struct stat status {};
    if (fstat(descriptor, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      data_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
    }
    close(descriptor);
    if (data_ == MAP_FAILED) size_ = 0;
  }
  ~MappedFile() {
    if (size_ > 0) munmap(data_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::uint8_t> bytes() const {
    return {static_cast<const std::uint8_t*>(data_), size_};
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

[[noreturn]] void refuse(const std::string& what, const std::string& file) {
  throw Error({what, file, "pack the model again: vindu pack MODEL --out FILE"});
}

/// The content, after what stands before it.
std::span<const std::uint8_t> checked_content(std::span<const std::uint8_t> bytes,
                                              const std::string& file) {
  Header header;
  if (bytes.size() < sizeof(Header)) refuse("is no packed scene", file);
  std::memcpy(&header, bytes.data(), sizeof(Header));
  const auto content = bytes.subspan(sizeof(Header));
  if (header.magic != kMagic) refuse("is no packed scene", file);
  if (header.format != kFormat || header.vertex_bytes != sizeof(Vertex))
    refuse("was packed by another version of Vindu", file);
  if (header.content_bytes != content.size() || header.checksum != checksum_of(content))
    refuse("is damaged or cut off", file);
  return content;
}

bool texture_is_whole(const Image& image) {
  return image.width_px > 0 && image.height_px > 0 &&
         image.pixels.size() ==
             static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
}

bool within(int index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool uses_known_textures(const Material& material, std::size_t textures) {
  return std::ranges::all_of(material.textures, [&](const TextureUse& use) {
    return use.image == -1 || within(use.image, textures);
  });
}

bool lies_within(const Mesh& mesh, const Scene& scene) {
  return mesh.index_count % 3 == 0 && mesh.first_index <= scene.indices.size() &&
         mesh.index_count <= scene.indices.size() - mesh.first_index &&
         within(mesh.material, scene.materials.size());
}

/// What they weigh is more than a question of looks: bounds count on a blend of whole weights.
bool are_sound(const Influences& influences, std::size_t joints) {
  int sum = 0;
  for (std::size_t i = 0; i < influences.joints.size(); ++i) {
    sum += influences.weights[i];
    if (influences.joints[i] >= joints) return false;
  }
  return sum == kFullWeight;
}

std::string fault_of_skin(const Scene& scene) {
  const auto& [joints, influences] = scene.skin;
  if (joints.size() > kMaxJoints) return "there are more joints than fit";
  for (const Joint& joint : joints)
    if (!within(joint.node, scene.nodes.size()) || !joint.joint_from_mesh.allFinite())
      return "a joint is no node, or nowhere";
  if (!influences.empty() && influences.size() != scene.vertices.size())
    return "some vertices have joints and others not";
  for (const Mesh& mesh : scene.meshes)
    for (std::uint32_t i = 0; mesh.skinned && i < mesh.index_count; ++i)
      if (influences.empty() ||
          !are_sound(influences[scene.indices[mesh.first_index + i]], joints.size()))
        return "a vertex follows no joint, or one that is not there";
  return "";
}

/// Each of the coarsenings is there, and coarser than what it was made of.
bool levels_in_order(const Mesh& mesh, const std::vector<Coarsening>& coarsenings) {
  for (const int index : {mesh.made_by, mesh.replaced_by})
    if (index != -1 && !within(index, coarsenings.size())) return false;
  return mesh.made_by == -1 || mesh.replaced_by == -1 ||
         coarsenings[mesh.made_by].error_in_node < coarsenings[mesh.replaced_by].error_in_node;
}

}  // namespace

std::string fault_of(const Scene& scene) {
  if (!std::ranges::all_of(scene.textures, texture_is_whole)) return "a texture is not whole";
  for (const Material& material : scene.materials)
    if (!uses_known_textures(material, scene.textures.size()))
      return "a material names a texture that is not there";
  if (std::ranges::any_of(scene.indices,
                          [&](std::uint32_t index) { return index >= scene.vertices.size(); }))
    return "a triangle names a vertex that is not there";
  for (const Mesh& mesh : scene.meshes)
    if (!lies_within(mesh, scene)) return "a mesh names triangles or a material that are not there";
  for (const Mesh& mesh : scene.meshes)
    if (!levels_in_order(mesh, scene.coarsenings)) return "its levels of detail are out of order";
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.parent < -1 || node.parent >= static_cast<int>(i) || (i > 0 && node.parent < 0))
      return "a node comes before its parent";
    if (!std::ranges::all_of(node.meshes,
                             [&](int mesh) { return within(mesh, scene.meshes.size()); }))
      return "a node names a mesh that is not there";
  }
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels)
      if (!within(channel.node, scene.nodes.size())) return "an animation moves no node";
  if (scene.nodes.empty()) return "there is no node";
  return fault_of_skin(scene);
}

void write_scene_file(const PackedScene& packed, const std::string& file) {
  SceneWriter writer;
  writer(packed);
  const std::vector<std::uint8_t> content = writer.take();
  const Header header{kMagic, kFormat, sizeof(Vertex), content.size(), checksum_of(content)};
  // Beside it first, and then in one step into its place.
  const std::string beside = file + "." + std::to_string(getpid()) + ".part";
  {
    std::ofstream stream(beside, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(&header), sizeof(Header));
    stream.write(reinterpret_cast<const char*>(content.data()),
                 static_cast<std::streamsize>(content.size()));
    stream.flush();
    std::error_code unable;
    if (stream) std::filesystem::rename(beside, file, unable);
    if (stream && !unable) return;
    std::filesystem::remove(beside, unable);
  }
  throw Error({"cannot be written", file, "see whether the disk is full, or choose another --out"});
}

PackedScene read_scene_file(const std::string& file) {
  const MappedFile mapped(file);
  SceneReader reader(checked_content(mapped.bytes(), file));
  PackedScene packed;
  reader(packed);
  if (!reader.good() || !reader.at_end()) refuse("is damaged or cut off", file);
  if (const std::string fault = fault_of(packed.imported.scene); !fault.empty())
    refuse("is damaged (" + fault + ")", file);
  return packed;
}

}  // namespace vindu
