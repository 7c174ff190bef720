// Patterns and blanking as a wall draws them: instead of the scene, or over it, on all tiles.
#include <cmath>

#include "renderer/frame_counter.h"
#include "renderer/wall_renderer.h"
#include "tests/renderer/gl_test.h"
#include "tests/renderer/test_scenes.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::Each;

class PatternGl : public GlTest {};

Wall wall_of(double bezel_mm = 0) {
  return expand_wall({.columns = 3,
                      .rows = 2,
                      .width_m = 3 + 2e-3 * bezel_mm,
                      .height_m = 1.5 + 1e-3 * bezel_mm,
                      .tile_width_px = 200,
                      .tile_height_px = 150,
                      .bezel_x_mm = bezel_mm,
                      .bezel_y_mm = bezel_mm,
                      .mount = {}},
                     {}, {});
}

FrameState state_of(Pattern pattern, double photon_s = 0) {
  return {.number = 4711, .photon_time = Time{} + from_seconds(photon_s), .pattern = pattern};
}

Image drawn(const Wall& wall, const FrameState& state, Style style = Style::unlit) {
  WallRenderer renderer(wall, 1, Look{style});
  renderer.draw(state);
  return renderer.picture().read();
}

/// Middle of what is white in a row, pixels from the left.
double white_in_row(const Image& image, int row) {
  double sum = 0, weighted = 0;
  for (int x = 0; x < image.width_px; ++x) {
    const double weight = image.at(x, row)[0];  // the level bar has less red
    sum += weight;
    weighted += weight * (x + 0.5);
  }
  return weighted / sum;
}

TEST_F(PatternGl, BarStandsWhereItsFormulaSays) {
  const double bezel_m = 0.05;
  const Wall wall = wall_of(1e3 * bezel_m);
  // A second is a quarter of the way. Rows without the level bar and the tiles' numbers.
  for (const double photon_s : {0.5, 2.1, 3.4, 400002.1}) {
    const Image image = drawn(wall, state_of(Pattern::bar, photon_s));
    const double across_m = std::fmod(photon_s, 4) / 4 * (3 + 2 * bezel_m);  // from the left
    const int tile = static_cast<int>(across_m / (1 + bezel_m));
    const double column_px = 210 * tile + 200 * (across_m - tile * (1 + bezel_m));
    for (const int row : {65, 80, 200, 240})
      EXPECT_NEAR(white_in_row(image, row), column_px, 0.1) << photon_s << " s, row " << row;
  }
}

TEST_F(PatternGl, BarMovesUpAsWell) {
  const Wall wall = wall_of();
  for (const double photon_s : {1.0, 3.0}) {
    const Image image = drawn(wall, state_of(Pattern::bar, photon_s));
    const int wanted = static_cast<int>(300 - photon_s / 4 * 300);
    EXPECT_GT(image.at(100, wanted)[2], 200);
    EXPECT_EQ(image.at(100, wanted - 20)[2], 0);
    EXPECT_EQ(image.at(100, wanted + 20)[2], 0);
  }
}

TEST_F(PatternGl, BarGoesOnEvenlyAndBeginsAnew) {
  const Vec2 ends(-1.5, 1.5);
  const auto at = [&](double photon_s) { return bar_at_m(Time{} + from_seconds(photon_s), ends); };
  EXPECT_DOUBLE_EQ(at(0), -1.5);
  EXPECT_NEAR(at(1.25) - at(1), 0.25 * 3 / 4, 1e-9);
  EXPECT_NEAR(at(4e6 + 3) - at(4e6 + 2), 3.0 / 4, 1e-6);
  EXPECT_NEAR(at(4.5), at(0.5), 1e-9);
  EXPECT_NEAR(at(-0.5), at(3.5), 1e-9);
}

TEST_F(PatternGl, NumberIsReadBackFromEveryTileOfBarAndCounterAndNoOther) {
  for (const Pattern pattern : kPatterns) {
    WallRenderer wall(wall_of(), 1, Look{Style::lit});
    wall.draw(state_of(pattern, 1.7));
    const bool numbered = pattern == Pattern::bar || pattern == Pattern::counter;
    for (std::size_t tile = 0; tile < 6; ++tile)
      EXPECT_EQ(read_frame_counter(wall.read_tile(tile)),
                numbered ? std::optional<std::uint64_t>(4711) : std::nullopt)
          << name_of(pattern) << ", " << tile;
  }
}

