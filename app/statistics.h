// The figures of frames that a process draws: for the wall's status, and as pages over the
// pictures. Words of a page change twice a second, its bars with every frame.
#pragma once

#include <optional>
#include <string>

#include "cluster/messages.h"
#include "core/frame_tally.h"
#include "renderer/overlay_page.h"
#include "renderer/scene_renderer.h"

namespace vindu::app {

class FrameStatistics {
 public:
  /// `rate_hz`: of the wall.
  explicit FrameStatistics(double rate_hz) { timeline_.period_ms = 1e3 / rate_hz; }

  void drew(const DrawCount& count, Duration draw, std::optional<Duration> gpu);
  void showed(Time now, const FrameParts& parts);

  const DrawFigures& figures() const { return figures_; }
  /// `count`: what is drawn of the scene there.
  OverlayPage page(const std::string& title, const std::string& below,
                   const DrawCount& count) const;

 private:
  FrameTally tally_;
  FrameTimeline timeline_;
  FrameSummary summary_;
  DrawFigures figures_, shown_;  // of the newest frame; as they stand on the page
  Time worded_{};
};

/// What the master says of the whole wall. `name`: the wall's; `tiles`: how many it has.
OverlayPage wall_page(const ReportMessage& report, const std::string& name, std::size_t tiles);

/// "412 k"
std::string count_text(std::uint64_t count);

}  // namespace vindu::app
