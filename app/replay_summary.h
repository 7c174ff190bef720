// What a recording holds, in figures: devices, rates, gaps, and what is wrong with it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/site.h"
#include "tracker/recording_reader.h"
#include "tracker/wiimote/commands.h"

namespace vindu::app {

/// Upper edges of the gaps between two reports of one device; the last count has none.
constexpr std::array<int, 10> kGapEdges_ms = {1, 2, 5, 9, 11, 15, 20, 50, 200, 1000};

struct DeviceSummary {
  std::string name;  ///< or the index where there is none; no blanks
  Time first = Time::max();
  Time last = Time::min();
  std::uint64_t reports = 0;
  std::uint64_t out_of_order = 0;  ///< arrived, by their times, before the one recorded before
  std::uint64_t observations = 0;  ///< that the driver makes of them
  std::uint64_t refused = 0;       ///< that it cannot read
  std::map<std::uint8_t, std::uint64_t> by_id;  ///< reports of each report id
  std::array<std::uint64_t, kGapEdges_ms.size() + 1> gaps{};
};

struct RecordingSummary {
  std::string file;
  RecordingInfo info;  ///< with all devices, also those of a text
  RecordingProblems problems;
  std::vector<RecordedNote> notes;
  std::map<int, DeviceSummary> devices;  ///< by index
  Time first = Time::max();
  Time last = Time::min();
};

/// That of the file, or else the one in the recording; empty when there is neither. Throws Error
/// when it cannot be read.
std::optional<Site> site_of(const RecordingInfo& info, const std::string& wall_file);

/// Index of the device's camera, by name; a device without one is its index.
std::optional<std::size_t> camera_of(const RecordedDevice& device, const Site& site);

/// Reads all of it, once as bytes and once for each device through the driver, with what that wall
/// file, or the one in the recording, says of its camera. Throws Error as RecordingReader does, and
/// where it holds no reports.
RecordingSummary summarize(const std::string& file, DamagePolicy damage,
                           const std::string& wall_file);

/// For people.
std::string table_of(const RecordingSummary& summary);

}  // namespace vindu::app
