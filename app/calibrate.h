// What the sub-commands of vindu calibrate share: what the cameras saw, live, emulated or from a
// recording; where results go, and how they are told.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate_picture.h"
#include "app/calibrate_progress.h"
#include "app/commands.h"
#include "core/calibration.h"
#include "simulator/emulated_capture.h"
#include "tracker/calibration/wand.h"

namespace vindu::app {

struct CalibrateOptions {
  std::string wall_file;
  std::string from;  ///< recording
  std::optional<double> seconds;
  std::uint64_t seed = 52;
  double noise_px = 0.6;  ///< of emulated cameras
  bool json = false;
  bool dry_run = false;
  std::string picture;  ///< file
};

/// --wall, --from, --seconds, --seed, --noise-px, --json, --dry-run
void add_calibrate_options(CLI::App& app, CalibrateOptions& options);
/// --picture; `what` it shows.
void add_picture_option(CLI::App& app, CalibrateOptions& options, const std::string& what);

/// What was seen and, where all cameras are emulated, what is true: near to what the wall file says
/// without its calibration, the same for each calibration of one seed.
struct Calibrating {
  Site site;
  Capture capture{};
  std::string recording{};  ///< empty: of emulated cameras, or of video cameras alone
  std::optional<HiddenTruth> truth{};
};

struct CaptureWish {
  std::string name;     ///< of the calibration: of the recording's file
  double seconds = 60;  ///< for emulated cameras
  std::string request;  ///< what people are asked to do
  /// What emulated cameras are shown; the site's cameras are the true ones. Begins at 0.
  std::function<LedBody(const Site& truth)> body;
  Progress progress{};  ///< for a line on the terminal; asked every half second
  /// Given what was seen so far, ten times a second; false: that is enough.
  std::function<bool(const Capture& so_far)> watching{};
  bool known_cameras = false;  ///< emulated ones are what and where the wall file says
};

/// Looks, and calibrates by what was seen: a recording's, or the emulated cameras', or, until
/// --seconds or Ctrl-C, the live cameras'; their Wiimotes are recorded beside the wall file. Throws
/// Error, which names that recording. Returns 0.
int calibrate(const CalibrateOptions& options, const Site& site, const CaptureWish& wish,
              const std::function<void(const Calibrating& run)>& by_what_was_seen);

/// "2010-06-01 12:00 UTC"
std::string date_now();

/// On the terminal; with --json they are in the figures.
void print_warnings(const std::vector<std::string>& warnings);
/// "warnings":[...],"truth":TRUTH as every calibration's JSON ends; without the truth where that is
/// empty.
std::string end_of_json(const std::vector<std::string>& warnings, const std::string& truth);

/// Writes it unless --dry-run or no wall file was named, and says where, or why not.
void write(const CalibrateOptions& options, const std::vector<CameraCalibration>& cameras);
void write(const CalibrateOptions& options, const HeadCalibration& head);

/// Where in its picture a camera has had dots so far.
Coverage coverage_so_far(const Capture& capture, std::size_t camera, const Site& site);
/// Progress of a camera in which something is waved.
std::string covered_so_far(const Capture& capture, std::size_t camera, const Site& site);

/// Draws them where --picture asks for it, and says where.
void draw(const CalibrateOptions& options, const std::vector<CoveragePanel>& panels);

void add_calibrate_wand(CLI::App& calibrate, Action& chosen);
void add_calibrate_intrinsics(CLI::App& calibrate, Action& chosen);
void add_calibrate_extrinsics(CLI::App& calibrate, Action& chosen);
void add_calibrate_wall(CLI::App& calibrate, Action& chosen);
void add_calibrate_head(CLI::App& calibrate, Action& chosen);
void add_calibrate_background(CLI::App& calibrate, Action& chosen);

}  // namespace vindu::app
