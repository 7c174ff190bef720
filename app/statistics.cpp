#include "app/statistics.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

namespace vindu::app {
namespace {

constexpr Duration kWordsEvery = std::chrono::milliseconds(500);

/// Of this process, in use (resident); 0 where the kernel does not say (proc(5), statm).
double memory_bytes() {
  std::ifstream statm("/proc/self/statm");
  double whole_pages = 0, resident_pages = 0;
  statm >> whole_pages >> resident_pages;
  return statm ? resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Dashes where nothing was measured.
OverlayRow quantiles_row(const std::string& label, const Quantiles& ms, int digits) {
  const auto text = [&](double value) {
    return ms == Quantiles{} ? "-" : fmt::format("{:.{}f}", value, digits);
  };
  return {label, {text(ms.p50), text(ms.p99), text(ms.max)}};
}

OverlayRow photon_row(const FrameSummary& frames) {
  return quantiles_row(frames.tracked ? "motion to photon, ms" : "tick to photon, ms",
                       frames.motion_to_photon_ms, 1);
}

double culled_share(const DrawCount& count) {
  return count.triangles == 0
             ? 0
             : static_cast<double>(count.culled_triangles) / static_cast<double>(count.triangles);
}

const OverlayRow kHead{"", {"p50", "p99", "max"}};

}  // namespace

std::string count_text(std::uint64_t count) {
  const auto value = static_cast<double>(count);
  if (count < 10'000) return fmt::format("{}", count);
  if (count < 10'000'000) return fmt::format("{:.0f} k", 1e-3 * value);
  return fmt::format("{:.0f} M", 1e-6 * value);
}

void FrameStatistics::drew(const DrawCount& count, Duration draw, std::optional<Duration> gpu) {
  figures_.draw_ms = milliseconds(draw);
  figures_.gpu_ms = gpu ? milliseconds(*gpu) : 0;
  figures_.triangles = count.triangles;
  figures_.culled_share = culled_share(count);
}

void FrameStatistics::showed(Time now, const FrameParts& parts) {
  tally_.add(now, parts);
  timeline_.add(parts);
  if (now - worded_ < kWordsEvery) return;
  worded_ = now;
  figures_.memory_bytes = memory_bytes();
  summary_ = tally_.summary(now);
  shown_ = figures_;
  timeline_.mean_ms = summary_.mean_ms;
  timeline_.full_ms = full_scale_ms(summary_.motion_to_photon_ms.p99);
}

OverlayPage FrameStatistics::page(const std::string& title, const std::string& below,
                                  const DrawCount& count) const {
  OverlayPage page{.title = title,
                   .aside = fmt::format("{:.1f} fps", summary_.frames_per_s),
                   .below = below,
                   .timeline = timeline_,
                   .rows = {kHead, photon_row(summary_)}};
  if (shown_.gpu_ms > 0) page.rows.push_back({"GPU", {fmt::format("{:.1f} ms", shown_.gpu_ms)}});
  page.rows.push_back({"triangles", {count_text(count.triangles - count.culled_triangles)}});
  page.rows.push_back({"culled", {fmt::format("{:.0f} %", 100 * culled_share(count))}});
  page.rows.push_back({"memory", {fmt::format("{:.0f} MB", 1e-6 * shown_.memory_bytes)}});
  return page;
}

OverlayPage wall_page(const ReportMessage& report, const std::string& name, std::size_t tiles) {
  const FrameSummary& frames = report.frames;
  return {.title = name,
          .aside = fmt::format("{:.1f} fps", frames.frames_per_s),
          .below = report.event,
          .timeline = {},
          .rows = {kHead,
                   quantiles_row("skew of swaps, ms", frames.skew_ms, 2),
                   photon_row(frames),
                   {"eye",
                    {report.level == TrackingLevel::lost ? "not tracked"
                                                         : std::string(name_of(report.level))}},
                   {"tiles in the lock", {fmt::format("{} of {}", report.locked, tiles)}},
                   {"evicted", {fmt::format("{}", report.evictions)}},
                   {"restarted", {fmt::format("{}", report.restarts)}}}};
}

}  // namespace vindu::app
