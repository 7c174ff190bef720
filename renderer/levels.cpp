#include "renderer/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "renderer/chunks.h"
#include "renderer/level_error.h"
#include "renderer/partition.h"
#include "renderer/simplify.h"
#include "renderer/surface_distance.h"
#include "renderer/vertex_order.h"

namespace vindu {
namespace {

constexpr std::size_t kChunksTogether = 16;  // of a coarsening, at most
/// A coarsening that keeps more of the triangles than this is not worth a level.
constexpr double kWorthwhile = 0.8;
/// Vertices of full detail that each chunk keeps to measure errors by.
constexpr std::size_t kWitnesses = 48;
/// Errors grow by at least so much from level to level: whatever rounds when they are projected,
/// their order stays.
constexpr float kLeastGrowth = 1.001f;

/// Each has a stack and a heap of its own, of 72 MiB addresses, and a packer's are limited.
constexpr std::size_t kMostThreads = 8;

/// A vertex of full detail, and how far it was off the level before.
struct Witness {
  std::uint32_t vertex = 0;
  float off_in_node = 0;
};

/// A chunk that nothing coarser stands for yet.
struct Piece {
  int mesh = 0;
  std::vector<Witness> witnesses;
};

std::span<std::uint32_t> indices_of(Scene& scene, const Mesh& mesh) {
  return std::span(scene.indices).subspan(mesh.first_index, mesh.index_count);
}

/// The worst ones, and of the others as many, evenly.
void thin_out(std::vector<Witness>& witnesses) {
  if (witnesses.size() <= kWitnesses) return;
  std::ranges::stable_sort(witnesses, std::ranges::greater(), &Witness::off_in_node);
  std::vector<Witness> kept(witnesses.begin(), witnesses.begin() + kWitnesses / 2);
  const std::size_t others = witnesses.size() - kWitnesses / 2;
  for (std::size_t i = 0; i < kWitnesses / 2; ++i)
    kept.push_back(witnesses[kWitnesses / 2 + i * others / (kWitnesses / 2)]);
  witnesses = std::move(kept);
}

Piece leaf_of(Scene& scene, int mesh) {
  const auto indices = indices_of(scene, scene.meshes[mesh]);
  std::vector<std::uint32_t> vertices(indices.begin(), indices.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Piece piece{.mesh = mesh, .witnesses = {}};
  for (const std::uint32_t vertex : vertices) piece.witnesses.push_back({vertex, 0});
  thin_out(piece.witnesses);
  return piece;
}

/// Axes that differ from level to level, so that borders of one lie across those of the next.
Eigen::Matrix3f axes_of_level(int level) {
  return Eigen::AngleAxisf(1.1f * static_cast<float>(level), Eigen::Vector3f(0.36f, 0.48f, 0.8f))
      .toRotationMatrix();
}

/// Makes one coarsening after the other of the meshes that share nodes and material.
class LevelMaker {
 public:
  LevelMaker(Scene& scene, const std::vector<bool>& shared_place, std::vector<int> nodes)
      : scene_(scene), shared_place_(shared_place), nodes_(std::move(nodes)) {}

  void make(std::vector<Piece> pieces) {
    bool coarser = true;
    for (int level = 1; coarser; ++level) {
      const std::size_t before = scene_.coarsenings.size();
      pieces = next_level(std::move(pieces), axes_of_level(level));
      coarser = scene_.coarsenings.size() > before;
    }
  }

 private:
  using Indices = std::vector<std::uint32_t>;

  /// What stands for a group.
  struct Coarser {
    Coarsening coarsening;
    std::vector<Indices> chunks;
    std::vector<Piece> pieces;  // of the chunks, not yet meshes
  };

  std::vector<Piece> next_level(std::vector<Piece> pieces, const Eigen::Matrix3f& axes) {
    std::vector<std::vector<Piece>> groups = groups_of(std::move(pieces), axes);
    std::vector<std::optional<Coarser>> made(groups.size());
    for_each_in_parallel(
        groups.size(), [&](std::size_t group) { made[group] = coarser_than(groups[group]); },
        kMostThreads);
    std::vector<Piece> next;
    for (std::size_t group = 0; group < groups.size(); ++group) {
      if (made[group]) groups[group] = replace(groups[group], std::move(*made[group]));
      made[group].reset();
      std::ranges::move(groups[group], std::back_inserter(next));
    }
    return next;
  }

  std::vector<std::vector<Piece>> groups_of(std::vector<Piece> pieces,
                                            const Eigen::Matrix3f& axes) const {
    std::vector<Placed> places;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      places.push_back({axes * scene_.meshes[pieces[i].mesh].bounds_in_node.center(),
                        static_cast<std::uint32_t>(i)});
    std::vector<std::vector<Piece>> groups;
    for (const std::span<Placed> part : compact_parts(places, kChunksTogether)) {
      std::vector<Piece>& group = groups.emplace_back();
      for (const Placed& placed : part) group.push_back(std::move(pieces[placed.item]));
    }
    return groups;
  }

  /// Nothing where there is nothing to leave out. Reentrant.
  std::optional<Coarser> coarser_than(const std::vector<Piece>& group) const {
    Indices all;
    for (const Piece& piece : group)
      std::ranges::copy(indices_of(scene_, scene_.meshes[piece.mesh]), std::back_inserter(all));
    if (all.size() <= 3 * kChunkTriangles / 2) return std::nullopt;
    const Indices fewer = simplified(scene_.vertices, all, all.size() / 3 / 2);
    if (fewer.empty() ||
        static_cast<double>(fewer.size()) > kWorthwhile * static_cast<double>(all.size()))
      return std::nullopt;
    Coarser coarser{.coarsening = {}, .chunks = chunks_of(fewer), .pieces = {}};
    coarser.pieces.resize(coarser.chunks.size());
    SurfacePatches surface(scene_.vertices);
    for (const Indices& chunk : coarser.chunks) surface.add(chunk);
    coarser.coarsening = measured(group, surface, coarser.pieces);
    if (!std::isfinite(coarser.coarsening.error_in_node)) return std::nullopt;
    for (Indices& chunk : coarser.chunks) order_triangles_by_vertices(chunk);
    for (Piece& piece : coarser.pieces) thin_out(piece.witnesses);
    return coarser;
  }

  /// What stands for the group from now on.
  std::vector<Piece> replace(const std::vector<Piece>& group, Coarser coarser) {
    const int index = static_cast<int>(scene_.coarsenings.size());
    scene_.coarsenings.push_back(coarser.coarsening);
    const int material = scene_.meshes[group.front().mesh].material;
    for (const Piece& piece : group) scene_.meshes[piece.mesh].replaced_by = index;
    for (std::size_t i = 0; i < coarser.chunks.size(); ++i)
      coarser.pieces[i].mesh = add_mesh(coarser.chunks[i], material, index);
    return std::move(coarser.pieces);
  }

  std::vector<Indices> chunks_of(const Indices& indices) const {
    std::vector<Placed> places;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t corner = i; corner < i + 3; ++corner)
        sum += scene_.vertices[indices[corner]].position_in_node;
      places.push_back({sum / 3, static_cast<std::uint32_t>(i)});
    }
    std::vector<Indices> chunks;
    for (const std::span<Placed> part : compact_parts(places, kChunkTriangles)) {
      Indices& chunk = chunks.emplace_back();
      for (const Placed& placed : part)
        chunk.insert(chunk.end(), indices.begin() + placed.item, indices.begin() + placed.item + 3);
    }
    return chunks;
  }

