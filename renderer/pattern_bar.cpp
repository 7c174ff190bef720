#include "renderer/pattern_bar.h"

#include <algorithm>
#include <cmath>

#include "renderer/gl/convert.h"

namespace vindu {

double bar_at_m(Time photon_time, const Vec2& ends_m) {
  const double turns = seconds(photon_time.time_since_epoch()) / kBarCrossing_s;
  return ends_m[0] + (turns - std::floor(turns)) * (ends_m[1] - ends_m[0]);
}

BarPainter::BarPainter(const Wall& whole)
    : ends_m_{extent_of(whole, 0), extent_of(whole, 1), extent_of(whole, 2)},
      half_width_m_(0.01 * std::max(whole.grid.width_m, whole.grid.height_m)),
      program_("fullscreen.vert", "pattern_bar.frag"),
      no_vertices_(gl::make_vertex_array()) {}

void BarPainter::draw(Time photon_time, const Tile& tile, const RectPx& place,
                      const Picture& picture) const {
  const TileSurface surface = surface_of(tile.corners, place.size);
  // From the display's -1 to 1, y up, to pixels from the upper left.
  Mat3 px_from_ndc = Mat3::Identity();
  px_from_ndc.row(0) << 0.5 * place.size.width, 0, 0.5 * place.size.width;
  px_from_ndc.row(1) << 0, -0.5 * place.size.height, 0.5 * place.size.height;
  Mat3 off_px = Mat3::Zero();  // rows: from the upright, from the level bar
  Vec2 half_px;
  for (int i = 0; i < 2; ++i) {
    const double px_m = surface.metres_a_px(Vec2::Unit(i));
    off_px.row(i) = surface.metres_from_px.row(i) * px_from_ndc;
    off_px(i, 2) -= bar_at_m(photon_time, ends_m_[i == 0 ? surface.across : surface.up]);
    off_px.row(i) /= px_m;
    half_px[i] = std::max(half_width_m_ / px_m, 0.5);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
  glViewport(place.x, place.y, place.size.width, place.size.height);
  glDisable(GL_FRAMEBUFFER_SRGB);  // the bytes as they are
  program_.use();
  program_.set("off_px_from_ndc", gl::mat3_from(off_px));
  program_.set("half_px", glm::vec2(half_px.x(), half_px.y()));
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace vindu
