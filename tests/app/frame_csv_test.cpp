// What the master writes and tells of its frames: lines of a file, and reports to all.
#include "app/frame_csv.h"

#include <gmock/gmock.h>

#include "app/wall_reports.h"
#include "core/error.h"

namespace vindu::app {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

const Time kStart{std::chrono::seconds(500)};

FrameLine some_line() {
  const FrameOrigin origin{.capture_time = kStart,
                           .tick_time = kStart + milliseconds(8),
                           .eye_time = kStart + milliseconds(9)};
  return {.number = 17,
          .tick = origin.tick_time,
          .level = TrackingLevel::hybrid,
          .tiles = 28,
          .last_tile = "tile-3-0",
          .parts = parts_of(origin, {milliseconds(1), milliseconds(6), milliseconds(3), {}},
                            kStart + milliseconds(20), milliseconds(16)),
          .skew = milliseconds(2)};
}

TEST(FrameCsv, HasAColumnForEachPartAndTheirSum) {
  EXPECT_EQ(csv_header(),
            "frame,time_s,tiles,last_tile,level,capture_age_ms,solve_ms,publish_ms,pickup_ms,"
            "draw_ms,barrier_ms,swap_ms,display_ms,motion_to_photon_ms,skew_ms");
  EXPECT_EQ(csv_line(some_line(), kStart),
            "17,0.008000,28,tile-3-0,hybrid,8.0000,1.0000,1.0000,1.0000,6.0000,3.0000,0.0000,"
            "16.0000,36.0000,2.0000");
}

TEST(FrameCsv, LeavesEmptyWhatIsNotKnown) {
  FrameLine untracked = some_line();
  untracked.level.reset();
  untracked.parts[Part::capture_age] = {};
  untracked.parts.tracked = false;
  EXPECT_THAT(csv_line(untracked, kStart), HasSubstr(",tile-3-0,,,1.0000,1.0000,"));
  FrameLine unseen = some_line();
  unseen.tiles = 0;
  unseen.last_tile = "";
  EXPECT_EQ(csv_line(unseen, kStart), "17,0.008000,0,,hybrid,8.0000,1.0000,,,,,,,,");
}

TEST(FrameCsv, IsAnErrorWhereItCannotBeWritten) {
  EXPECT_THROW(FrameCsv("/no/such/folder/frames.csv"), Error);
}

/// Both tiles show a frame 10 ms after its tick, the second one later.
FrameSkew frame_of(std::uint64_t number, Time tick, Duration skew) {
  const TileParts parts{.draw = milliseconds(6)};
  return {.number = number,
          .swaps = {{"tile-0-0", tick + milliseconds(10), parts},
                    {"tile-1-0", tick + milliseconds(10) + skew, parts}}};
}

TEST(WallReports, TellOfTheWallAndEachTileWithinASecond) {
  WallReports reports({"tile-0-0", "tile-1-0"});
  std::map<std::string, ReportMessage> told;
  for (int i = 0; i < 120; ++i) {
    const Time tick = kStart + from_seconds(i / 60.0);
    reports.add(frame_of(i + 1, tick, milliseconds(2)), {.tick_time = tick, .eye_time = tick},
                milliseconds(5), tick);
    if (i < 60) continue;
    const std::map<std::string, TileReport> tiles = {{"tile-0-0", {.locked = true}},
                                                     {"tile-1-0", {}}};
    if (const auto report = reports.next(tick, tiles)) told[report->tile] = *report;
  }
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[""].frames.skew_ms.p50, 2);
  EXPECT_EQ(told[""].frames.motion_to_photon_ms.p50, 17);  // of the one that is last
  EXPECT_EQ(told[""].locked, 1u);
  EXPECT_EQ(told["tile-0-0"].frames.skew_ms.max, 0);
  EXPECT_EQ(told["tile-1-0"].frames.skew_ms.p50, 2);
  EXPECT_EQ(told["tile-1-0"].locked, 0u);
}

TEST(WallReports, CountRestartsOfTheTileAndOfTheWall) {
  WallReports reports({"tile-0-0", "tile-1-0"});
  reports.add(MemberEvent{"tile-1-0", MemberChange::restarted, 640});
  reports.add(MemberEvent{"tile-1-0", MemberChange::evicted, 700});
  std::map<std::string, ReportMessage> told;
  for (int i = 1; i < 60; ++i)
    if (const auto report = reports.next(kStart + milliseconds(100 * i), {}))
      told[report->tile] = *report;
  EXPECT_EQ(told[""].restarts, 1u);
  EXPECT_EQ(told["tile-0-0"].restarts, 0u);
  EXPECT_EQ(told["tile-1-0"].restarts, 1u);
  EXPECT_EQ(told["tile-1-0"].evictions, 1u);
  EXPECT_EQ(told[""].event, "tile-1-0: evicted at frame 700");
}

}  // namespace
}  // namespace vindu::app
