#include "renderer/scene_renderer.h"

#include <algorithm>
#include <string>
#include <vector>

#include "renderer/gl/convert.h"

namespace vindu {
namespace {

/// Nothing of the box is inside the view: it lies wholly outside one of its planes. In clip space
/// -w <= x, y <= w and z <= w are half-spaces of the world, also for points behind the eye, so the
/// test holds for any off-axis frustum. The box's farthest point along a plane's normal decides.
bool outside(const Mat4& clip_from_world, const Box3f& box) {
  const Vec3 middle = box.center().cast<double>(), half = 0.5 * box.sizes().cast<double>();
  const auto beyond = [&](const Eigen::RowVector4d& plane) {
    return plane.head<3>().dot(middle) + plane[3] + plane.head<3>().cwiseAbs().dot(half) < 0;
  };
  const Eigen::RowVector4d w = clip_from_world.row(3);
  for (const int axis : {0, 1})
    if (beyond(w + clip_from_world.row(axis)) || beyond(w - clip_from_world.row(axis))) return true;
  return beyond(w - clip_from_world.row(2));
}

/// The draws of one kind, by distance from the eye: blended ones farthest first, by their middle,
/// so that what is behind shines through; solid ones nearest first, by their nearest point, so that
/// little is drawn twice. The eye decides, not the tile: neighbours agree.
std::vector<const GpuScene::Draw*> sorted_draws(const GpuScene& scene, const Vec3& eye_in_world,
                                                bool blended) {
  std::vector<std::pair<double, const GpuScene::Draw*>> found;
  for (const GpuScene::Draw& draw : scene.draws()) {
    if ((draw.alpha_mode == AlphaMode::blend) != blended) continue;
    const Box3f& box = scene.bounds_in_world(draw);
    const Eigen::Vector3f eye = eye_in_world.cast<float>();
    found.emplace_back(blended ? -(box.center() - eye).norm() : box.exteriorDistance(eye), &draw);
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, const GpuScene::Draw*>::first);
  std::vector<const GpuScene::Draw*> sorted;
  for (const auto& [distance, draw] : found) sorted.push_back(draw);
  return sorted;
}

/// Draws of one node and material, in one call.
struct Batch {
  const GpuScene::Draw* first = nullptr;
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
};

bool alike(const GpuScene::Draw& a, const GpuScene::Draw& b) {
  return a.node == b.node && a.mesh.material == b.mesh.material;
}

/// Joins the draw to its like: to any for solid ones, only to the last for blended ones, whose
/// order matters.
void add_to_batch(const GpuScene::Draw& draw, bool keep_order, std::vector<Batch>& batches) {
  const auto begin = keep_order && !batches.empty() ? batches.end() - 1 : batches.begin();
  auto batch = std::find_if(begin, batches.end(),
                            [&](const Batch& other) { return alike(*other.first, draw); });
  if (batch == batches.end())
    batch = batches.insert(batch, {.first = &draw, .counts = {}, .offsets = {}});
  const auto offset = static_cast<std::uintptr_t>(draw.mesh.first_index) * sizeof(std::uint32_t);
  batch->counts.push_back(static_cast<GLsizei>(draw.mesh.index_count));
  batch->offsets.push_back(reinterpret_cast<const void*>(offset));
}

/// Index of the program for a surface: bit 0 textured, bit 1 unlit.
std::size_t kind_of(const GpuScene::Draw& draw) {
  return (draw.texture >= 0 ? 1u : 0u) | (draw.unlit ? 2u : 0u);
}

gl::Program scene_program(Style style, unsigned kind) {
  std::string defines = style == Style::unlit ? "#define MEASURE\n" : "";
  if (kind & 1) defines += "#define TEXTURED\n";
  if (kind & 2) defines += "#define UNLIT\n";
  return {"scene.vert", "scene.frag", defines};
}

}  // namespace

DrawCount& DrawCount::operator+=(const DrawCount& other) {
  draws += other.draws;
  culled += other.culled;
  triangles += other.triangles;
  culled_triangles += other.culled_triangles;
  return *this;
}

SceneRenderer::SceneRenderer(Style style)
    : style_(style),
      scene_programs_{scene_program(style, 0), scene_program(style, 1), scene_program(style, 2),
                      scene_program(style, 3)},
      background_program_("fullscreen.vert", "background.frag"),
      panel_program_("panel.vert", "panel.frag"),
      present_program_("fullscreen.vert", "present.frag"),
      no_vertices_(gl::make_vertex_array()) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GREATER);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

