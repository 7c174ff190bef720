// One file describes a site: wall.toml, as plain values with defaults. Reading checks every field
// and reports all errors at once, each with file, line, field, value and what is allowed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/infrared.h"
#include "core/wall.h"

namespace vindu {

/// OpenCV's pinhole model with distortion; pixels.
struct Intrinsics {
  double fx_px = 1335;  ///< a Wiimote's: published values span 1280 to 1430
  double fy_px = 1335;
  double cx_px = 512;
  double cy_px = 384;
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3

  bool operator==(const Intrinsics&) const = default;
};

/// Where calibrated values come from and how good they are; zero sigma: not known.
struct CalibrationNote {
  std::string method;     ///< "wand", "intrinsics", "extrinsics", "wall", "head"
  std::string date;       ///< "2010-06-01 12:00 UTC"
  std::string recording;  ///< that it rests on; empty: live
  double rms_px = 0;
  double focal_sigma_px = 0;
  double position_sigma_mm = 0;  ///< of all three coordinates together
  double rotation_sigma_deg = 0;

  bool operator==(const CalibrationNote&) const = default;
};

enum class CameraSource { emulated, wiimote, video };

/// Which spots of an infrared picture are dots.
struct BlobOptions {
  int threshold = 64;      ///< grey value, 0..255, that a pixel must exceed
  int min_area_px = 3;     ///< pixels; less is noise
  int max_area_px = 2000;  ///< more is a lamp or a window
  int max_dots = 16;       ///< the brightest
};

/// A V4L2 camera, or a video file in its place. What is not given stays as the camera has it.
struct VideoConfig {
  std::string device;  ///< "/dev/video0"; empty: there is a file
  std::string file;    ///< or a sequence of pictures, "frames/%04d.png"
  int width_px = 640;
  int height_px = 480;
  std::optional<double> rate_hz;  ///< of a file: in place of its own frame times
  std::optional<int> exposure;    ///< as the driver counts it; 100 us where it follows V4L2
  std::optional<int> gain;        ///< as the driver counts it
  BlobOptions blobs;
};

constexpr std::size_t kMaxCameras = 16;  ///< that are tracked with

struct CameraConfig {
  std::string name;
  CameraSource source = CameraSource::emulated;
  std::string address;                                               ///< of a Wiimote; empty: any
  Sensitivity sensitivity = *sensitivity_from(kDefaultSensitivity);  ///< of a Wiimote
  IrFormat dot_format = IrFormat::extended;                          ///< of a Wiimote
  VideoConfig video;                                                 ///< where that is the source
  double lag_ms = 0;  ///< from the light to the report's arrival, at the least
  Intrinsics intrinsics;
  Rigid3 room_from_camera;       ///< camera: +x right, +y down, +z along the optical axis
  std::vector<Vec2> masks_px{};  ///< raw: reflections and lamps, where no dot is an LED
  bool use_calibration = true;
  std::optional<CalibrationNote> calibration{};  ///< of what was laid over the wall file's values
};

/// The tracked head: its LEDs and the point between both eyes, in head (+x right, +y up, -z
/// forward; metres).
struct HeadConfig {
  std::string name = "head";
  std::vector<Vec3> leds_in_head = {{-0.09, 0, -0.09}, {0, 0, 0}, {0.09, 0, -0.09}};
  Vec3 eye_in_head = {0, -0.10, -0.19};
  bool use_calibration = true;
  std::optional<CalibrationNote> calibration{};
};

struct TrackingConfig {
  std::string method = "joint";    ///< or "thesis"
  std::string mode = "auto";       ///< the least that is good enough: six-dof, hybrid, position
  std::string follow = "nearest";  ///< which head the wall shows: nearest, first, or its name
};

struct ViewerConfig {
  Vec3 default_eye_in_wall = {0, 0.10, 2.0};
  double display_latency_ms = 0;  ///< from the swap to the light
};

enum class Placement {
  fit,        ///< scaled to the wall
  life_size,  ///< in metres, if the file states its unit
  as_is,      ///< the model's coordinates are wall coordinates in metres
};

struct SceneConfig {
  std::string model;  ///< path, relative to the wall file; empty: none
  Placement place = Placement::fit;
};

/// What holds the tiles' pictures together.
enum class FrameLock {
  barrier,  ///< all swap when the slowest living tile is ready
  timed,    ///< the same, at a time that the master says
  free,     ///< each tile swaps when it likes
};

/// How the wall's processes find and hear each other.
struct ClusterConfig {
  std::string name = "wall";     ///< walls of different names share a network unseen
  std::string master{};          ///< host; empty: all processes are on this machine
  std::string interface = "lo";  ///< of the network; empty: chosen by DDS
  bool multicast = true;
  int domain = 0;  ///< of DDS: which UDP ports
  FrameLock lock = FrameLock::barrier;
  bool swap_group = false;  ///< graphics cards with a sync board swap together by wire
  std::string keys{};  ///< folder, made by vindu keys; empty: whoever is on the network takes part
};

/// The mode touch: the eye follows the hand.
struct TouchConfig {
  double eye_distance_m =
      2;  ///< of the eye from the point that is touched, along its tile's normal
};

struct Site {
  Wall wall;
  double rate_hz = 60;
  ViewerConfig viewer;
  std::vector<HeadConfig> heads = std::vector<HeadConfig>(1);  ///< one or more
  TrackingConfig tracking;
  std::vector<CameraConfig> cameras;
  SceneConfig scene;
  ClusterConfig cluster;
  TouchConfig touch;
};

/// With its calibration (core/calibration.h). Throws Error with one line for each thing that is
/// wrong.
Site read_site(const std::string& file);
/// The same of a wall file's text, as a recording holds it; `file` is its name in messages, and
/// what its paths are relative to.
Site parse_site(const std::string& text, const std::string& file);

/// `source` for people: "emulated", "wiimote", "video".
std::string name_of(CameraSource source);

std::string name_of(Placement placement);
/// Empty for a name that none has.
std::optional<Placement> placement_from(std::string_view name);

/// Camera that stands at `position_in_room` and looks at a point, its image upright; straight up or
/// down, as somebody sees it who faces the wall.
Rigid3 look_at(const Vec3& position_in_room, const Vec3& target_in_room);

/// Camera with the thesis' angles, its position already in room.
Rigid3 camera_from_thesis_angles(const Vec3& position_in_room, double heading_rad, double pitch_rad,
                                 double roll_rad);

}  // namespace vindu
