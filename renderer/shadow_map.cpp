#include "renderer/shadow_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "renderer/draw_list.h"
#include "renderer/gl/convert.h"

namespace vindu {
namespace {

/// Rows: right and up of the map, and towards the light.
Mat3 light_from_world() {
  const Vec3 ahead = to_key_light();
  const Vec3 right = Vec3::UnitY().cross(ahead).normalized();
  Mat3 rows;
  rows << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  return rows;
}

/// Around a box, along the light's axes.
Eigen::AlignedBox3d seen_from_light(const Box3f& box) {
  const Mat3 turn = light_from_world();
  const Vec3 middle = turn * box.center().cast<double>();
  const Vec3 half = 0.5 * turn.cwiseAbs() * box.sizes().cast<double>();
  return {middle - half, middle + half};
}

/// The next of four steps in each doubling.
double in_steps(double length) { return std::exp2(std::ceil(4 * std::log2(length)) / 4); }

/// Room for the filter and for moving the corner to a whole texel.
constexpr int kMargin_px = 4;

/// Of what a caster's program must know: what moves it, and where its mask has holes.
SurfaceKind caster_kind(SurfaceKind kind) {
  constexpr SurfaceKind mask = kMasked | kSecondUv | textured(TextureRole::base_colour);
  return kind & (kind & kMasked ? mask | kSkinned : kSkinned);
}

}  // namespace

Vec3 to_key_light() { return Vec3(-0.45, 0.75, 0.55).normalized(); }

Box3f shadow_region(const Wall& wall) {
  Box3f box;
  for (const Tile& tile : wall.tiles)
    for (const Vec3& corner : {tile.corners.lower_left_in_wall, tile.corners.lower_right_in_wall,
                               tile.corners.upper_left_in_wall, tile.corners.upper_right_in_wall()})
      box.extend(corner.cast<float>());
  const float across = box.sizes().maxCoeff();
  box.extend(Eigen::Vector3f(box.min() - across * Eigen::Vector3f(0.5f, 0.5f, 2)));
  box.extend(Eigen::Vector3f(box.max() + across * Eigen::Vector3f(0.5f, 0.5f, 0.5f)));
  return box;
}

ShadowFit fit_shadow(const Box3f& receivers_in_world, const Box3f& casters_in_world, int side_px) {
  const Eigen::AlignedBox3d receivers = seen_from_light(receivers_in_world);
  const double longest = std::max({receivers.sizes().x(), receivers.sizes().y(), 1e-6});
  const double texel_m = in_steps(longest / (side_px - 2 * kMargin_px));
  const Vec3 middle = receivers.center();
  const double half_px = 0.5 * side_px;
  const double left = (std::round(middle.x() / texel_m) - half_px) * texel_m;
  const double low = (std::round(middle.y() / texel_m) - half_px) * texel_m;
  const double far = receivers.min().z() - texel_m;
  const double near = std::max(seen_from_light(casters_in_world).max().z(), far) + texel_m;
  const Vec3 scale(1 / (side_px * texel_m), 1 / (side_px * texel_m), 1 / (near - far));
  ShadowFit fit{Mat4::Identity(), texel_m};
  fit.map_from_world.topLeftCorner<3, 3>() = scale.asDiagonal() * light_from_world();
  fit.map_from_world.topRightCorner<3, 1>() = -scale.cwiseProduct(Vec3(left, low, far));
  return fit;
}

ShadowMap::ShadowMap(const Look& look)
    : side_px_(look.shadows == Shadows::soft ? 2048 : 1024),
      programs_("shadow.frag", look),
      depth_(gl::make_texture_2d()),
      framebuffer_(gl::make_framebuffer()) {
  assert(look.shadows != Shadows::none);
  const GLuint texture = depth_.name();
  glTextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, side_px_, side_px_);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(texture, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, texture, 0);
  glNamedFramebufferDrawBuffer(framebuffer_.name(), GL_NONE);
}

void ShadowMap::update(std::span<const GpuScene* const> scenes, const Box3f& region_in_world) {
  std::vector<GpuScene::Stand> stands;
  for (const GpuScene* scene : scenes) stands.push_back(scene->stand());
  if (stands == drawn_) return;
  drawn_ = std::move(stands);
  Box3f receivers, casters;
  for (const GpuScene* scene : scenes)
    for (const GpuScene::Draw* draw : scene->coarsest()) {
      if (is_lit(*draw)) receivers.extend(scene->extent_in_world(*draw));
      if (casts_shadow(*draw)) casters.extend(scene->extent_in_world(*draw));
    }
  receivers = receivers.intersection(region_in_world);
  in_use_ = !receivers.isEmpty() && !casters.isEmpty();
  if (!in_use_) return;
  fit_ = fit_shadow(receivers, casters, side_px_);
  draw(scenes);
}

void ShadowMap::draw(std::span<const GpuScene* const> scenes) const {
  Mat4 clip_from_map = Mat4::Identity();  // x and y from -1 to 1, depth as it is
  clip_from_map.diagonal().head<2>().setConstant(2);
  clip_from_map.topRightCorner<2, 1>().setConstant(-1);
  const Mat4 clip_from_world = clip_from_map * fit_.map_from_world;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, side_px_, side_px_);
  const float infinitely_far = 0;
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &infinitely_far);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  for (const GpuScene* scene : scenes) {
    std::vector<const GpuScene::Draw*> casters = scene->draws_within(largest_error_m());
    std::erase_if(casters, [](const GpuScene::Draw* draw) { return !casts_shadow(*draw); });
    scene->bind();
    for (const Batch& batch : batches_of(*scene, casters)) {
      const SurfaceKind kind = caster_kind(batch.first->kind);
      const gl::Program& program = programs_.of(kind);
      program.set("clip_from_world", gl::mat4_from(clip_from_world));
      program.use();
      scene->bind(*batch.first, kind);
      batch.draw();
    }
  }
  unbind_samplers();
  glDisable(GL_DEPTH_TEST);
}

}  // namespace vindu
