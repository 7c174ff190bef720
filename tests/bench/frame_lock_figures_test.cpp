// What the frame lock's bench makes of the times that tiles had a frame ready and swapped to it.
#include <gmock/gmock.h>

#include "bench/frame_lock/figures.h"

namespace vindu {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Of two tiles that the master waited for.
FrameMarks two_tiles(const TileMark& first, const TileMark& second) {
  return {.locked = 2, .tiles = {first, second}};
}

TEST(FrameLockFigures, SkewIsFirstToLastSwapAndCostIsLastReadyToLastSwap) {
  LockFigures figures;
  figures.add(two_tiles({.ready_ns = 1'000, .swapped_ns = 14'000},
                        {.ready_ns = 9'000, .swapped_ns = 11'500}));
  EXPECT_THAT(figures.skew_us, ElementsAre(DoubleEq(2.5)));
  EXPECT_THAT(figures.cost_us, ElementsAre(DoubleEq(5.0)));
  EXPECT_EQ(figures.early, 0u);
}

TEST(FrameLockFigures, ASwapBeforeAllTilesWereReadyIsEarly) {
  LockFigures figures;
  figures.add(two_tiles({.ready_ns = 1'000, .swapped_ns = 8'999},
                        {.ready_ns = 9'000, .swapped_ns = 11'500}));
  EXPECT_EQ(figures.early, 1u);
}

TEST(FrameLockFigures, AFrameThatATileDidNotShowHasNoSkew) {
  LockFigures figures;
  figures.add(two_tiles({.ready_ns = 1'000, .swapped_ns = 10'000}, {.ready_ns = 9'000}));
  EXPECT_THAT(figures.skew_us, IsEmpty());
  EXPECT_EQ(figures.frames, 1u);
}

TEST(FrameLockFigures, AFrameThatDidNotWaitForATileIsNotWholeAndNotEarly) {
  FrameMarks frame = two_tiles({.ready_ns = 1'000, .swapped_ns = 60'000},
                               {.ready_ns = 90'000, .swapped_ns = 95'000});
  frame.locked = 1;
  LockFigures figures;
  figures.add(frame);
  EXPECT_FALSE(whole(frame));
  EXPECT_THAT(figures.skew_us, IsEmpty());
  EXPECT_EQ(figures.early, 0u);
}

}  // namespace
}  // namespace vindu