DrawCount SceneRenderer::draw(const View& view, std::span<const GpuScene* const> scenes,
                              std::span<const Panel> panels) const {
  DrawCount count;
  glEnable(GL_DEPTH_TEST);
  for (const GpuScene* scene : scenes) draw_scene(view, *scene, false, count);
  for (const Panel& panel : panels) draw_panel(view, panel);
  if (style_ == Style::lit) draw_background(view);
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  for (const GpuScene* scene : scenes) draw_scene(view, *scene, true, count);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  return count;
}

void SceneRenderer::draw_panels(const View& view, std::span<const Panel> panels) const {
  glEnable(GL_DEPTH_TEST);
  for (const Panel& panel : panels) draw_panel(view, panel);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
}

void SceneRenderer::draw_scene(const View& view, const GpuScene& scene, bool blended,
                               DrawCount& count) const {
  for (const gl::Program& program : scene_programs_) {
    program.set("clip_from_world", gl::mat4_from(view.clip_from_world));
    program.set("eye_in_world", gl::vec3_from(view.eye_in_world));
  }
  scene.bind();
  std::vector<Batch> batches;
  for (const GpuScene::Draw* draw : sorted_draws(scene, view.eye_in_world, blended)) {
    const bool culled = outside(view.clip_from_world, scene.bounds_in_world(*draw));
    const std::uint64_t triangles = draw->mesh.index_count / 3;
    count += {1, culled, triangles, culled ? triangles : 0};
    if (!culled) add_to_batch(*draw, blended, batches);
  }
  for (const Batch& batch : batches) {
    scene_programs_[kind_of(*batch.first)].use();
    scene.bind(*batch.first);
    (batch.first->double_sided ? glDisable : glEnable)(GL_CULL_FACE);
    glFrontFace(scene.mirrored(batch.first->node) ? GL_CW : GL_CCW);
    glMultiDrawElements(GL_TRIANGLES, batch.counts.data(), GL_UNSIGNED_INT, batch.offsets.data(),
                        static_cast<GLsizei>(batch.counts.size()));
  }
}

void SceneRenderer::draw_panel(const View& view, const Panel& panel) const {
  const TileCorners& corners = panel.corners_in_world;
  panel_program_.use();
  panel_program_.set("clip_from_world", gl::mat4_from(view.clip_from_world));
  panel_program_.set("lower_left_in_world", gl::vec3_from(corners.lower_left_in_wall));
  panel_program_.set("right_edge",
                     gl::vec3_from(corners.lower_right_in_wall - corners.lower_left_in_wall));
  panel_program_.set("up_edge",
                     gl::vec3_from(corners.upper_left_in_wall - corners.lower_left_in_wall));
  panel_program_.set("uv_low", glm::vec2(panel.uv_low.x(), panel.uv_low.y()));
  panel_program_.set("uv_high", glm::vec2(panel.uv_high.x(), panel.uv_high.y()));
  glBindTextureUnit(0, panel.picture->texture());
  glBindVertexArray(no_vertices_.name());
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CCW);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SceneRenderer::draw_background(const View& view) const {
  background_program_.use();
  background_program_.set("direction_from_ndc", gl::mat3_from(direction_from_ndc(view)));
  glBindVertexArray(no_vertices_.name());
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_GEQUAL);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_GREATER);
}

void SceneRenderer::present(const Picture& picture, const TileMount& mount) const {
  present_program_.use();
  present_program_.set("picture_from_display", gl::mat3_from(picture_from_display(mount)));
  glBindTextureUnit(0, picture.texture());
  glBindVertexArray(no_vertices_.name());
  (style_ == Style::lit ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Mat3 picture_from_display(const TileMount& mount) {
  // display = turn clockwise * mirror * picture, so picture = mirror * turn counter-clockwise *
  // display.
  const double angle = radians(mount.rotate_deg);
  const Mat3 back = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 mirror(mount.mirror ? -1 : 1, 1, 1);
  return mirror.asDiagonal() * back;
}

}  // namespace vindu
