// A wall of real processes on loopback, as the tests of it start them: a master and tiles that
// draw. Which frame a tile showed is read from its pixels. Nothing here says how long anything may
// take.
#pragma once

#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/process.h"
#include "tests/wall/children.h"
#include "tests/wall/swaps.h"

namespace vindu::testing {

class WallTest : public AppTest {
 protected:
  WallTest()
      : wall_file_(write("wall.toml",
                         "[wall]\ncolumns = 2\nrows = 2\nwidth_m = 2\nheight_m = 1.5\n"
                         "tile_width_px = 1024\ntile_height_px = 768\n"
                         "[cluster]\nname = \"test-" +
                             std::to_string(getpid()) + "\"\n")) {}

  Child start_tiles(const std::vector<std::string>& tiles, const std::string& shown) const {
    std::vector<std::string> words = {VINDU_PROGRAM, "tile",     "--headless", "--scale",  "0.1",
                                      "--wall",      wall_file_, "--shown",    path(shown)};
    words.insert(words.end(), tiles.begin(), tiles.end());
    return Child(words, path(shown + ".log"));
  }
  Child start_tile(const std::string& tile) const { return start_tiles({tile}, tile + ".csv"); }
  Child start_master(const std::vector<std::string>& more = {},
                     const std::string& mode = "loop") const {
    std::vector<std::string> words = {VINDU_PROGRAM, "master", small_model(), "--wall",  wall_file_,
                                      "--mode",      mode,     "--pattern",   "counter", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return Child(words, path("master.log"));
  }

  /// Until the file has so many swaps more.
  void await_swaps(const std::string& shown, std::size_t more) const {
    const std::size_t before = swaps_in(path(shown)).size();
    while (swaps_in(path(shown)).size() < before + more)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  void await_log(const std::string& text) const {
    while (bytes_of(path("master.log")).find(text) == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  /// Every swap showed, in its pixels, the frame that it said; frames come in order; all tiles had
  /// one eye in one frame.
  void expect_right(const std::vector<std::string>& files) const {
    std::vector<std::vector<Swap>> swaps;
    for (const std::string& file : files) swaps.push_back(swaps_in(path(file)));
    EXPECT_THAT(wrong_swaps(swaps), ::testing::IsEmpty());
  }

  static std::vector<std::string> all() { return {"tile-0-0", "tile-1-0", "tile-0-1", "tile-1-1"}; }
  static std::vector<std::string> files() {
    std::vector<std::string> files = all();
    for (std::string& file : files) file += ".csv";
    return files;
  }

  std::string wall_file_;
};

}  // namespace vindu::testing
