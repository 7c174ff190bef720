// The page of figures as it was looked at and accepted, on a tile of usual size and on small ones.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/overlay_page.h"
#include "tests/golden/compare.h"

namespace vindu {
namespace {

using testing::complaint_about;

FrameParts frame(std::size_t number) {
  const double wave = std::sin(0.13 * static_cast<double>(number));
  const double spike = number == 71 ? 9 : 0;
  FrameParts parts{.durations = {}, .tracked = true};
  const std::array<double, kParts> ms = {
      6.5 + 2.5 * wave, 0.4,  0.3, number % 9 == 0 ? 1.1 : 0.1, 6.2 + 1.4 * wave * wave + spike,
      3.2 - 1.2 * wave, 0.25, 8};
  for (std::size_t part = 0; part < kParts; ++part)
    parts.durations[part] = from_seconds(1e-3 * ms[part]);
  return parts;
}

OverlayPage tile_page() {
  OverlayPage page{.title = "tile-3-0",
                   .aside = "59.9 fps",
                   .below = "tile-3-0, llvmpipe",
                   .timeline = FrameTimeline{.full_ms = 50},
                   .rows = {{"", {"p50", "p99", "max"}},
                            {"motion to photon, ms", {"26.1", "30.4", "34.9"}},
                            {"GPU", {"5.8 ms"}},
                            {"triangles", {"412 k"}},
                            {"culled", {"78 %"}},
                            {"memory", {"182 MB"}}}};
  page.timeline->mean_ms = {6.5, 0.4, 0.3, 0.2, 6.9, 3.2, 0.3, 8};
  for (std::size_t number = 0; number < 165; ++number) page.timeline->add(frame(number));
  return page;
}

OverlayPage wall_page() {
  return {.text_px = text_px_for(992),
          .title = "wall",
          .aside = "59.9 fps",
          .below = "tile-1-0: admitted at frame 641",
          .timeline = {},
          .rows = {{"", {"p50", "p99", "max"}},
                   {"skew of swaps, ms", {"0.21", "0.41", "2.72"}},
                   {"motion to photon, ms", {"26.3", "31.0", "52.4"}},
                   {"eye", {"six-dof"}},
                   {"tiles in the lock", {"28 of 28"}},
                   {"evicted", {"3"}},
                   {"restarted", {"1"}}}};
}

Image picture_of(const OverlayPage& page, SizePx room) {
  return draw_page(page, layout_of(page, room));
}

TEST(OverlayGolden, OfATile) {
  EXPECT_EQ(complaint_about(picture_of(tile_page(), {992, 736}), "overlay-tile"), "");
}
TEST(OverlayGolden, OfTheWall) {
  EXPECT_EQ(complaint_about(picture_of(wall_page(), {580, 736}), "overlay-wall"), "");
}
TEST(OverlayGolden, OfAQuarterOfATile) {
  EXPECT_EQ(complaint_about(picture_of(tile_page(), {248, 184}), "overlay-quarter"), "");
}
TEST(OverlayGolden, OfATenthOfATile) {
  EXPECT_EQ(complaint_about(picture_of(tile_page(), {100, 75}), "overlay-tenth"), "");
}

}  // namespace
}  // namespace vindu
