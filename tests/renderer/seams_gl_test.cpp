// The measure: the flat wall of 28 tiles, joined, equals one picture of 7168 x 3072 pixels
// within one level, but for a share of pixels that is counted and printed.
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

struct Difference {
  double share_beyond_one_level = 0;
  double mean_levels = 0;
  int largest_levels = 0;
};

Difference difference_of(const Image& a, const Image& b) {
  Difference difference;
  std::size_t beyond = 0;
  double sum = 0;
  for (std::size_t index = 0; index < a.pixels.size(); ++index) {
    int largest = 0;
    for (int part = 0; part < 3; ++part)
      largest = std::max(largest, std::abs(int{a.pixels[index][part]} - b.pixels[index][part]));
    beyond += largest > 1;
    sum += largest;
    difference.largest_levels = std::max(difference.largest_levels, largest);
  }
  const auto count = static_cast<double>(a.pixels.size());
  difference.share_beyond_one_level = static_cast<double>(beyond) / count;
  difference.mean_levels = sum / count;
  return difference;
}

Difference joined_against_one_picture(Style style, Image (*draw)(const Wall&, Style, const Scene&,
                                                                 const FrameState&)) {
  const Wall wall = read_site(find_asset("walls/tromso.toml")).wall;
  const Wall whole = single_screen(wall.grid.width_m, wall.grid.height_m, 7168, 3072);
  Scene show = import_scene(find_asset("show/show.glb")).scene;
  cut_into_chunks(show);
  FrameState state;
  state.eye_in_wall = {0.4, 0.2, 1.5};
  state.animation_time_s = 3;
  const Image joined = draw(wall, style, show, state);
  const Image one = draw(whole, style, show, state);
  EXPECT_EQ(joined.width_px, 7168);
  EXPECT_EQ(joined.height_px, 3072);
  EXPECT_EQ(one.width_px, joined.width_px);
  EXPECT_EQ(one.height_px, joined.height_px);
  const Difference difference = difference_of(joined, one);
  std::printf("%.4f %% of the pixels differ by more than one level; mean %.5f, largest %d\n",
              100 * difference.share_beyond_one_level, difference.mean_levels,
              difference.largest_levels);
  return difference;
}

TEST_F(SeamsGl, OfTheUnlitWallAreNotToBeFoundInOnePicture) {
  const Difference difference = joined_against_one_picture(Style::unlit, &SeamsGl::drawn);
  EXPECT_LT(difference.share_beyond_one_level, 0.001);
}

TEST_F(SeamsGl, OfTheLitWallAreNotToBeFoundInOnePicture) {
  const Difference difference = joined_against_one_picture(Style::lit, &SeamsGl::drawn);
  EXPECT_LT(difference.share_beyond_one_level, 0.02);
}

}  // namespace
}  // namespace vindu
