// A scene on the GPU: one vertex and one index buffer, materials, textures, and where every node
// stands this frame. One copy serves any number of views. Bound to the render thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/rigid3.h"
#include "renderer/culling.h"
#include "renderer/gpu_skin.h"
#include "renderer/gpu_textures.h"
#include "renderer/surface_kind.h"
#include "renderer/view.h"

namespace vindu {

/// Of a scene's surfaces: all, and those that are left out since a view does not see them.
struct DrawCount {
  int draws = 0;
  int culled = 0;
  std::uint64_t triangles = 0;         ///< of all draws
  std::uint64_t culled_triangles = 0;  ///< of those left out: as coarse as they were when they were

  DrawCount& operator+=(const DrawCount& other);
};

class GpuScene {
 public:
  /// Keeps the scene's nodes and animations, not its geometry, which must live until `upload` is
  /// done; then the scene can be drawn. Throws Error when the GPU's memory does not suffice.
  GpuScene(const PackedScene& packed, const Look& look, Upload& upload);

  /// Once a frame, before any view is drawn: where the scene stands, which of its animations plays
  /// and where that is.
  void pose(const Mat4& world_from_scene, double animation_time_s, int clip = 0);

  std::size_t triangle_count() const { return triangle_count_; }

  /// One mesh at one node: what the renderer walks over.
  struct Draw {
    int node = 0;
    Mesh mesh;
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    SurfaceKind kind = 0;
    int group = 0;                   ///< of one node and material, all skinned or none
    std::vector<JointBox> joints{};  ///< of a skinned mesh
    // As Mesh::made_by and replaced_by, at this node.
    int made_by = -1;
    int replaced_by = -1;
  };
  /// Of all levels of detail; opaque, then masked, then blended.
  const std::vector<Draw>& draws() const { return draws_; }
  int group_count() const { return group_count_; }
  /// Around the draw's mesh as it is posed; worked out when it is asked for.
  const Box3f& bounds_in_world(const Draw& draw) const;
  /// The coarsest level of every surface.
  std::vector<const Draw*> coarsest() const;
  /// Around all that one of these stands for, full detail included.
  const Box3f& extent_in_world(const Draw& coarsest) const;
  /// Which side of a draw's triangles looks outwards; the same for all skinned draws of a node.
  enum class Facing { front, mirrored, mixed };
  Facing facing(const Draw& draw) const {
    return (draw.mesh.skinned ? skinned_facings_ : facings_)[static_cast<std::size_t>(draw.node)];
  }
  /// What a view shows, each surface at one level of detail, in the order of drawing: solid
  /// (opaque or masked) from near to far, blended from far to near. The eye decides about the
  /// level, not the tile: neighbours agree.
  struct Seen {
    std::vector<const Draw*> solid, blended;
    DrawCount count;
  };
  /// What it does not see costs nothing beyond the coarsest level.
  Seen seen_by(const View& view) const;
  /// The coarsest level of every surface of which it may see something.
  std::vector<const Draw*> coarsest_seen_by(const View& view) const;
  /// All surfaces, each at the coarsest level with at most this error.
  std::vector<const Draw*> draws_within(double error_m) const;
  /// Something is there in several levels of detail.
  bool has_levels() const { return !coarsenings_.empty(); }
  /// Another number whenever pose() has moved something; never that of another scene that lives.
  struct Stand {
    GLuint scene = 0;
    std::uint64_t moves = 0;
    bool operator==(const Stand&) const = default;
  };
  Stand stand() const { return {nodes_.name(), moves_}; }
  /// Before the draws of this scene.
  void bind() const;
  /// Before one draw: its node, its material, and those of its textures that `kind` names.
  void bind(const Draw& draw, SurfaceKind kind) const;

 private:
  void add_geometry(const PackedGeometry& geometry, Upload& upload);
  void add_colours(std::span<const Rgba8> colours, Upload& upload);
  void add_lights(std::span<const Rgba8> colours, Upload& upload);
  void add_materials(const SceneOutline& scene, Style style);
  void list_draws(const PackedScene& packed);
  void link_draws();
  void place_skinned();
  void place_coarsenings();
  std::vector<int> coarsest_within(const ViewPlanes& planes) const;
  template <class Judge, class Take>
  void walk_levels(std::span<const int> coarsest, Judge judge, Take take) const;

  SceneOutline skeleton_;  // nodes and animations
  std::size_t triangle_count_ = 0;
  std::vector<Draw> draws_;
  int group_count_ = 0;
  std::vector<int> skinned_, coarsest_;  // of the draws
  std::uint64_t coarsest_triangles_ = 0;
  struct PosedBox {
    std::uint64_t moves = 0;  // after how many it was worked out
    Box3f in_world;
  };
  mutable std::vector<PosedBox> boxes_;  // of each draw
  struct PosedCoarsening {
    int node = 0;
    Coarsening in_node;
    Box3f bounds_in_world;
    double error_m = 0;
    std::vector<int> finer{};  // the draws that it replaces
  };
  std::vector<PosedCoarsening> coarsenings_;
  struct PosedRows {
    std::uint64_t moves = 0;
    BoxRows in_world;
  };
  mutable std::optional<PosedRows> coarsest_boxes_;  // around all that each of coarsest_ stands for
  std::vector<Eigen::Matrix4f> world_from_nodes_;
  std::uint64_t moves_ = 0;
  std::vector<Facing> facings_, skinned_facings_;                    // of each node
  std::vector<std::array<TextureUse, kTextureRoles>> texture_uses_;  // of each material
  gl::Buffer vertices_, uvs_, colours_, details_, indices_;  // none where PackedGeometry has none
  gl::Buffer materials_;                                     // uniform blocks, kBlockBytes apart
  gl::Buffer nodes_;                                         // the same
  gl::VertexArray vertex_array_;
  GpuSkin skin_;
  GpuTextures textures_;
};

/// At once. Throws Error when the GPU's memory does not suffice.
GpuScene uploaded(const PackedScene& packed, const Look& look);

/// Throws Error of the scene of this name when an OpenGL call has run out of memory.
void check_gpu_memory(const std::string& name);

}  // namespace vindu
