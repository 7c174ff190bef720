// Test patterns as they were looked at and accepted: of one tile of the Tromsø wall, and the bar on
// a small wall of its own.
#include <gtest/gtest.h>

#include "core/site.h"
#include "renderer/pattern.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"
#include "tests/golden/compare.h"

namespace vindu {
namespace {

using testing::complaint_about;

std::string complaint_about_pattern(Pattern pattern) {
  const Wall wall = read_site(find_asset("walls/tromso.toml")).wall;
  const FrameState state{.eye_in_wall = {0.7, 0.2, 1.8}, .pattern = pattern};
  return complaint_about(*draw_pattern(state, wall, *wall.find("tile-3-1"), {320, 240}),
                         "pattern-" + std::string(name_of(pattern)));
}

TEST(PatternGolden, Grid) { EXPECT_EQ(complaint_about_pattern(Pattern::grid), ""); }
TEST(PatternGolden, Names) { EXPECT_EQ(complaint_about_pattern(Pattern::names), ""); }
TEST(PatternGolden, Seams) { EXPECT_EQ(complaint_about_pattern(Pattern::seams), ""); }
TEST(PatternGolden, Ramps) { EXPECT_EQ(complaint_about_pattern(Pattern::ramps), ""); }
TEST(PatternGolden, Eye) { EXPECT_EQ(complaint_about_pattern(Pattern::eye), ""); }

/// Two tiles beside each other, turned towards the viewer.
Wall bent_wall() {
  Wall wall = expand_wall({.columns = 2,
                           .rows = 1,
                           .width_m = 1.6,
                           .height_m = 0.6,
                           .tile_width_px = 200,
                           .tile_height_px = 150,
                           .curve_deg = 40,
                           .mount = {}},
                          {}, {});
  return wall;
}

std::string complaint_about_wall(Pattern pattern) {
  const auto surface = make_headless_surface();
  WallRenderer wall(bent_wall(), 1, Look{Style::lit});
  wall.draw({.number = 1234, .photon_time = Time{} + from_seconds(1.9), .pattern = pattern});
  return complaint_about(wall.picture().read(), "pattern-wall-" + std::string(name_of(pattern)));
}

TEST(PatternGolden, BarOnABentWall) { EXPECT_EQ(complaint_about_wall(Pattern::bar), ""); }
TEST(PatternGolden, GridOnABentWall) { EXPECT_EQ(complaint_about_wall(Pattern::grid), ""); }

}  // namespace
}  // namespace vindu
