// vindu calibrate wall beside a running wall: its tiles show the points, and afterwards what they
// showed before.
#include <algorithm>
#include <atomic>
#include <csignal>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "cluster/dds.h"
#include "renderer/frame_counter.h"
#include "renderer/touch_page.h"
#include "tests/wall/wall_fixture.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

constexpr SizePx kTilePicture{320, 240};  // of the tiles of this wall

/// Hears the pages that a master tells its tiles to show.
class PageListener {
 public:
  explicit PageListener(const Site& site)
      : transport_(dds_settings_of(site.cluster)),
        bus_(transport_.join({{.role = Role::console,
                               .name = "listener-" + std::to_string(getpid()),
                               .host = "here",
                               .version = "test"},
                              {},
                              {Topic::frame}})) {}

  /// Until a frame shows one, or shows none.
  void await_page(bool shown) const {
    while (shows_ != (shown ? Shows::page : Shows::scene))
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  /// All that were heard of until now.
  std::vector<TouchPage> pages() const {
    const std::scoped_lock lock(mutex_);
    return pages_;
  }

 private:
  enum class Shows { unknown, scene, page };

  void listen(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      bus_->wait({Topic::frame}, std::chrono::steady_clock::now() + std::chrono::milliseconds(50));
      for (const FrameMessage& frame : bus_->take<FrameMessage>()) note(frame.newest);
    }
  }
  void note(const FrameState& state) {
    const std::scoped_lock lock(mutex_);
    const std::optional<TouchPage>& page = state.touch_page;
    if (page && (pages_.empty() || pages_.back() != *page)) pages_.push_back(*page);
    shows_ = page ? Shows::page : Shows::scene;
  }

  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
  mutable std::mutex mutex_;
  std::vector<TouchPage> pages_;
  std::atomic<Shows> shows_ = Shows::unknown;
  std::jthread thread_{[this](const std::stop_token& stop) { listen(stop); }};
};

/// A wall of two tiles with two emulated cameras, which know how they stand to each other.
class TouchedWall : public AppTest {
 protected:
  TouchedWall()
      : wall_file_(write(
            "wall.toml",
            "[wall]\ncolumns = 2\nrows = 1\nwidth_m = 2\nheight_m = 0.75\ntile_width_px = 320\n"
            "tile_height_px = 240\n[cluster]\nname = \"touched-" +
                std::to_string(getpid()) + "\"\n" + camera("left", -1) + camera("right", 1))) {
    setenv("XDG_RUNTIME_DIR", path("").c_str(), 1);
  }
  ~TouchedWall() override { unsetenv("XDG_RUNTIME_DIR"); }

  static std::string camera(const std::string& name, int x_m) {
    return "[[camera]]\nname = \"" + name + "\"\nsource = \"emulated\"\nposition_m = [" +
           std::to_string(x_m) +
           ", 2.3, 5]\nlook_at_m = [0, 1.65, 2]\nfocal_px = 1335\ncentre_px = [512, 384]\n";
  }

  void start_wall() {
    ASSERT_EQ(ask({"calibrate", "wand"}).exit_code, 0);
    for (const std::string& tile : tiles())
      running_.push_back(start({"tile", tile, "--headless"}, tile + ".log"));
    running_.push_back(
        start({"master", small_model(), "--mode", "loop", "--pattern", "counter"}, "master.log"));
    for (const std::string& tile : tiles())
      while (bytes_of(path("master.log")).find(tile + ": admitted") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  /// Its points are touched in real time, for a quarter of a minute.
  Child start_calibration(const std::string& log) {
    return start({"calibrate", "wall", "--targets", "4", "--seconds", "16"}, log);
  }
  Child start(std::vector<std::string> words, const std::string& log) const {
    words.insert(words.begin(), VINDU_PROGRAM);
    words.insert(words.end(), {"--wall", wall_file_});
    return Child(words, path(log));
  }
  ProcessResult ask(std::vector<std::string> words) const {
    words.insert(words.end(), {"--wall", wall_file_});
    return vindu(words);
  }
  std::vector<Image> pictures(const std::string& out) const {
    const ProcessResult result = ask({"capture", "--out", path(out), "--timeout", "60"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::vector<Image> pictures;
    for (const std::string& tile : tiles())
      pictures.push_back(read_png(path(out + "/" + tile + ".png")));
    return pictures;
  }
  /// Whether these are its pictures, pixel for pixel.
  static bool show(const std::vector<Image>& pictures, const TouchPage& page, const Wall& wall) {
    for (std::size_t i = 0; i < pictures.size(); ++i)
      if (draw_touch_page(page, wall.tiles[i], kTilePicture).pixels != pictures[i].pixels)
        return false;
    return true;
  }
  static std::vector<std::string> tiles() { return {"tile-0-0", "tile-1-0"}; }

  std::string wall_file_;
  std::vector<Child> running_;
};

TEST_F(TouchedWall, ShowsThePointsOnItsTilesAndThenTheSceneAgain) {
  start_wall();
  const Site site = read_site(wall_file_);
  PageListener listener(site);
  ASSERT_EQ(ask({"blank", "on"}).exit_code, 0);  // the points are seen all the same
  Child calibration = start_calibration("calibrate.log");
  listener.await_page(true);
  EXPECT_THAT(ask({"status"}).out, HasSubstr("points to be touched"));
  std::set<std::size_t> captured;  // how many points are done on pages that tiles showed
  while (captured.size() < 2 && calibration.runs()) {
    const std::vector<Image> seen = pictures("touched");
    for (const TouchPage& page : listener.pages())
      if (show(seen, page, site.wall)) captured.insert(page.done);
  }
  EXPECT_EQ(captured.size(), 2u) << "captures that show, pixel for pixel, what the master told";

  EXPECT_EQ(calibration.end(), 0);
  listener.await_page(false);
  EXPECT_EQ(ask({"blank", "off"}).exit_code, 0);
  for (const Image& picture : pictures("after")) EXPECT_TRUE(read_frame_counter(picture));
  EXPECT_THAT(bytes_of(path("calibrate.log")), HasSubstr("its tiles show the points"));
  std::set<std::size_t> done;
  for (const TouchPage& page : listener.pages()) done.insert(page.done);
  EXPECT_THAT(done, IsSupersetOf({0, 1, 2, 3})) << "as the four points are touched";
}

TEST_F(TouchedWall, ShowsTheSceneAgainWhenTheCommandIsKilledAndGoesOnWithoutATile) {
  start_wall();
  PageListener listener(read_site(wall_file_));
  Child calibration = start_calibration("calibrate.log");
  listener.await_page(true);
  running_[1].send(SIGKILL);
  running_[1].end();
  const Child second = start_calibration("second.log");
  while (bytes_of(path("second.log")).find("end that calibration first") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(calibration.runs());
  calibration.send(SIGKILL);
  calibration.end();
  listener.await_page(false);
  EXPECT_THAT(ask({"status"}).out, Not(HasSubstr("points to be touched")));
}

TEST_F(TouchedWall, ShowsNothingWhereThePointsAreDrawnToFiles) {
  start_wall();
  PageListener listener(read_site(wall_file_));
  listener.await_page(false);
  const ProcessResult drawn =
      ask({"calibrate", "wall", "--targets", "3", "--draw", path("drawn"), "--dry-run"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_THAT(listener.pages(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace vindu
