// The patterns that the CPU draws: what stands where on the wall is reckoned here from the wall
// file's numbers, not from the code that draws.
#include "renderer/pattern.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/pattern_lines.h"
#include "renderer/pattern_pages.h"
#include "renderer/text.h"

namespace vindu {
namespace {

constexpr SizePx kSize{512, 384};

Wall wall_of(double bezel_mm = 0, double curve_deg = 0) {
  return expand_wall({.columns = 7,
                      .rows = 4,
                      .width_m = 5.185,
                      .height_m = 2.238,
                      .tile_width_px = 1024,
                      .tile_height_px = 768,
                      .bezel_x_mm = bezel_mm,
                      .bezel_y_mm = bezel_mm,
                      .curve_deg = curve_deg,
                      .mount = {}},
                     {}, {});
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
  return values[values.size() / 2];
}

/// Middle of what is brighter than black around a column, in most rows: pixels from the left edge.
double line_near(const Image& image, double column_px) {
  std::vector<double> middles;
  for (int y = 0; y < image.height_px; ++y) {
    double sum = 0, weighted = 0;
    for (int x = std::max(static_cast<int>(column_px) - 4, 1);
         x <= std::min(static_cast<int>(column_px) + 4, image.width_px - 2); ++x) {
      sum += image.at(x, y)[0];
      weighted += image.at(x, y)[0] * (x + 0.5);
    }
    if (sum > 0) middles.push_back(weighted / sum);
  }
  return median(middles);
}

class Grids : public ::testing::TestWithParam<double> {};

// A curved wall's tile meets the plane x = const where its lower edge does.
TEST_P(Grids, HaveTheirLinesAtTheMetresOfTheWall) {
  const Wall wall = wall_of(20, GetParam());
  int found = 0;
  for (const char* name : {"tile-0-0", "tile-3-1", "tile-5-3"}) {
    const Tile& tile = *wall.find(name);
    const Image image = draw_grid(wall, tile, kSize);
    const double left_m = tile.corners.lower_left_in_wall.x(),
                 right_m = tile.corners.lower_right_in_wall.x();
    for (int tenth = -30; tenth <= 30; ++tenth) {
      if (tenth == 0) continue;  // the red one
      const double column_px = (0.1 * tenth - left_m) / (right_m - left_m) * kSize.width;
      if (column_px < 6 || column_px > kSize.width - 6) continue;
      if (std::abs(column_px - kSize.width / 2.0) < 8) continue;  // the green cross
      EXPECT_NEAR(line_near(image, column_px), column_px, 0.05) << name << ", " << tenth;
      ++found;
    }
  }
  EXPECT_GT(found, 12);
}
INSTANTIATE_TEST_SUITE_P(Of, Grids, ::testing::Values(0.0, 60.0));

TEST(GridPattern, HasTheOutermostPixelsOfTheTileAndNoOthersInItsColour) {
  const Wall wall = wall_of();
  const Image image = draw_grid(wall, wall.tiles[8], kSize);
  const Rgba8 green{0, 255, 0, 255};
  for (int x = 0; x < kSize.width; ++x) {
    ASSERT_EQ(image.at(x, 0), green);
    ASSERT_EQ(image.at(x, kSize.height - 1), green);
    ASSERT_NE(image.at(x, 1), x == 0 || x == kSize.width - 1 ? Rgba8{} : green);
  }
  for (int y = 0; y < kSize.height; ++y) {
    ASSERT_EQ(image.at(0, y), green);
    ASSERT_EQ(image.at(kSize.width - 1, y), green);
  }
  EXPECT_EQ(image.at(kSize.width / 2, kSize.height / 2), green);
  EXPECT_EQ(image.at(kSize.width / 2 - 1, kSize.height / 2 - 1), green);
}

TEST(GridPattern, TakesCoarserLinesOnALargerWallAndFinerOnesOnASmallOne) {
  EXPECT_DOUBLE_EQ(grid_step_m(wall_of()), 0.1);
  EXPECT_DOUBLE_EQ(grid_step_m(single_screen(200, 50, 100, 100)), 1);
  EXPECT_DOUBLE_EQ(grid_step_m(single_screen(0.3, 0.2, 100, 100)), 0.01);
}

/// Rows' middle of the broad blue line in a column, for each line that is whole there; pixels from
/// the upper edge.
std::vector<double> blue_lines_in(const Image& image, int column) {
  std::vector<double> rows;
  double sum = 0, weighted = 0;
  for (int y = 0; y <= image.height_px; ++y) {
    const Rgba8 pixel = y < image.height_px ? image.at(column, y) : Rgba8{};
    const double weight = std::max(0, pixel[2] - pixel[0]);
    sum += weight;
    weighted += weight * (y + 0.5);
    if (weight > 0) continue;
    if (sum > 147 * 8.8 && sum < 147 * 9.3) rows.push_back(weighted / sum);
    sum = weighted = 0;
  }
  return rows;
}

class Seams : public ::testing::TestWithParam<double> {};

// Whichever tile it is on, the line is y = x / 12 + a multiple of half a tile's height: so is its
// other part behind the seam. A column that a white or orange line crosses there is left out.
TEST_P(Seams, LieOnOneLineOverAllTiles) {
  const Wall wall = wall_of(GetParam());
  const double step_m = 2.238 / 4 / 2 / std::cos(std::atan(1.0 / 12));
  for (const char* name : {"tile-2-1", "tile-3-1", "tile-3-2", "tile-6-3"}) {
    const TileCorners& corners = wall.find(name)->corners;
    const Image image = draw_seams(wall, *wall.find(name), kSize);
    const double px_m = corners.height_m() / kSize.height;
    int found = 0;
    for (const int column : {0, 1, 2, 3, 100, 200, 300, 508, 509, 510, 511})
      for (const double row : blue_lines_in(image, column)) {
        const double x_m =
            corners.lower_left_in_wall.x() + (column + 0.5) / kSize.width * corners.width_m();
        const double y_m = corners.upper_left_in_wall.y() - row * px_m;
        const double off_m = std::remainder(y_m - x_m / 12, step_m);
        EXPECT_NEAR(off_m / px_m, 0, 0.2) << name << ", " << column << ", " << row;
        ++found;
      }
    EXPECT_GT(found, 6) << name;
  }
}
INSTANTIATE_TEST_SUITE_P(Of, Seams, ::testing::Values(0.0, 20.0));

/// The part of the picture that words drawn there would cover is those words.
bool says(const Image& image, const std::string& words, const TextStyle& style, Rgba8 ground) {
  const int width = text_width_px(words, style), height = static_cast<int>(style.height_px);
  Image alone = Image::filled(width, height, ground);
  draw_text(alone, 0, 0, words, style);
  for (int y = 0; y + height <= image.height_px; ++y)
    for (int x = 0; x + width <= image.width_px; ++x) {
      bool same = true;
      for (int row = 0; row < height && same; ++row)
        same = std::equal(&alone.at(0, row), &alone.at(0, row) + width, &image.at(x, y + row));
      if (same) return true;
    }
  return false;
}

TEST(NamesPattern, SaysWhoTheTileIsAndHowItHangs) {
  Wall wall = wall_of();
  Tile& tile = wall.tiles[9];
  tile.host = "node9";
  tile.mount = {.mirror = false, .rotate_deg = 180};
  const Image image = draw_names(tile, kSize);
  const Rgba8 ground = image.at(20, 200);
  EXPECT_TRUE(says(image, "tile-2-1",
                   {.height_px = 0.26 * 384, .colour = {255, 255, 255, 255}, .bold = true},
                   ground));
  const TextStyle small{.height_px = 0.07 * 384, .colour = {200, 205, 212, 255}};
  EXPECT_TRUE(says(image, "host node9", small, ground));
  EXPECT_TRUE(says(image, "1024 x 768 px, 0.741 x 0.559 m", small, ground));
  EXPECT_TRUE(says(image, "mount: turned 180 degrees clockwise", small, ground));
  EXPECT_FALSE(says(image, "mount: turned 90 degrees clockwise", small, ground));
}

TEST(NamesPattern, SaysHowADisplayIsFed) {
  EXPECT_EQ(text_of(TileMount{}), "as it is");
  EXPECT_EQ(text_of({.mirror = true, .rotate_deg = 0}), "mirrored");
  EXPECT_EQ(text_of({.mirror = true, .rotate_deg = 90}), "mirrored, turned 90 degrees clockwise");
}

TEST(NamesPattern, PointsUpWhereTheWallsUpIs) {
  // A tile on its side: its picture's left edge is the wall's lower one.
  Tile tile{.name = "tile-0-0",
            .host = "a",
            .width_px = 100,
            .height_px = 100,
            .corners = {},
            .mount = {}};
  tile.corners = {{-1, 1, 0}, {-1, -1, 0}, {1, 1, 0}};
  const Image image = draw_names(tile, kSize);
  double blue_left = 0, blue_right = 0;  // of the arrow: its head is broad
  for (int y = 0; y < kSize.height / 3; ++y)
    for (int x = 200; x < 312; ++x)
      (x < 256 ? blue_left : blue_right) += std::max(0, image.at(x, y)[2] - image.at(x, y)[0]);
  EXPECT_GT(blue_left, 1.2 * blue_right);
}

TEST(RampsPattern, HasTheLevelsThatItNames) {
  const Image image = draw_ramps(kSize);
  for (int row = 0; row < 6; ++row)
    for (int step = 0; step < 16; ++step) {
      const int level = row < 4 ? 17 * step : row == 4 ? step : 240 + step;
      Rgba8 wanted{0, 0, 0, 255};
      for (int part = 0; part < 3; ++part)
        if (row == 0 || row > 3 || row == part + 1)
          wanted[static_cast<std::size_t>(part)] = static_cast<std::uint8_t>(level);
      EXPECT_EQ(image.at(step * 32 + 16, row * 64 + 5), wanted) << row << ", " << step;
    }
}

FrameState seen_from(const Vec3& eye_in_wall) {
  return {.eye_in_wall = eye_in_wall, .pattern = Pattern::eye};
}

/// The middle of the orange disc on one half of the page.
Vec2 eye_px(const Vec3& eye_in_wall, bool right_half) {
  const Wall wall = wall_of();
  const Image image = draw_eye(seen_from(eye_in_wall), wall, wall.tiles[10], kSize);
  Vec2 sum = Vec2::Zero();
  double count = 0;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = right_half ? 256 : 0; x < (right_half ? 512 : 256); ++x)
      if (image.at(x, y) == Rgba8{230, 159, 0, 255}) {
        sum += Vec2(x + 0.5, y + 0.5);
        ++count;
      }
  return sum / count;
}

TEST(EyePattern, MovesTheEyeAsItMovesToOneScaleInBothDrawings) {
  const Vec3 eye(0, 0.1, 2);
  const double step_px = eye_px(eye + Vec3(1, 0, 0), false).x() - eye_px(eye, false).x();
  EXPECT_GT(step_px, 25);
  EXPECT_NEAR(eye_px(eye + Vec3(2, 0, 0), false).x() - eye_px(eye, false).x(), 2 * step_px, 1);
  EXPECT_NEAR(eye_px(eye + Vec3(0, 0, 1), false).y() - eye_px(eye, false).y(), step_px, 1);
  EXPECT_NEAR(eye_px(eye + Vec3(0, 0, 1), true).x() - eye_px(eye, true).x(), step_px, 1);
  EXPECT_NEAR(eye_px(eye + Vec3(0, 1, 0), true).y() - eye_px(eye, true).y(), -step_px, 1);
}

TEST(EyePattern, IsDrawnForAnyEye) {
  const Wall wall = wall_of();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Vec3& eye : {Vec3(0, 0, 0), Vec3(0, 0, -1), Vec3(1e9, -1e9, 1e9), Vec3(-1e9, 0, 1e-9),
                          Vec3(std::nan(""), 0, 1), Vec3(0, infinite, 1)})
    EXPECT_EQ(draw_eye(seen_from(eye), wall, wall.tiles[10], {320, 200}).width_px, 320);
}

TEST(Patterns, AreDrawnAtAnySizeOnAnyTile) {
  Wall wall = wall_of();
  wall.tiles[0].corners = {{-1, -1, 3}, {-1, -1, 0}, {-1, 1, 3}};  // a side wall
  wall.tiles[1].corners = {{-1, -1, 3}, {1, -1, 3}, {-1, -1, 0}};  // a floor
  for (const Pattern pattern : kPatterns)
    for (const SizePx size : {SizePx{1, 1}, {3, 2}, {51, 38}, {200, 700}})
      for (const std::size_t tile : {0u, 1u, 5u}) {
        const auto image = draw_pattern({.pattern = pattern}, wall, wall.tiles[tile], size);
        if (image) {
          EXPECT_EQ(image->width_px, size.width) << name_of(pattern);
        }
      }
}

TEST(Patterns, HaveNamesThatComeBack) {
  for (const Pattern pattern : kPatterns) EXPECT_EQ(pattern_from(name_of(pattern)), pattern);
  EXPECT_FALSE(pattern_from("no-such"));
  EXPECT_FALSE(pattern_from(""));
}

}  // namespace
}  // namespace vindu
