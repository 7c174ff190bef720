#include "renderer/import_geometry.h"

#include <algorithm>
#include <cmath>

#include "renderer/import_dedupe.h"
#include "renderer/import_normals.h"
#include "renderer/import_tangents.h"

namespace vindu {
namespace {

/// Farther away than any model reaches; squares of it are still finite floats.
constexpr float kMaxCoordinate = 1e18f;

bool usable_position(const aiVector3D& v) {
  return std::abs(v.x) < kMaxCoordinate && std::abs(v.y) < kMaxCoordinate &&
         std::abs(v.z) < kMaxCoordinate;  // false for NaN
}

/// Adding zero turns -0 into 0, so that equal vertices have equal bytes.
Eigen::Vector3f vector_of(const aiVector3D& v) { return {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; }

/// Assimp's (0, 0) is the lower left of the texture, ours the upper left.
Eigen::Vector2f uv_of(const aiVector3D& uv) {
  const Eigen::Vector2f result(uv.x + 0.0f, 1 - uv.y);
  return result.allFinite() ? result : Eigen::Vector2f::Zero();
}

/// The file's tangent; left at zero where it gives no direction.
void take_tangent(const aiMesh& mesh, unsigned index, Vertex& vertex) {
  if (!mesh.HasTangentsAndBitangents() || !usable_position(mesh.mTangents[index]) ||
      !usable_position(mesh.mBitangents[index]))
    return;
  const Eigen::Vector3f tangent = vector_of(mesh.mTangents[index]).stableNormalized();
  if (std::abs(tangent.norm() - 1) > 1e-3f) return;
  const Eigen::Vector3f bitangent = vector_of(mesh.mBitangents[index]);
  vertex.tangent_in_node = tangent + Eigen::Vector3f::Zero();
  vertex.bitangent_sign = vertex.normal_in_node.cross(tangent).dot(bitangent) < 0 ? -1.0f : 1.0f;
}

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

Rgba8 colour_of(const aiColor4D& colour) {
  const auto byte = [](float value) { return byte_of(std::isfinite(value) ? value : 1.0f); };
  return {byte(colour.r), byte(colour.g), byte(colour.b), byte(colour.a)};
}

/// Some writers leave all colours black or all alpha zero where they mean that there is none.
struct ColourUse {
  bool rgb = false;
  bool alpha = false;

  explicit ColourUse(const aiMesh& mesh) {
    if (!mesh.HasVertexColors(0)) return;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiColor4D& colour = mesh.mColors[0][i];
      rgb = rgb || colour.r > 0 || colour.g > 0 || colour.b > 0;
      alpha = alpha || colour.a > 0;
    }
  }
};

/// Reads single vertices of one mesh.
class VertexReader {
 public:
  VertexReader(const aiMesh& mesh, const MeshOptions& options)
      : mesh_(mesh),
        options_(options),
        colour_use_(mesh),
        uv_channel_(mesh.HasTextureCoords(options.uv_channels[0]) ? options.uv_channels[0] : 0) {}

  /// Empty where the file's normal gives no direction.
  std::optional<Eigen::Vector3f> unit_normal(unsigned index) const {
    if (options_.own_normals || !mesh_.HasNormals() || !usable_position(mesh_.mNormals[index]))
      return std::nullopt;
    const Eigen::Vector3f normal = vector_of(mesh_.mNormals[index]).stableNormalized();
    if (std::abs(normal.norm() - 1) > 1e-3f) return std::nullopt;
    return Eigen::Vector3f(normal + Eigen::Vector3f::Zero());
  }

  std::span<const Influences> influences() const { return options_.influences; }

  Vertex read(unsigned index, const Eigen::Vector3f& normal) const {
    Vertex vertex;
    vertex.position_in_node = vector_of(mesh_.mVertices[index]);
    vertex.normal_in_node = normal;
    if (mesh_.HasTextureCoords(uv_channel_))
      vertex.uv = uv_of(mesh_.mTextureCoords[uv_channel_][index]);
    const unsigned second = options_.uv_channels[1];
    if (second != options_.uv_channels[0])
      vertex.uv_1 =
          mesh_.HasTextureCoords(second) ? uv_of(mesh_.mTextureCoords[second][index]) : vertex.uv;
    if (options_.normal_map) take_tangent(mesh_, index, vertex);
    if (colour_use_.rgb) vertex.colour = colour_of(mesh_.mColors[0][index]);
    if (!colour_use_.alpha) vertex.colour[3] = 255;
    return vertex;
  }

