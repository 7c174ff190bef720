// The measure of a wall: the flat wall of 28 tiles, joined, equals one picture of 7168 x 3072
// pixels within one level, but for a share of pixels that is counted and printed.
#include <cstdio>
#include <fstream>
#include <string>

#include "core/site.h"
#include "renderer/chunks.h"
#include "renderer/import.h"
#include "renderer/resources.h"
#include "renderer/wall_renderer.h"
#include "tests/renderer/gl_test.h"

namespace vindu {
namespace {

using namespace testing;

class SeamsGl : public GlTest {
 protected:
  static Image drawn(const Wall& wall, Style style, const Scene& scene, const FrameState& state) {
    WallRenderer renderer(wall, 1, Look{style});
    renderer.show(pack(scene));
    renderer.draw(state);
    return renderer.picture().read();
  }
};

constexpr SizePx kTile_px{1024, 768}, kWall_px{7 * 1024, 4 * 768};

/// Within 2 pixels of where two tiles meet, along one axis.
bool near_a_seam(int at_px, int tile_px, int wall_px) {
  return (at_px + 2) % tile_px < 4 && at_px >= 2 && at_px < wall_px - 2;
}

/// Pixels that differ by more than one level in any colour.
struct Difference {
  double share = 0;           ///< of the whole wall
  double share_at_seams = 0;  ///< of the pixels at the seams
  int largest_levels = 0;
};

Difference difference_of(const Image& a, const Image& b) {
  Difference difference;
  int beyond = 0, beyond_at_seams = 0, at_seams = 0;
  for (int y = 0; y < a.height_px; ++y)
    for (int x = 0; x < a.width_px; ++x) {
      int largest = 0;
      for (int part = 0; part < 3; ++part)
        largest = std::max(largest, std::abs(int{a.at(x, y)[part]} - b.at(x, y)[part]));
      const bool seam = near_a_seam(x, kTile_px.width, kWall_px.width) ||
                        near_a_seam(y, kTile_px.height, kWall_px.height);
      at_seams += seam;
      beyond += largest > 1;
      beyond_at_seams += seam && largest > 1;
      difference.largest_levels = std::max(difference.largest_levels, largest);
    }
  difference.share = beyond / static_cast<double>(a.pixels.size());
  difference.share_at_seams = beyond_at_seams / static_cast<double>(at_seams);
  return difference;
}

Difference joined_against_one_picture(Style style, Image (*draw)(const Wall&, Style, const Scene&,
                                                                 const FrameState&)) {
  const Wall wall = read_site(find_asset("walls/tromso.toml")).wall;
  const Wall whole =
      single_screen(wall.grid.width_m, wall.grid.height_m, kWall_px.width, kWall_px.height);
  Scene show = import_scene(find_asset("show/show.glb")).scene;
  cut_into_chunks(show);
  FrameState state;
  state.eye_in_wall = {0.4, 0.2, 1.5};
  state.animation_time_s = 3;
  const Image joined = draw(wall, style, show, state);
  const Image one = draw(whole, style, show, state);
  for (const Image* picture : {&joined, &one})
    EXPECT_EQ((SizePx{picture->width_px, picture->height_px}), kWall_px);
  const Difference difference = difference_of(joined, one);
  std::printf(
      "%.4f %% of the pixels differ by more than one level, %.4f %% of those at seams; largest "
      "%d\n",
      100 * difference.share, 100 * difference.share_at_seams, difference.largest_levels);
  return difference;
}

// A wrong column of pixels along every seam would be 0.18 % of the wall.

TEST_F(SeamsGl, OfTheUnlitWallAreNotToBeFoundInOnePicture) {
  const Difference difference = joined_against_one_picture(Style::unlit, &SeamsGl::drawn);
  EXPECT_LT(difference.share, 0.00002);
  EXPECT_LT(difference.share_at_seams, 0.001);
}

TEST_F(SeamsGl, OfTheLitWallAreNotToBeFoundInOnePicture) {
  const Difference difference = joined_against_one_picture(Style::lit, &SeamsGl::drawn);
  EXPECT_LT(difference.share, 0.0001);
  EXPECT_LT(difference.share_at_seams, 0.001);
}

}  // namespace
}  // namespace vindu
