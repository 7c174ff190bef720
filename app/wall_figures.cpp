#include "app/wall_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/common.h"

namespace vindu::app {
namespace {

std::string row(const char* name, const RunSpread& values) {
  if (values.empty()) return fmt::format("  {:<24}{:>9}{:>9}{:>9}\n", name, "-", "-", "-");
  const Quantiles spread = values.quantiles();
  return fmt::format("  {:<24}{:>9.3f}{:>9.3f}{:>9.3f} ms\n", name, spread.p50, spread.p99,
                     spread.max);
}

std::string json_row(const char* name, const RunSpread& values) {
  const Quantiles spread = values.quantiles();
  return fmt::format("\"{}\":{{\"p50\":{:.4f},\"p99\":{:.4f},\"max\":{:.4f}}}", name, spread.p50,
                     spread.p99, spread.max);
}

}  // namespace

WallFigures::WallFigures(const std::vector<std::string>& names, Duration display,
                         const std::string& csv_file)
    : display_(display), reports_(names) {
  if (!csv_file.empty()) csv_.emplace(csv_file);
}

void WallFigures::begun(const FrameOrigin& origin, const Kind& kind) {
  constexpr std::size_t kKept = 256;
  begun_[++frames_] = {origin, kind};
  undrawn_ += !kind.drawn;
  if (begun_.size() > kKept) forget_before(std::next(begun_.begin())->first);
  if (last_begun_) gaps_ms_.add(milliseconds(origin.tick_time - *last_begun_));
  last_begun_ = origin.tick_time;
  if (origin.capture_time)
    parts_ms_[static_cast<std::size_t>(Part::capture_age)].add(
        milliseconds(origin.tick_time - *origin.capture_time));
  parts_ms_[static_cast<std::size_t>(Part::solve)].add(
      milliseconds(origin.eye_time - origin.tick_time));
  reports_.follows(kind.level);
}

void WallFigures::forget_before(std::uint64_t number) {
  while (!begun_.empty() && begun_.begin()->first < number) {
    write(begun_.begin()->first, begun_.begin()->second, nullptr);
    begun_.erase(begun_.begin());
  }
}

void WallFigures::write(std::uint64_t number, const Begun& begun, const FrameSkew* skew) {
  if (!csv_) return;
  FrameLine line{.number = number, .tick = begun.origin.tick_time, .level = begun.kind.level};
  if (skew) {
    line.tiles = skew->swaps.size();
    line.last_tile = skew->last().tile;
    line.parts = parts_of(begun.origin, skew->last().parts, skew->last().shown, display_);
    line.skew = skew->skew();
  } else {
    line.parts = parts_of(begun.origin, {}, begun.origin.eye_time, {});
  }
  csv_->add(line);
}

void WallFigures::add(const FrameSkew& skew, Time now) {
  const auto found = begun_.find(skew.number);
  shown_ |= !skew.swaps.empty();
  if (found == begun_.end()) return;  // too late
  if (skew.swaps.size() >= 2) skews_ms_.add(milliseconds(skew.skew()));
  forget_before(skew.number);
  const FrameOrigin origin = found->second.origin;
  const bool drawn = found->second.kind.drawn;
  write(skew.number, found->second, &skew);
  begun_.erase(found);
  reports_.add(skew, origin, display_, now);
  if (!drawn) return;
  const double light_s = seconds(skew.last().shown - origin.tick_time);
  to_light_s_ += 0.1 * (std::clamp(light_s, 0.0, 1.0) - to_light_s_);
  to_light_ms_.add(1e3 * light_s);
  const FrameParts parts = parts_of(origin, skew.last().parts, skew.last().shown, display_);
  for (auto part = static_cast<std::size_t>(Part::publish); part < kParts; ++part)
    parts_ms_[part].add(milliseconds(parts.durations[part]));
  if (parts.tracked) to_photon_ms_.add(milliseconds(parts.motion_to_photon()));
}

void WallFigures::add(const MemberEvent& event) {
  ++changes_[event.change];
  reports_.add(event);
}

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
  if (undrawn_ > 0)
    text += fmt::format("  {} of them showed what was there and were not drawn\n", undrawn_);
  text += fmt::format("  {:<24}{:>9}{:>9}{:>9}\n", "", "p50", "p99", "max");
  text += row("between frames", gaps_ms_);
  for (int part = 0; part < kParts; ++part)
    if (const auto& values = parts_ms_[static_cast<std::size_t>(part)]; !values.empty())
      text += row(std::string(name_of(static_cast<Part>(part))).c_str(), values);
  text += row("tick to the last swap", to_light_ms_);
  if (!to_photon_ms_.empty()) text += row("motion to photon", to_photon_ms_);
  text += row("skew of the swaps", skews_ms_);
  return text;
}

std::string WallFigures::json() const {
  const auto count = [&](MemberChange change) {
    const auto found = changes_.find(change);
    return found == changes_.end() ? 0 : found->second;
  };
  const auto part = [&](Part which) -> const RunSpread& {
    return parts_ms_[static_cast<std::size_t>(which)];
  };
  const std::string parts =
      fmt::format("{},{},{},{},{},{}", json_row("publish", part(Part::publish)),
                  json_row("pickup", part(Part::pickup)), json_row("draw", part(Part::draw)),
                  json_row("barrier", part(Part::barrier)), json_row("swap", part(Part::swap)),
                  json_row("display", part(Part::display)));
  std::string text = fmt::format(
      "{{\"frames\":{},\"undrawn\":{},\"seconds\":{:.3f},\"evicted\":{},\"lost\":{},\"restarted\":{"
      "},"
      "\"milliseconds\":{{{},{},{},{},{},{},{}}},\"tiles\":{{",
      frames_, undrawn_, seconds(length), count(MemberChange::evicted), count(MemberChange::lost),
      count(MemberChange::restarted), json_row("between_frames", gaps_ms_),
      json_row("capture_to_tick", part(Part::capture_age)), json_row("solve", part(Part::solve)),
      parts, json_row("tick_to_last_swap", to_light_ms_),
      json_row("motion_to_photon", to_photon_ms_), json_row("skew", skews_ms_));
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
