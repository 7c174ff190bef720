#include "app/replay_parts.h"

#include <fmt/format.h>

#include "core/frame_tally.h"

namespace vindu::app {
namespace {

std::string part_row(const char* name, const std::vector<double>& values_ms) {
  if (values_ms.empty()) return fmt::format("  {:<14} {:>8} {:>8} {:>8}\n", name, "-", "-", "-");
  const Quantiles ms = quantiles_of(values_ms);
  return fmt::format("  {:<14} {:>8.3f} {:>8.3f} {:>8.3f} ms\n", name, ms.p50, ms.p99, ms.max);
}

}  // namespace

void ReplayParts::add(Time now, const std::optional<PoseSample>& pose, Duration solve) {
  solves_ms_.push_back(milliseconds(solve));
  if (pose && pose->level < TrackingLevel::held)
    capture_ages_ms_.push_back(milliseconds(now - pose->capture_time));
}

std::string ReplayParts::table() const {
  return fmt::format("{} ticks, the head seen at {} of them\n\n  {:<14} {:>8} {:>8} {:>8}\n",
                     solves_ms_.size(), capture_ages_ms_.size(), "", "p50", "p99", "max") +
         part_row("capture age", capture_ages_ms_) + part_row("solve", solves_ms_) +
         "\nCapture age is that of the recorded reports at the wall's ticks; solving was timed on "
         "this machine.\nPublish, pick-up, draw, barrier, swap and display are not in a recording: "
         "vindu master --csv.\n";
}

}  // namespace vindu::app
