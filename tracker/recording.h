// What a recording holds: every input report of every device with its arrival time, and what is
// needed to make sense of them: the wall file's text, the devices' names, program and date. Its
// files are laid out in docs/recording.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"

namespace vindu {

struct RecordedDevice {
  int index = 0;     ///< 0..65535; its place in the wall file's list of cameras
  std::string name;  ///< the camera's; empty where a recording gives numbers only

  bool operator==(const RecordedDevice&) const = default;
};

struct RecordingInfo {
  std::string program;  ///< with version and machine: "vindu 0.1.0 on Linux 6.1.0, hidapi 0.13.1"
  std::int64_t started_utc_ns = 0;  ///< CLOCK_REALTIME; tells one recording from another
  Time started{};                   ///< the same moment on the clock of the arrival times
  std::string wall_file;            ///< path, as it was given
  std::string wall_text;            ///< that file, as it was then
  std::vector<RecordedDevice> devices;

  bool operator==(const RecordingInfo&) const = default;
};

struct RecordedReport {
  int device = 0;
  Time arrival{};
  std::vector<std::uint8_t> bytes;  ///< report id first; never empty

  bool operator==(const RecordedReport&) const = default;
};

/// What happened beside the reports, for people: which device a camera has, that it went.
struct RecordedNote {
  Time time{};
  std::string text;  ///< UTF-8, at most kMaxRecordedReport bytes

  bool operator==(const RecordedNote&) const = default;
};

/// HID reports have at most 64 bytes where we know them; hidapi's limit for descriptors is 4096.
constexpr std::size_t kMaxRecordedReport = 4096;

/// The files of one recording: "a.vrec", "a.1.vrec", "a.2.vrec"; part 0 is the first.
std::string recording_part(const std::string& file, int part);
/// The first of its parts after that one which is there; empty where none is.
std::optional<int> recording_part_after(const std::string& file, int part);

/// A report's line in the text form, without its end: "left 1234567 33001a". `device` is a name
/// without blanks, or the index.
std::string text_line(std::string_view device, const RecordedReport& report);

}  // namespace vindu