// Along every seam, lines go over from tile to tile: what is lit on one side is lit on the other.
TEST_F(PatternGl, SeamsGoOnBehindTheEdgesOfTiles) {
  const Image image = drawn(wall_of(), state_of(Pattern::seams));
  int lit = 0;
  for (const int seam : {200, 400})
    for (int y = 0; y < 300; ++y) {
      const int left = image.at(seam - 1, y)[2], right = image.at(seam, y)[2];
      // A pixel further a broad line is 1/12 of a pixel higher: 20 levels; a thin one is left out.
      const bool thin = image.at(seam - 1, y)[0] > 100 || image.at(seam, y)[0] > 100;
      if (left > 100 && !thin && y > 0 && y < 299) {
        EXPECT_GT(right, 60) << seam << ", " << y;
        ++lit;
      }
    }
  EXPECT_GT(lit, 20);
}

TEST_F(PatternGl, ATileAloneShowsItsPartOfTheWholeWall) {
  const Wall whole = wall_of(30);
  Wall part = whole;
  part.tiles = {whole.tiles[4]};
  for (const Pattern pattern : {Pattern::grid, Pattern::seams, Pattern::bar, Pattern::eye}) {
    WallRenderer all(whole, 1, Look{Style::lit}), one(part, 1, Look{Style::lit}, whole);
    all.draw(state_of(pattern, 2));
    one.draw(state_of(pattern, 2));
    EXPECT_EQ(one.read_tile(0), all.read_tile(4)) << name_of(pattern);
  }
}

TEST_F(PatternGl, PicturesAreTheBytesThatWereDrawn) {
  const Wall wall = wall_of();
  for (const Style style : {Style::lit, Style::unlit}) {
    WallRenderer renderer(wall, 1, Look{style});
    const FrameState state = state_of(Pattern::ramps);
    renderer.draw(state);
    EXPECT_EQ(renderer.read_tile(2), draw_pattern(state, wall, wall.tiles[2], {200, 150}));
  }
}

TEST_F(PatternGl, FollowOneAnotherAndTheMovingEye) {
  WallRenderer wall(wall_of(), 1, Look{Style::lit});
  const auto shown = [&](const FrameState& state) {
    wall.draw(state);
    return wall.picture().read();
  };
  const Image grid = shown(state_of(Pattern::grid));
  FrameState eye = state_of(Pattern::eye);
  const Image here = shown(eye);
  eye.eye_in_wall.x() += 0.5;
  EXPECT_NE(shown(eye), here);
  EXPECT_EQ(shown(state_of(Pattern::grid)), grid);
  EXPECT_NE(here, grid);
}

TEST_F(PatternGl, CounterStandsOverTheModelAndOtherPatternsInItsPlace) {
  WallRenderer wall(wall_of(), 1, Look{Style::unlit});
  wall.show(pack(square_scene(plain(1, 0, 0), scaled_by(5, 5, 1))));
  const WallFrame frame = wall.draw(state_of(Pattern::counter));
  EXPECT_GT(frame.count.draws, 0);
  EXPECT_EQ(wall.read_tile(3).at(150, 20), kRed);
  EXPECT_EQ(wall.draw(state_of(Pattern::grid)).count.draws, 0);
  EXPECT_NE(wall.read_tile(3).at(150, 20), kRed);
  wall.draw(state_of(Pattern::none));
  EXPECT_THAT(wall.picture().read().pixels, Each(kRed));
}

TEST_F(PatternGl, BlankIsBlackWhateverIsShownAndGoesAway) {
  for (const Pattern pattern : kPatterns) {
    WallRenderer wall(wall_of(), 1, Look{Style::lit});
    wall.show(pack(square_scene(plain(1, 1, 1), scaled_by(5, 5, 1))));
    FrameState state = state_of(pattern);
    wall.draw(state);
    const Image before = wall.picture().read();
    state.blank = true;
    EXPECT_EQ(wall.draw(state).count.draws, 0);
    EXPECT_THAT(wall.picture().read().pixels, Each(kBlack)) << name_of(pattern);
    state.blank = false;
    wall.draw(state);
    EXPECT_EQ(wall.picture().read(), before) << name_of(pattern);
  }
}

}  // namespace
}  // namespace vindu
