#include "renderer/import_tangents.h"

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>

namespace vindu {
namespace {

/// Where u and v grow on a triangle, in node; as long as its area is large.
struct Slopes {
  Eigen::Vector3f along_u = Eigen::Vector3f::Zero();
  bool mirrored = false;  ///< the picture is seen from its back
  bool known = false;
};

Eigen::Vector2f place_in_texture(const Vertex& vertex, const TextureUse& use) {
  const Eigen::Vector2f& uv = use.uv_set == 1 ? vertex.uv_1 : vertex.uv;
  return use.texture_from_uv * Eigen::Vector3f(uv.x(), uv.y(), 1);
}

Slopes slopes_of(const Vertex& a, const Vertex& b, const Vertex& c, const TextureUse& use) {
  const Eigen::Vector3f edge_1 = b.position_in_node - a.position_in_node,
                        edge_2 = c.position_in_node - a.position_in_node;
  const Eigen::Vector2f origin = place_in_texture(a, use);
  const Eigen::Vector2f step_1 = place_in_texture(b, use) - origin,
                        step_2 = place_in_texture(c, use) - origin;
  const float area_in_texture = step_1.x() * step_2.y() - step_2.x() * step_1.y();
  Slopes slopes;
  if (!(std::abs(area_in_texture) > 1e-20f)) return slopes;
  const float side = area_in_texture < 0 ? -1.0f : 1.0f;
  const Eigen::Vector3f direction = side * (edge_1 * step_2.y() - edge_2 * step_1.y());
  const float length = direction.norm();
  if (!(length > 0)) return slopes;
  slopes.along_u = direction / length * edge_1.cross(edge_2).norm();
  // v grows down the picture, a normal map's y up: a picture seen from its front has u, v
  // clockwise.
  const Eigen::Vector3f face = edge_1.cross(edge_2);
  const Eigen::Vector3f normal = a.normal_in_node + b.normal_in_node + c.normal_in_node;
  slopes.mirrored = (area_in_texture > 0) == (face.dot(normal) >= 0);
  slopes.known = slopes.along_u.allFinite();
  return slopes;
}

/// A unit vector at right angles to `normal`, next to `wish`.
Eigen::Vector3f across(const Eigen::Vector3f& normal, const Eigen::Vector3f& wish) {
  const Eigen::Vector3f flat = (wish - normal * normal.dot(wish)).stableNormalized();
  return std::abs(flat.norm() - 1) < 1e-3f ? flat : normal.unitOrthogonal();
}

/// One vertex for each side of a picture; new ones are appended.
class SplitVertices {
 public:
  explicit SplitVertices(Scene& scene) : scene_(scene) {}

  std::uint32_t side_of(std::uint32_t vertex, bool mirrored) {
    const auto [first, is_first] = sign_of_.try_emplace(vertex, mirrored);
    if (is_first || first->second == mirrored) return vertex;
    const auto [other, is_new] =
        other_side_of_.try_emplace(vertex, static_cast<std::uint32_t>(scene_.vertices.size()));
    if (is_new) {
      const Vertex copy = scene_.vertices[vertex];
      scene_.vertices.push_back(copy);
      if (!scene_.influences.empty()) {
        const Influences same = scene_.influences[vertex];
        scene_.influences.push_back(same);
      }
      sign_of_[other->second] = mirrored;
    }
    return other->second;
  }

 private:
  Scene& scene_;
  std::unordered_map<std::uint32_t, bool> sign_of_;
  std::unordered_map<std::uint32_t, std::uint32_t> other_side_of_;
};

}  // namespace

void complete_tangents(Scene& scene, const Mesh& mesh, const TextureUse& normal_map) {
  const std::span<std::uint32_t> indices =
      std::span(scene.indices).subspan(mesh.first_index, mesh.index_count);
  struct Sum {
    Eigen::Vector3f along_u = Eigen::Vector3f::Zero();
    bool mirrored = false;
  };
  std::map<std::uint32_t, Sum> sums;  // of vertices without a tangent
  SplitVertices split(scene);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) -> const Vertex& {
      return scene.vertices[indices[i + k]];
    };
    const Slopes slopes = slopes_of(corner(0), corner(1), corner(2), normal_map);
    for (std::uint32_t& index : indices.subspan(i, 3)) {
      if (!scene.vertices[index].tangent_in_node.isZero()) continue;
      if (slopes.known) index = split.side_of(index, slopes.mirrored);
      Sum& sum = sums[index];
      if (!slopes.known) continue;
      sum.along_u += slopes.along_u;
      sum.mirrored = slopes.mirrored;
    }
  }
  for (const auto& [index, sum] : sums) {
    Vertex& vertex = scene.vertices[index];
    vertex.tangent_in_node = across(vertex.normal_in_node, sum.along_u);
    vertex.bitangent_sign = sum.mirrored ? -1.0f : 1.0f;
  }
}

}  // namespace vindu
