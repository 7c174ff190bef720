#include "app/touch_wall.h"

#include <memory>
#include <thread>

#include "app/wall_console.h"
#include "cluster/console.h"
#include "cluster/dds.h"

namespace vindu::app {
namespace {

/// So long a master is looked for; with keys, acquaintance takes longer.
constexpr Duration kFinds = std::chrono::seconds(3), kFindsWithKeys = std::chrono::seconds(6);
constexpr Duration kAnswers = std::chrono::seconds(5);
constexpr Duration kBetweenPages = std::chrono::milliseconds(100);

class RunningWall {
 public:
  explicit RunningWall(const Site& site)
      : transport_(network_of(site, Role::console)), page_(transport_, this_console(site)) {}

  WallPage& page() { return page_; }
  void show(const TouchPage& page) {
    std::this_thread::sleep_until(next_);
    page_.show(page);
    next_ = std::chrono::steady_clock::now() + kBetweenPages;
  }

 private:
  DdsTransport transport_;
  WallPage page_;
  Time next_{};
};

}  // namespace

ShowPage page_on_running_wall(const Site& site, const TouchPage& first) {
  auto wall = std::make_shared<RunningWall>(site);
  const Duration search = site.cluster.keys.empty() ? kFinds : kFindsWithKeys;
  if (!wall->page().begin(first, search, kAnswers)) return {};
  return [wall](const TouchPage& page) {
    wall->show(page);
    return true;
  };
}

}  // namespace vindu::app
