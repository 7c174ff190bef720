#include "renderer/scene_renderer.h"

#include <optional>

#include "renderer/gl/convert.h"

namespace vindu {

SceneRenderer::SceneRenderer(const Look& look)
    : look_(look),
      scene_programs_("scene.frag", look),
      background_program_("fullscreen.vert", "background.frag"),
      panel_program_("panel.vert", "panel.frag"),
      present_program_("fullscreen.vert", "present.frag"),
      no_vertices_(gl::make_vertex_array()) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GREATER);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

DrawCount SceneRenderer::draw(const View& view, std::span<const GpuScene* const> scenes,
                              std::span<const Panel> panels, const ShadowMap* shadow) const {
  DrawCount count;
  if (shadow) glBindTextureUnit(kShadowUnit, shadow->texture());
  glEnable(GL_DEPTH_TEST);
  std::vector<GpuScene::Seen> seen;
  for (const GpuScene* scene : scenes) count += seen.emplace_back(scene->seen_by(view)).count;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    draw_scene({view, shadow, false}, *scenes[i], seen[i].solid);
  for (const Panel& panel : panels) draw_panel(view, panel);
  if (style() == Style::lit) draw_background(view);
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    draw_scene({view, shadow, true}, *scenes[i], seen[i].blended);
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

SurfaceKind SceneRenderer::kind_drawn(const GpuScene::Draw& draw, const ShadowMap* shadow) const {
  if (style() == Style::unlit) return draw.kind & kMeasured;
  return is_lit(draw) && shadow && shadow->in_use() ? draw.kind | kShadowed : draw.kind;
}

void SceneRenderer::prepare(const GpuScene& scene, const ShadowMap* shadow) const {
  for (const GpuScene::Draw& draw : scene.draws()) scene_programs_.of(kind_drawn(draw, shadow));
}

void SceneRenderer::use_program(const Pass& pass, const GpuScene& scene, SurfaceKind kind) const {
  const gl::Program& program = scene_programs_.of(kind);
  program.set("clip_from_world", gl::mat4_from(pass.view.clip_from_world));
  program.set("eye_in_world", gl::vec3_from(pass.view.eye_in_world));
  program.set("to_key", gl::vec3_from(to_key_light()));
  if (kind & kShadowed) {
    program.set("map_from_world", gl::mat4_from(pass.shadow->fit().map_from_world));
    program.set("shadow_texel_m", static_cast<float>(pass.shadow->fit().texel_m));
    const double here_m = scene.has_levels() ? pass.shadow->largest_error_m() : 0;
    const double per_m = scene.has_levels() ? largest_error_per_m(pass.view.detail) : 0;
    program.set("level_error_m", glm::vec2(here_m, per_m));
  }
  program.use();
}

void SceneRenderer::draw_scene(const Pass& pass, const GpuScene& scene,
                               std::span<const GpuScene::Draw* const> draws) const {
  scene.bind();
  std::optional<SurfaceKind> in_use;
  for (const Batch& batch : batches_of(scene, draws, pass.blended)) {
    const GpuScene::Draw& draw = *batch.first;
    const SurfaceKind kind = kind_drawn(draw, pass.shadow);
    if (in_use != kind) use_program(pass, scene, kind);
    in_use = kind;
    scene.bind(draw, kind);
    const GpuScene::Facing facing = scene.facing(draw);
    const bool both_sides = draw.double_sided || facing == GpuScene::Facing::mixed;
    glFrontFace(facing == GpuScene::Facing::mirrored ? GL_CW : GL_CCW);
    (both_sides && !pass.blended ? glDisable : glEnable)(GL_CULL_FACE);
    if (both_sides && pass.blended) {  // the far side shines through the near one
      glCullFace(GL_FRONT);
      batch.draw();
      glCullFace(GL_BACK);
    }
    batch.draw();
  }
  unbind_samplers();
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
  present(picture, mount, {0, 0, picture.size()});
}

void SceneRenderer::present(const Picture& picture, const TileMount& mount,
                            const RectPx& part) const {
  present_program_.use();
  present_program_.set("picture_from_display", gl::mat3_from(whole_from_part(part, picture.size()) *
                                                             picture_from_display(mount)));
  glBindTextureUnit(0, picture.texture());
  glBindVertexArray(no_vertices_.name());
  (style() == Style::lit ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Mat3 whole_from_part(const RectPx& part, SizePx whole) {
  const Vec2 scale(1.0 * part.size.width / whole.width, 1.0 * part.size.height / whole.height);
  Mat3 matrix = Vec3(scale.x(), scale.y(), 1).asDiagonal();
  matrix(0, 2) = 2.0 * part.x / whole.width + scale.x() - 1;
  matrix(1, 2) = 2.0 * part.y / whole.height + scale.y() - 1;
  return matrix;
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
