// What the sub-commands of vindu calibrate share: what the cameras saw, live, emulated or from a
// recording; where results go.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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
};

/// --wall, --from, --seconds, --seed, --noise-px, --json, --dry-run
void add_calibrate_options(CLI::App& app, CalibrateOptions& options);

/// What was seen and, where all cameras are emulated, what is true: near to what the wall file says
/// without its calibration, the same for each calibration of one seed.
struct Calibrating {
  Site site;
  std::string wall_file;  ///< empty: the one that comes with Vindu, beside which nothing is written
  Capture capture;
  std::string recording;
  std::optional<HiddenTruth> truth;
};

struct CaptureWish {
  std::string name;     ///< of the calibration: of the recording's file
  double seconds = 60;  ///< for emulated cameras
  std::string request;  ///< what people are asked to do
  /// What emulated cameras are shown; the site's cameras are the true ones. Begins at 0.
  std::function<LedBody(const Site& truth)> body;
  /// How far it is, for a line on the terminal; given every half second.
  std::function<std::string(const Capture& so_far)> progress;
  /// Given what was seen so far, ten times a second; false: that is enough.
  std::function<bool(const Capture& so_far)> watching{};
  bool known_cameras = false;  ///< emulated ones are what and where the wall file says
};

/// A recording's, or the emulated cameras', or, until --seconds or Ctrl-C, the live cameras'; these
/// are recorded beside the wall file. Throws Error.
Calibrating capture(const CalibrateOptions& options, const CaptureWish& wish);

/// "2010-06-01 12:00 UTC"
std::string date_now();

/// Writes it unless --dry-run or no wall file was named, and says where, or why not.
void write(const CalibrateOptions& options, const Calibrating& run,
           const std::vector<CameraCalibration>& cameras);
void write(const CalibrateOptions& options, const Calibrating& run, const HeadCalibration& head);

/// Share of the picture that a camera's dots have covered so far.
double coverage_so_far(const Capture& capture, std::size_t camera, const Site& site);

void add_calibrate_wand(CLI::App& calibrate, Action& chosen);
void add_calibrate_intrinsics(CLI::App& calibrate, Action& chosen);
void add_calibrate_extrinsics(CLI::App& calibrate, Action& chosen);
void add_calibrate_wall(CLI::App& calibrate, Action& chosen);
void add_calibrate_head(CLI::App& calibrate, Action& chosen);
void add_calibrate_background(CLI::App& calibrate, Action& chosen);

}  // namespace vindu::app
