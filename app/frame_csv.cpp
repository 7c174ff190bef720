#include "app/frame_csv.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"

namespace vindu::app {
namespace {

constexpr Duration kWrite = std::chrono::milliseconds(500);

std::string ms_of(bool known, Duration duration) {
  return known ? fmt::format("{:.4f}", milliseconds(duration)) : "";
}

}  // namespace

std::string csv_header() {
  std::string header = "frame,time_s,tiles,last_tile,level";
  for (const char* part : {"capture_age", "solve", "publish", "pickup", "draw", "barrier", "swap",
                           "display", "motion_to_photon", "skew"})
    header += fmt::format(",{}_ms", part);
  return header;
}

std::string csv_line(const FrameLine& line, Time start) {
  std::string text =
      fmt::format("{},{:.6f},{},{},{}", line.number, seconds(line.tick - start), line.tiles,
                  line.last_tile, line.level ? name_of(*line.level) : "");
  const bool shown = line.tiles > 0;
  for (int i = 0; i < kParts; ++i) {
    const auto part = static_cast<Part>(i);
    const bool known =
        part == Part::capture_age ? line.parts.tracked : part == Part::solve || shown;
    text += "," + ms_of(known, line.parts[part]);
  }
  return text + "," + ms_of(shown, line.parts.motion_to_photon()) + "," +
         ms_of(line.tiles > 1, line.skew);
}

FrameCsv::FrameCsv(const std::string& file) : file_(file), stream_(file) {
  if (!stream_) throw Error({"cannot be written", file, "choose another --csv"});
  stream_ << csv_header() << std::endl;
}

FrameCsv::~FrameCsv() { write(); }

void FrameCsv::add(const FrameLine& line) {
  if (!start_) start_ = written_ = line.tick;
  pending_ += csv_line(line, *start_) + '\n';
  if (line.tick - written_ < kWrite) return;
  written_ = line.tick;
  write();
}

// Whole lines at once: a process that is killed leaves none cut.
void FrameCsv::write() {
  if (!failed_ && !(stream_ << pending_ << std::flush)) {
    failed_ = true;
    log_warning(file_, "cannot be written any more; is the disk full?");
  }
  pending_.clear();
}

}  // namespace vindu::app
