// Motion to photon is the sum of its parts, and what is said of the last seconds' frames is true.
#include "core/frame_tally.h"

#include <gtest/gtest.h>

#include <functional>

namespace vindu {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Time kTick{seconds(1000)};

TEST(FrameParts, AddUpToTheTimeFromCaptureToLight) {
  const FrameOrigin origin{.capture_time = kTick - milliseconds(9),
                           .tick_time = kTick,
                           .eye_time = kTick + milliseconds(1)};
  const TileParts tile{milliseconds(2), milliseconds(6), milliseconds(3), milliseconds(1)};
  const FrameParts parts = parts_of(origin, tile, kTick + milliseconds(15), milliseconds(16));
  EXPECT_EQ(parts.motion_to_photon(), milliseconds(9 + 15 + 16));
  EXPECT_EQ(parts[Part::capture_age], milliseconds(9));
  EXPECT_EQ(parts[Part::solve], milliseconds(1));
  EXPECT_EQ(parts[Part::publish], milliseconds(2));  // what nobody else accounts for
  EXPECT_EQ(parts[Part::barrier], milliseconds(3));
  EXPECT_TRUE(parts.tracked);
}

TEST(FrameParts, BeginWithTheTickWhereNothingIsTracked) {
  const FrameParts parts = parts_of({.capture_time = {}, .tick_time = kTick, .eye_time = kTick}, {},
                                    kTick + milliseconds(4), {});
  EXPECT_FALSE(parts.tracked);
  EXPECT_EQ(parts.motion_to_photon(), milliseconds(4));
}

TEST(Quantiles, AreTheNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(quantiles_of(values), (Quantiles{100, 198, 200}));
  EXPECT_EQ(quantiles_of({7}), (Quantiles{7, 7, 7}));
  EXPECT_EQ(quantiles_of({}), Quantiles{});
}

/// Frames of so many milliseconds' draw, 60 a second.
FrameTally tally_of(int frames, const std::function<int(int)>& draw_ms) {
  FrameTally tally;
  for (int i = 0; i < frames; ++i) {
    FrameParts parts;
    parts[Part::draw] = milliseconds(draw_ms(i));
    parts[Part::swap] = milliseconds(1);
    tally.add(kTick + from_seconds(i / 60.0), parts, milliseconds(i % 2));
  }
  return tally;
}

TEST(FrameTally, HasMeansThatAddUp) {
  FrameTally tally = tally_of(120, [](int i) { return i % 2 == 0 ? 4 : 8; });
  const FrameSummary summary = tally.summary(kTick + seconds(2));
  EXPECT_EQ(summary.frames, 120u);
  EXPECT_NEAR(summary.frames_per_s, 60, 1e-6);
  EXPECT_NEAR(summary.mean_ms[static_cast<std::size_t>(Part::draw)], 6, 1e-9);
  EXPECT_NEAR(summary.mean_motion_to_photon_ms(), 7, 1e-9);
  EXPECT_EQ(summary.motion_to_photon_ms, (Quantiles{5, 9, 9}));
  EXPECT_EQ(summary.skew_ms, (Quantiles{0, 1, 1}));
}

TEST(FrameTally, ForgetsWhatIsOld) {
  FrameTally tally = tally_of(600, [](int i) { return i < 120 ? 500 : 5; });
  EXPECT_EQ(tally.summary(kTick + seconds(10)).motion_to_photon_ms.max, 6);
  EXPECT_EQ(tally.summary(kTick + seconds(60)), FrameSummary{});
}

}  // namespace
}  // namespace vindu