 private:
  const aiMesh& mesh_;
  const MeshOptions& options_;
  ColourUse colour_use_;
  unsigned uv_channel_;
};

bool usable_triangle(const aiMesh& mesh, const aiFace& face) {
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned index = face.mIndices[k];
    if (index >= mesh.mNumVertices || !usable_position(mesh.mVertices[index])) return false;
  }
  return true;
}

/// Indices into the Assimp mesh, three for each triangle that can be drawn.
std::vector<unsigned> usable_corners(const aiMesh& mesh, MeshLosses& losses) {
  std::vector<unsigned> corners;
  corners.reserve(std::size_t{3} * mesh.mNumFaces);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3)
      ++losses.points_and_lines;
    else if (!usable_triangle(mesh, face))
      ++losses.broken_triangles;
    else
      corners.insert(corners.end(), face.mIndices, face.mIndices + 3);
  }
  return corners;
}

bool all_have_normals(const VertexReader& reader, const std::vector<unsigned>& corners) {
  return std::ranges::all_of(corners,
                             [&](unsigned i) { return reader.unit_normal(i).has_value(); });
}

/// Vertices on their way into the scene: equal ones, which the same joints move, once.
class VertexTable {
 public:
  VertexTable(Scene& scene, std::span<const Influences> influences, std::size_t capacity)
      : scene_(scene), influences_(influences), first_(scene.vertices.size()) {
    if (influences.empty())
      plain_.emplace(scene.vertices, capacity);
    else
      skinned_.emplace(distinct_, capacity);
  }

  /// `source`: its index in the Assimp mesh.
  std::uint32_t index_of(const Vertex& vertex, unsigned source) {
    if (plain_) return plain_->index_of(vertex);
    const std::uint32_t index = skinned_->index_of({vertex, influences_[source]});
    if (first_ + index == scene_.vertices.size()) {
      scene_.vertices.push_back(vertex);
      scene_.influences.resize(scene_.vertices.size());
      scene_.influences.back() = influences_[source];
    }
    return static_cast<std::uint32_t>(first_ + index);
  }

 private:
  struct SkinnedVertex {
    Vertex vertex;
    Influences influences;
  };

  Scene& scene_;
  std::span<const Influences> influences_;
  std::size_t first_;
  std::vector<SkinnedVertex> distinct_;
  std::optional<Deduplicator<Vertex>> plain_;
  std::optional<Deduplicator<SkinnedVertex>> skinned_;
};

/// Every vertex as the file has it.
void append_as_given(const aiMesh& mesh, const VertexReader& reader,
                     const std::vector<unsigned>& corners, Scene& scene) {
  VertexTable table(scene, reader.influences(),
                    std::min<std::size_t>(corners.size(), mesh.mNumVertices));
  constexpr std::uint32_t unset = 0xffffffff;
  std::vector<std::uint32_t> scene_index(mesh.mNumVertices, unset);
  for (const unsigned corner : corners) {
    if (scene_index[corner] == unset)
      scene_index[corner] =
          table.index_of(reader.read(corner, *reader.unit_normal(corner)), corner);
    scene.indices.push_back(scene_index[corner]);
  }
}

/// A vertex is split where its triangles do not share a normal.
void append_with_normals(const aiMesh& mesh, const VertexReader& reader,
                         const std::vector<unsigned>& corners, Scene& scene) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(corners.size());
  for (const unsigned corner : corners) positions.push_back(vector_of(mesh.mVertices[corner]));
  const std::vector<Eigen::Vector3f> computed = corner_normals(positions);
  VertexTable table(scene, reader.influences(), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3f normal = reader.unit_normal(corners[i]).value_or(computed[i]);
    scene.indices.push_back(table.index_of(reader.read(corners[i], normal), corners[i]));
  }
}

Box3f bounds_of(const Scene& scene, const Mesh& mesh) {
  Box3f bounds;
  for (std::uint32_t i = 0; i < mesh.index_count; ++i)
    bounds.extend(scene.vertices[scene.indices[mesh.first_index + i]].position_in_node);
  return bounds;
}

}  // namespace

std::optional<Mesh> append_mesh(const aiMesh& source, const MeshOptions& options, Scene& scene,
                                MeshLosses& losses) {
  if (!source.HasPositions() || !source.HasFaces()) return std::nullopt;
  const std::vector<unsigned> corners = usable_corners(source, losses);
  if (corners.empty()) return std::nullopt;
  losses.morphed_meshes += source.mNumAnimMeshes > 0 ? 1 : 0;
  Mesh mesh;
  mesh.first_index = static_cast<std::uint32_t>(scene.indices.size());
  mesh.index_count = static_cast<std::uint32_t>(corners.size());
  mesh.skinned = !options.influences.empty();
  const VertexReader reader(source, options);
  if (all_have_normals(reader, corners))
    append_as_given(source, reader, corners, scene);
  else
    append_with_normals(source, reader, corners, scene);
  if (!scene.influences.empty()) scene.influences.resize(scene.vertices.size());
  if (options.normal_map) complete_tangents(scene, mesh, *options.normal_map);
  mesh.bounds_in_node = bounds_of(scene, mesh);
  return mesh;
}

}  // namespace vindu
