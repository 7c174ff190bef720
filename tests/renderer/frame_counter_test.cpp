// The frame counter: what was drawn is what is read, at any size that has room for it.
#include "renderer/frame_counter.h"

#include <gtest/gtest.h>

namespace vindu {
namespace {

/// A tile of that size with a counter in its lower left.
Image tile_with(std::uint64_t number, SizePx size) {
  Image tile = Image::filled(size.width, size.height, {90, 120, 60, 255});
  const Image counter = frame_counter(number, size);
  paste(counter, 0, size.height - counter.height_px, tile);
  return tile;
}

TEST(FrameCounter, IsReadAsItWasDrawn) {
  for (const SizePx size : {SizePx{1024, 768}, {102, 77}, {51, 38}, {768, 1024}, {320, 180}})
    for (const std::uint64_t number : {0ul, 7ul, 1234ul, 56789012ul, 99999999ul})
      EXPECT_EQ(read_frame_counter(tile_with(number, size)), number)
          << size.width << " x " << size.height;
}

TEST(FrameCounter, KeepsTheLastEightDigits) {
  EXPECT_EQ(read_frame_counter(tile_with(123456789012, {1024, 768})), 56789012u);
}

TEST(FrameCounter, IsNotReadWhereThereIsNone) {
  EXPECT_FALSE(read_frame_counter(Image::filled(1024, 768, {90, 120, 60, 255})));
  EXPECT_FALSE(read_frame_counter(Image::filled(1024, 768, {255, 255, 255, 255})));
  EXPECT_FALSE(read_frame_counter(Image::filled(20, 8, {0, 0, 0, 255})));
}

TEST(FrameCounter, HasNoPlaceOnATinyTile) { EXPECT_TRUE(frame_counter(1, {20, 8}).empty()); }

}  // namespace
}  // namespace vindu
