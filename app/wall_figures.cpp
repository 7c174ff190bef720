#include "app/wall_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/common.h"

namespace vindu::app {
namespace {

/// The last hour or so of a wall that runs for days.
void keep(std::vector<double>& values, double value) {
  constexpr std::size_t kMost = 1 << 18;
  if (values.size() == kMost) values.erase(values.begin(), values.begin() + kMost / 2);
  values.push_back(value);
}

struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.5), at(0.99), values.back()};
}

std::string row(const char* name, const std::vector<double>& values) {
  const Spread spread = spread_of(values);
  return fmt::format("  {:<24}{:>9.3f}{:>9.3f}{:>9.3f} ms\n", name, spread.p50, spread.p99,
                     spread.max);
}

std::string json_row(const char* name, const std::vector<double>& values) {
  const Spread spread = spread_of(values);
  return fmt::format("\"{}\":{{\"p50\":{:.4f},\"p99\":{:.4f},\"max\":{:.4f}}}", name, spread.p50,
                     spread.p99, spread.max);
}

}  // namespace

void WallFigures::begun(Time now, std::optional<Duration> capture_age, Duration solve) {
  constexpr std::size_t kKept = 256;
  begun_[++frames_] = now;
  if (begun_.size() > kKept) begun_.erase(begun_.begin());
  if (last_begun_) keep(gaps_ms_, 1e3 * seconds(now - *last_begun_));
  last_begun_ = now;
  if (capture_age) keep(capture_ages_ms_, 1e3 * seconds(*capture_age));
  keep(solves_ms_, 1e3 * seconds(solve));
}

void WallFigures::add(const FrameSkew& skew) {
  if (skew.tiles >= 2) keep(skews_ms_, 1e3 * seconds(skew.skew));
  const auto found = begun_.find(skew.number);
  if (found == begun_.end()) return;
  const double light_s = seconds(skew.last_shown - found->second);
  to_light_s_ += 0.1 * (std::clamp(light_s, 0.0, 1.0) - to_light_s_);
  keep(to_light_ms_, 1e3 * light_s);
  begun_.erase(begun_.begin(), std::next(found));
}

void WallFigures::add(const MemberEvent& event) { ++changes_[event.change]; }

std::string WallFigures::table() const {
  const auto count = [&](MemberChange change) {
    const auto found = changes_.find(change);
    return found == changes_.end() ? 0 : found->second;
  };
  std::size_t locked = 0, present = 0;
  for (const auto& [name, tile] : tiles) {
    locked += tile.locked;
    present += tile.status.has_value();
  }
  std::string text = fmt::format(
      "{} frames in {:.1f} s, {:.1f} a second; {} of {} tiles in the lock, {} seen; {} evicted, {} "
      "lost, {} restarted\n",
      frames_, seconds(length), static_cast<double>(frames_) / std::max(seconds(length), 1e-9),
      locked, tiles.size(), present, count(MemberChange::evicted), count(MemberChange::lost),
      count(MemberChange::restarted));
  text += fmt::format("  {:<24}{:>9}{:>9}{:>9}\n", "", "p50", "p99", "max");
  text += row("between frames", gaps_ms_);
  if (!capture_ages_ms_.empty()) text += row("capture to tick", capture_ages_ms_);
  text += row("finding the eye", solves_ms_) + row("tick to the last swap", to_light_ms_) +
          row("skew of the swaps", skews_ms_);
  return text;
}

std::string WallFigures::json() const {
  const auto count = [&](MemberChange change) {
    const auto found = changes_.find(change);
    return found == changes_.end() ? 0 : found->second;
  };
  std::string text = fmt::format(
      "{{\"frames\":{},\"seconds\":{:.3f},\"evicted\":{},\"lost\":{},\"restarted\":{},"
      "\"milliseconds\":{{{},{},{},{},{}}},\"tiles\":{{",
      frames_, seconds(length), count(MemberChange::evicted), count(MemberChange::lost),
      count(MemberChange::restarted), json_row("between_frames", gaps_ms_),
      json_row("capture_to_tick", capture_ages_ms_), json_row("solve", solves_ms_),
      json_row("tick_to_last_swap", to_light_ms_), json_row("skew", skews_ms_));
  std::string comma;
  for (const auto& [name, tile] : tiles) {
    text += fmt::format("{}{}:{{\"locked\":{},\"presented\":{},\"frames_per_s\":{:.2f}}}", comma,
                        json_text(name), tile.locked, tile.status ? tile.status->presented : 0,
                        tile.status ? tile.status->frames_per_s : 0);
    comma = ",";
  }
  return text + "}}\n";
}

}  // namespace vindu::app