  /// Hands the group's witnesses to the chunks that stand for what they have seen.
  Coarsening measured(const std::vector<Piece>& group, const SurfacePatches& surface,
                      std::vector<Piece>& coarser) const {
    Coarsening coarsening = at_least(group);
    LevelError error(scene_.vertices, shared_place_);
    for (const Piece& piece : group)
      for (const Witness& witness : piece.witnesses) {
        const auto nearest = surface.nearest_to(scene_.vertices[witness.vertex].position_in_node);
        error.add(witness.vertex, nearest);
        coarser[nearest.patch].witnesses.push_back({witness.vertex, nearest.distance});
      }
    coarsening.error_in_node = std::max(
        {coarsening.error_in_node, error.in_node(surface.mean_edge()), least_error(coarsening)});
    return coarsening;
  }

  /// Around the coarsenings that the group was made by, and no better than the worst of them.
  Coarsening at_least(const std::vector<Piece>& group) const {
    Coarsening least;
    for (const Piece& piece : group) {
      const Mesh& mesh = scene_.meshes[piece.mesh];
      least.bounds_in_node.extend(mesh.bounds_in_node);
      if (mesh.made_by < 0) continue;
      const Coarsening& finer = scene_.coarsenings[mesh.made_by];
      least.bounds_in_node.extend(finer.bounds_in_node);
      least.error_in_node = std::max(least.error_in_node, kLeastGrowth * finer.error_in_node);
    }
    return least;
  }

