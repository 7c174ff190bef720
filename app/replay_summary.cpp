#include "app/replay_summary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

#include "app/cameras.h"
#include "core/error.h"
#include "tracker/recording_devices.h"
#include "tracker/wiimote/reader.h"

namespace vindu::app {
namespace {

void count_gap(DeviceSummary& device, Duration gap) {
  const auto edge = std::ranges::find_if(
      kGapEdges_ms, [gap](int edge_ms) { return gap < std::chrono::milliseconds(edge_ms); });
  ++device.gaps[static_cast<std::size_t>(edge - kGapEdges_ms.begin())];
}

void count(DeviceSummary& device, const RecordedReport& report) {
  if (device.reports++ > 0) {
    if (report.arrival < device.last) ++device.out_of_order;
    count_gap(device, std::max(report.arrival - device.last, Duration{}));
  }
  ++device.by_id[report.bytes.front()];
  device.first = std::min(device.first, report.arrival);
  device.last = std::max(device.last, report.arrival);
}

WiimoteSettings driver_settings(const RecordedDevice& device, const std::optional<Site>& site) {
  const auto camera = site ? camera_of(device, *site) : std::nullopt;
  return camera ? wiimote_settings(site->cameras[*camera], static_cast<int>(*camera))
                : WiimoteSettings{};
}

void drive(std::unique_ptr<HidDevice> recorded, const WiimoteSettings& settings,
           DeviceSummary& device) {
  WiimoteReader reader(std::move(recorded), 0, settings);
  for (const Time until : {device.first, device.last})
    while (reader.next(until)) ++device.observations;
  device.refused = reader.session().health().refused;
}

/// Without a wall that can be read, what is usual of a camera has to do.
std::optional<Site> site_to_drive_with(RecordingSummary& summary, const std::string& wall_file) {
  try {
    return site_of(summary.info, wall_file);
  } catch (const Error& error) {
    if (!wall_file.empty()) throw;
    summary.problems.remarks.push_back(std::string("the wall file in it: ") + error.what());
    return std::nullopt;
  }
}

/// Nobody waits for that; it is two clocks in one file.
void refuse_leap(const RecordingReader& reader, Time arrival, Time before) {
  constexpr auto kLeap = std::chrono::days(7);
  if (before == Time::min() || arrival - before < kLeap) return;
  throw Error(
      {fmt::format("the report at {} ns comes {:.0f} days after the ones before it",
                   Duration(arrival.time_since_epoch()).count(), seconds(arrival - before) / 86400),
       reader.place(), "give all arrival times on one clock, or cut the recording in two"});
}

/// Names stand in the text form only if all of them can be read again.
bool all_names_usable(const RecordingInfo& info) {
  return std::ranges::all_of(info.devices, [](const RecordedDevice& device) {
    const std::string& name = device.name;
    return !name.empty() && name.find_first_of(" \t\r\n") == std::string::npos &&
           name.front() != '#' && name.find_first_not_of("0123456789") != std::string::npos;
  });
}

void name_devices(RecordingSummary& summary) {
  const bool names = all_names_usable(summary.info);
  for (const RecordedDevice& device : summary.info.devices)
    summary.devices[device.index].name = names ? device.name : std::to_string(device.index);
}

std::string origin_of(const RecordingInfo& info) {
  if (info.program.empty()) return "a text";
  const auto date = std::chrono::system_clock::time_point(
      std::chrono::duration_cast<std::chrono::system_clock::duration>(
          Duration(info.started_utc_ns)));
  return fmt::format("{}, {:%Y-%m-%d %H:%M:%S} UTC, wall {}", info.program,
                     fmt::gmtime(std::chrono::system_clock::to_time_t(date)), info.wall_file);
}

/// Blanks stand between columns, so that no figure runs into the next one, however large.
std::string device_row(const DeviceSummary& device) {
  const double length_s = device.reports > 1 ? seconds(device.last - device.first) : 0;
  const double rate_hz = length_s > 0 ? static_cast<double>(device.reports - 1) / length_s : 0;
  std::string ids;
  for (const auto& [id, reports] : device.by_id) ids += fmt::format("  0x{:02x}: {}", id, reports);
  return fmt::format("  {:<12} {:>9} {:>11.3f} {:>10.2f} {:>13}{}\n", device.name, device.reports,
                     length_s, rate_hz, device.observations, ids);
}

std::string gaps_table(const RecordingSummary& summary) {
  std::string text = "\n  gaps, ms    ";
  int low_ms = 0;
  for (const int high_ms : kGapEdges_ms) {
    text += fmt::format(" {:>8}", fmt::format("{}-{}", low_ms, high_ms));
    low_ms = high_ms;
  }
  text += fmt::format(" {:>8}\n", fmt::format("{}-", low_ms));
  for (const auto& [index, device] : summary.devices) {
    text += fmt::format("  {:<12}", device.name);
    for (const std::uint64_t gaps : device.gaps) text += fmt::format(" {:>8}", gaps);
    text += "\n";
  }
  return text;
}

std::string notes_text(const RecordingSummary& summary) {
  if (summary.notes.empty()) return "";
  std::string text = "\n  noted at\n";
  for (const RecordedNote& note : summary.notes)
    text += fmt::format("  {:>10.3f} s  {}\n", seconds(note.time - summary.first), note.text);
  return text;
}

std::string problems_text(const RecordingSummary& summary) {
  std::string text;
  const auto say = [&text](std::uint64_t count, const std::string& what) {
    if (count > 0) text += fmt::format("  {} {}\n", count, what);
  };
  for (const std::string& file : summary.problems.missing)
    text += "  " + file + " is missing; what comes after it was not read\n";
  say(summary.problems.torn_bytes, "bytes lost at the end");
  say(summary.problems.damaged_bytes, "damaged bytes skipped");
  say(summary.problems.dropped, "reports dropped while recording: the disk was too slow or full");
  for (const auto& [index, device] : summary.devices) {
    say(device.refused, "reports that are not a Wiimote's, " + device.name);
    say(device.out_of_order, "reports out of order, " + device.name);
    if (device.reports > 0 && device.observations == 0)
      text += "  no dots from " + device.name + "\n";
    if (device.reports == 0) text += "  no reports from " + device.name + "\n";
  }
  return text.empty() ? "\n  no problems\n" : "\nProblems\n" + text;
}

}  // namespace

std::optional<Site> site_of(const RecordingInfo& info, const std::string& wall_file) {
  if (!wall_file.empty()) return read_site(wall_file);
  if (info.wall_text.empty()) return std::nullopt;
  return parse_site(info.wall_text, info.wall_file);
}

std::optional<std::size_t> camera_of(const RecordedDevice& device, const Site& site) {
  if (device.name.empty())
    return static_cast<std::size_t>(device.index) < site.cameras.size()
               ? std::optional<std::size_t>(device.index)
               : std::nullopt;
  const auto camera = std::ranges::find(site.cameras, device.name, &CameraConfig::name);
  if (camera == site.cameras.end()) return std::nullopt;
  return static_cast<std::size_t>(camera - site.cameras.begin());
}

RecordingSummary summarize(const std::string& file, DamagePolicy damage,
                           const std::string& wall_file) {
  RecordingReader reader(file, damage);
  RecordingSummary summary{.file = file, .info = {}, .problems = {}, .notes = {}, .devices = {}};
  while (const auto report = reader.next()) {
    refuse_leap(reader, report->arrival, summary.last);
    count(summary.devices[report->device], *report);
    summary.first = std::min(summary.first, report->arrival);
    summary.last = std::max(summary.last, report->arrival);
  }
  summary.info = reader.info();
  summary.problems = reader.problems();
  summary.notes = reader.notes();
  name_devices(summary);
  if (summary.first > summary.last)
    throw Error({"holds no reports", file, "record again, and look whether the cameras are on"});
  const std::optional<Site> site = site_to_drive_with(summary, wall_file);
  ManualClock clock;
  for (const RecordedDevice& recorded : summary.info.devices)
    if (DeviceSummary& device = summary.devices.at(recorded.index); device.reports > 0)
      drive(std::make_unique<ReplayHidDevice>(file, recorded.index, clock,
                                              ReplayOptions{.damage = damage}),
            driver_settings(recorded, site), device);
  return summary;
}

std::string table_of(const RecordingSummary& summary) {
  std::string text =
      fmt::format("{}: {}\n{:.3f} s\n\n  {:<12} {:>9} {:>11} {:>10} {:>13}  by report id\n",
                  summary.file, origin_of(summary.info), seconds(summary.last - summary.first),
                  "device", "reports", "seconds", "a second", "observations");
  for (const auto& [index, device] : summary.devices) text += device_row(device);
  return text + gaps_table(summary) + notes_text(summary) + problems_text(summary);
}

}  // namespace vindu::app