  /// What a float's rounding may move: no error is stated as none.
  static float least_error(const Coarsening& coarsening) {
    return std::numeric_limits<float>::epsilon() * coarsening.bounds_in_node.sizes().norm() +
           std::numeric_limits<float>::min();
  }

  int add_mesh(const Indices& indices, int material, int made_by) {
    Mesh mesh{.first_index = static_cast<std::uint32_t>(scene_.indices.size()),
              .index_count = static_cast<std::uint32_t>(indices.size()),
              .material = material,
              .bounds_in_node = {},
              .made_by = made_by};
    for (const std::uint32_t index : indices)
      mesh.bounds_in_node.extend(scene_.vertices[index].position_in_node);
    scene_.indices.insert(scene_.indices.end(), indices.begin(), indices.end());
    scene_.meshes.push_back(mesh);
    const int added = static_cast<int>(scene_.meshes.size()) - 1;
    for (const int node : nodes_) scene_.nodes[node].meshes.push_back(added);
    return added;
  }

  Scene& scene_;
  const std::vector<bool>& shared_place_;  // of the vertices
  std::vector<int> nodes_;
};

/// The masks of leaves and the order of glass depend on single triangles; what is off by little at
/// rest may be off by more where joints bend it.
bool may_be_coarser(const Scene& scene, const Mesh& mesh) {
  return scene.materials[mesh.material].alpha_mode == AlphaMode::opaque && !mesh.skinned;
}

/// Meshes of one material that the same nodes show.
using Families = std::map<std::pair<std::vector<int>, int>, std::vector<int>>;

Families families_of(const Scene& scene) {
  std::vector<std::vector<int>> shown_by(scene.meshes.size());
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    for (const int mesh : scene.nodes[node].meshes)
      shown_by[mesh].push_back(static_cast<int>(node));
  Families families;
  for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
    if (!shown_by[mesh].empty() && may_be_coarser(scene, scene.meshes[mesh]))
      families[{shown_by[mesh], scene.meshes[mesh].material}].push_back(static_cast<int>(mesh));
  return families;
}

}  // namespace

void make_levels(Scene& scene) {
  const std::vector<bool> shared_place = vertices_of_shared_places(scene.vertices);
  for (const auto& family : families_of(scene)) {
    const std::vector<int>& meshes = family.second;
    std::vector<Piece> pieces(meshes.size());
    const auto make_leaf = [&](std::size_t i) {
      order_triangles_by_vertices(indices_of(scene, scene.meshes[meshes[i]]));
      pieces[i] = leaf_of(scene, meshes[i]);
    };
    for_each_in_parallel(meshes.size(), make_leaf, kMostThreads);
    LevelMaker(scene, shared_place, family.first.first).make(std::move(pieces));
  }
  // The coarsest first: its few vertices lie together, and so do those that each level adds.
  const std::vector<Mesh> coarsest_first(scene.meshes.rbegin(), scene.meshes.rend());
  order_vertices_by_use(scene, coarsest_first);
}

}  // namespace vindu
