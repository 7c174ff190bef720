#include "core/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/internal/calibration_reader.h"
#include "core/internal/plausible.h"
#include "core/internal/toml_table.h"

namespace vindu {
namespace {

using internal::Problems;
using internal::Range;
using internal::TomlTable;

constexpr Range kRotationsRange{0, 270};

/// Mount fields of a table on top of what holds for the whole wall.
TileMount read_mount(TomlTable& table, TileMount mount) {
  mount.mirror = table.boolean("mirror").value_or(mount.mirror);
  mount.rotate_deg = table.integer("rotate_deg", kRotationsRange).value_or(mount.rotate_deg);
  if (mount.rotate_deg % 90 != 0)
    table.fail("rotate_deg",
               "is " + std::to_string(mount.rotate_deg) + "; 0, 90, 180 or 270 is allowed");
  return mount;
}

/// Pictures must be left between them.
void check_bezels(TomlTable& table, const std::string& field, double bezel_mm, int count,
                  double size_mm) {
  if (count > 0 && bezel_mm * count >= size_mm)
    table.fail(field, fmt::format("is {}; less than {:.1f} is allowed, {:.0f} mm for {} bezels",
                                  bezel_mm, size_mm / count, size_mm, count));
}

WallGrid read_grid(TomlTable& table) {
  for (const char* name : {"columns", "rows"}) table.require(name, "4");
  for (const char* name : {"width_m", "height_m"}) table.require(name, "2.238");
  for (const char* name : {"tile_width_px", "tile_height_px"}) table.require(name, "1024");
  WallGrid grid;
  grid.columns = table.integer("columns", {1, 64}).value_or(1);
  grid.rows = table.integer("rows", {1, 64}).value_or(1);
  grid.width_m = table.number("width_m", {0.01, 100}).value_or(1);
  grid.height_m = table.number("height_m", {0.01, 100}).value_or(1);
  grid.tile_width_px = table.integer("tile_width_px", {8, 16384}).value_or(8);
  grid.tile_height_px = table.integer("tile_height_px", {8, 16384}).value_or(8);
  grid.bezel_x_mm = table.number("bezel_x_mm", {0, 1000}).value_or(0);
  grid.bezel_y_mm = table.number("bezel_y_mm", {0, 1000}).value_or(0);
  grid.curve_deg = table.number("curve_deg", {0, 180}).value_or(0);
  if (const int most_deg = 90 * (grid.columns - 1); grid.curve_deg > most_deg && most_deg > 0)
    table.fail("curve_deg", fmt::format("is {}; from 0 to {} is allowed for {} columns, 90 degrees "
                                        "from each to the next",
                                        grid.curve_deg, most_deg, grid.columns));
  grid.hosts = table.text("hosts").value_or(grid.hosts);
  grid.mount = read_mount(table, {});
  check_bezels(table, "bezel_x_mm", grid.bezel_x_mm, grid.columns - 1, 1e3 * grid.width_m);
  check_bezels(table, "bezel_y_mm", grid.bezel_y_mm, grid.rows - 1, 1e3 * grid.height_m);
  return grid;
}

/// Corners must span a screen: edges of some length, within 2 degrees of a right angle.
void check_corners(TomlTable& table, const TileCorners& corners) {
  if (corners.width_m() < 1e-3 || corners.height_m() < 1e-3)
    return table.fail("lower_left_m",
                      fmt::format("the edges are {:.4f} and {:.4f} m long; at least 0.001 m is "
                                  "allowed; measure the corners again",
                                  corners.width_m(), corners.height_m()));
  const Vec3 right = (corners.lower_right_in_wall - corners.lower_left_in_wall).normalized();
  const Vec3 up = (corners.upper_left_in_wall - corners.lower_left_in_wall).normalized();
  const double angle_deg = degrees(std::acos(std::clamp(right.dot(up), -1.0, 1.0)));
  if (std::abs(angle_deg - 90) > 2)
    table.fail(
        "lower_left_m",
        fmt::format("the edges meet at {:.1f} degrees; from 88 to 92 is allowed; measure the "
                    "corners again",
                    angle_deg));
}

std::optional<TileCorners> read_corners(TomlTable& table) {
  const auto lower_left = table.vec3("lower_left_m");
  const auto lower_right = table.vec3("lower_right_m");
  const auto upper_left = table.vec3("upper_left_m");
  if (!lower_left && !lower_right && !upper_left) return std::nullopt;
  if (!lower_left || !lower_right || !upper_left) {
    table.fail("lower_left_m",
               "a tile's own place needs lower_left_m, lower_right_m and upper_left_m together");
    return std::nullopt;
  }
  const TileCorners corners{*lower_left, *lower_right, *upper_left};
  check_corners(table, corners);
  return corners;
}

std::vector<TileOverride> read_overrides(TomlTable& root, const WallGrid& grid) {
  std::vector<std::string> names;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) names.push_back(tile_name(column, row));
  std::vector<TileOverride> overrides;
  for (TomlTable& table : root.tables("tile")) {
    table.require("name", "\"tile-0-0\"");
    TileOverride change;
    change.name = table.one_of("name", names).value_or("");
    if (!change.name.empty() &&
        std::ranges::find(overrides, change.name, &TileOverride::name) != overrides.end())
      table.fail("name",
                 "\"" + change.name + "\" is described twice; put its fields into one [[tile]]");
    change.host = table.text("host");
    change.monitor = table.text("monitor");
    change.corners = read_corners(table);
    change.mount = read_mount(table, grid.mount);
    table.finish();
    overrides.push_back(std::move(change));
  }
  return overrides;
}

void read_wall(TomlTable& root, Site& site) {
  root.require("wall", "{ columns = 7, rows = 4, width_m = 5.185, ... }");
  auto table = root.table("wall");
  if (!table) return;
  const WallGrid grid = read_grid(*table);
  site.rate_hz = table->number("rate_hz", {1, 1000}).value_or(site.rate_hz);
  const double height_m =
      table->number("centre_height_m", {-100, 100}).value_or(kDefaultCentreHeight_m);
  const double tilt_deg = table->number("tilt_deg", {-90, 90}).value_or(0);
  table->finish();
  site.wall = expand_wall(grid, read_overrides(root, grid), room_from_wall_at(height_m, tilt_deg));
}

void read_viewer(TomlTable& root, ViewerConfig& viewer) {
  auto table = root.table("viewer");
  if (!table) return;
  viewer.default_eye_in_wall = table->vec3("default_eye_m").value_or(viewer.default_eye_in_wall);
  viewer.display_latency_ms =
      table->number("display_latency_ms", {0, 1000}).value_or(viewer.display_latency_ms);
  table->finish();
}

HeadConfig read_head(TomlTable& table) {
  HeadConfig head;
  head.name = table.text("name").value_or(head.name);
  head.leds_in_head = table.vec3s("leds_m", 1, 16, {-10, 10}).value_or(head.leds_in_head);
  internal::expect_a_helmet(table, head.leds_in_head);
  head.eye_in_head = table.vec3("eye_m", {-1, 1}).value_or(head.eye_in_head);
  head.use_calibration = table.boolean("calibration").value_or(true);
  table.finish();
  return head;
}

/// One [head], or several [[head]] with names.
void read_heads(TomlTable& root, std::vector<HeadConfig>& heads) {
  if (!root.has("head")) return;
  if (!root.is_list("head")) {
    if (auto table = root.table("head")) heads = {read_head(*table)};
    return;
  }
  heads.clear();
  for (TomlTable& table : root.tables("head")) {
    table.require("name", "\"visitor\"");
    HeadConfig head = read_head(table);
    if (std::ranges::find(heads, head.name, &HeadConfig::name) != heads.end())
      table.fail("name", "\"" + head.name + "\" stands twice; give every head its own name");
    heads.push_back(std::move(head));
  }
  if (heads.empty()) heads.resize(1);
}

void read_tracking(TomlTable& root, Site& site) {
  auto table = root.table("tracking");
  if (!table) return;
  TrackingConfig& tracking = site.tracking;
  tracking.method = table->one_of("method", {"joint", "thesis"}).value_or(tracking.method);
  tracking.mode =
      table->one_of("mode", {"auto", "six-dof", "hybrid", "position"}).value_or(tracking.mode);
  std::vector<std::string> whom = {"nearest", "first"};
  for (const HeadConfig& head : site.heads) whom.push_back(head.name);
  tracking.follow = table->one_of("follow", whom).value_or(tracking.follow);
  table->finish();
}

void read_scene(TomlTable& root, SceneConfig& scene) {
  auto table = root.table("scene");
  if (!table) return;
  scene.model = table->text("model").value_or(scene.model);
  const auto place = table->one_of("place", {"fit", "life-size", "as-is"});
  if (place) scene.place = *placement_from(*place);
  table->finish();
}

void read_touch(TomlTable& root, TouchConfig& touch) {
  auto table = root.table("touch");
  if (!table) return;
  touch.eye_distance_m =
      table->number("eye_distance_m", {0.05, 100}).value_or(touch.eye_distance_m);
  table->finish();
}

FrameLock lock_from(const std::string& name) {
  return name == "timed" ? FrameLock::timed : name == "free" ? FrameLock::free : FrameLock::barrier;
}

/// A name that goes into the network's settings as it is.
std::optional<std::string> read_word(TomlTable& table, const std::string& name) {
  auto word = table.text(name);
  const auto allowed = [](unsigned char c) { return std::isalnum(c) || std::strchr("-_.:", c); };
  if (!word || (word->size() <= 255 && std::ranges::all_of(*word, allowed))) return word;
  table.fail(name, "is \"" + *word + "\"; up to 255 letters, digits and - _ . : are allowed");
  return std::nullopt;
}

void read_cluster(TomlTable& root, ClusterConfig& cluster) {
  auto table = root.table("cluster");
  if (!table) return;
  cluster.name = read_word(*table, "name").value_or(cluster.name);
  cluster.master = read_word(*table, "master").value_or("");
  if (!cluster.master.empty()) cluster.interface.clear();
  cluster.interface = read_word(*table, "interface").value_or(cluster.interface);
  cluster.multicast = table->boolean("multicast").value_or(cluster.multicast);
  cluster.domain = table->integer("domain", {0, 230}).value_or(cluster.domain);
  cluster.swap_group = table->boolean("swap_group").value_or(cluster.swap_group);
  cluster.lock = lock_from(table->one_of("lock", {"barrier", "timed", "free"}).value_or("barrier"));
  cluster.keys = table->text("keys").value_or(cluster.keys);
  if (cluster.interface == "lo" && !cluster.master.empty())
    table->fail("interface", "is \"lo\", which no other host reaches; name the one to " +
                                 cluster.master + ", or leave it out");
  table->finish();
}

BlobOptions read_blob_options(TomlTable& table) {
  BlobOptions blobs;
  blobs.threshold = table.integer("threshold", {1, 254}).value_or(blobs.threshold);
  blobs.min_area_px = table.integer("min_area_px", {1, 1e6}).value_or(blobs.min_area_px);
  blobs.max_area_px = table.integer("max_area_px", {1, 1e6}).value_or(blobs.max_area_px);
  blobs.max_dots = table.integer("max_dots", {1, 16}).value_or(blobs.max_dots);
  if (blobs.min_area_px > blobs.max_area_px)
    table.fail("min_area_px", "leaves no dots: it is more than max_area_px, which is " +
                                  std::to_string(blobs.max_area_px));
  return blobs;
}

VideoConfig read_video(TomlTable& table) {
  VideoConfig video;
  video.device = table.text("device").value_or("");
  video.file = table.text("file").value_or("");
  if (table.has("device") && table.has("file"))
    table.fail("device", "stands beside file; give one of both");
  video.width_px = table.integer("width_px", {16, 16384}).value_or(video.width_px);
  video.height_px = table.integer("height_px", {16, 16384}).value_or(video.height_px);
  video.rate_hz = table.number("rate_hz", {0.1, 2000});
  video.exposure = table.integer("exposure", {0, 1e6});
  video.gain = table.integer("gain", {0, 1e6});
  video.blobs = read_blob_options(table);
  return video;
}

/// A video camera's principal point is the middle of its picture, unless the file knows better.
Intrinsics intrinsics_before_calibration(const CameraConfig& camera) {
  Intrinsics intrinsics;
  if (camera.source != CameraSource::video) return intrinsics;
  intrinsics.cx_px = 0.5 * (camera.video.width_px - 1);
  intrinsics.cy_px = 0.5 * (camera.video.height_px - 1);
  return intrinsics;
}

Intrinsics read_intrinsics(TomlTable& table, Intrinsics intrinsics) {
  intrinsics.fx_px = intrinsics.fy_px =
      table.number("focal_px", {10, 1e5}).value_or(intrinsics.fx_px);
  intrinsics.fy_px *= table.number("focal_aspect", {0.5, 2}).value_or(1);
  if (const auto centre = table.numbers("centre_px", 2, {-1e4, 1e4})) {
    intrinsics.cx_px = (*centre)[0];
    intrinsics.cy_px = (*centre)[1];
  }
  if (const auto values = table.numbers("distortion", 5, {-10, 10}))
    std::ranges::copy(*values, intrinsics.distortion.begin());
  return intrinsics;
}

Rigid3 read_camera_pose(TomlTable& table) {
  table.require("position_m", "[-1.0, 2.3, 5.0]");
  const Vec3 position = table.vec3("position_m").value_or(Vec3::Zero());
  const auto target = table.vec3("look_at_m");
  const auto heading_deg = table.number("heading_deg", {-360, 360});
  const auto pitch_deg = table.number("pitch_deg", {-360, 360});
  const auto roll_deg = table.number("roll_deg", {-360, 360});
  const bool angles = heading_deg || pitch_deg || roll_deg;
  if (angles && target)
    table.fail("look_at_m", "stands beside heading_deg, pitch_deg or roll_deg; give one of both");
  if (angles)
    return camera_from_thesis_angles(position, radians(heading_deg.value_or(0)),
                                     radians(pitch_deg.value_or(90)),
                                     radians(roll_deg.value_or(0)));
  if (!target) {
    if (!table.has("look_at_m"))
      table.fail(
          "look_at_m",
          "is missing; write look_at_m = [0, 1.65, 2.0], or heading_deg, pitch_deg, roll_deg");
    return {};
  }
  if ((*target - position).norm() < 1e-3)
    table.fail("look_at_m", fmt::format("is {:.4f} m from position_m; at least 0.001 m is allowed",
                                        (*target - position).norm()));
  return look_at(position, *target);
}

CameraSource source_from(const std::string& name) {
  return name == "wiimote" ? CameraSource::wiimote
         : name == "video" ? CameraSource::video
                           : CameraSource::emulated;
}

void read_wiimote(TomlTable& table, CameraConfig& camera) {
  camera.address = table.text("address").value_or("");
  if (const auto text = table.text("sensitivity")) {
    const auto sensitivity = sensitivity_from(*text);
    if (!sensitivity)
      table.fail("sensitivity", "is \"" + *text + "\"; allowed: " + sensitivity_names() +
                                    ", or 22 hexadecimal digits (blocks 1 and 2)");
    camera.sensitivity = sensitivity.value_or(camera.sensitivity);
  }
  if (const auto name = table.one_of("dot_format", {"basic", "extended", "full"}))
    camera.dot_format = *ir_format_from(*name);
}

bool same_but_for_case(const std::string& one, const std::string& other) {
  const auto small = [](unsigned char letter) { return std::tolower(letter); };
  return std::ranges::equal(one, other, {}, small, small);
}

/// One device cannot be two cameras; emulated ones have none.
void refuse_shared_device(TomlTable& table, const CameraConfig& camera,
                          const std::vector<CameraConfig>& before) {
  for (const CameraConfig& other : before) {
    if (other.source != camera.source || camera.source == CameraSource::emulated) continue;
    const bool wiimote = camera.source == CameraSource::wiimote;
    const std::string& own = wiimote ? camera.address : camera.video.device;
    const std::string& taken = wiimote ? other.address : other.video.device;
    if (!own.empty() && same_but_for_case(own, taken))
      table.fail(wiimote ? "address" : "device", "\"" + own + "\" is that of \"" + other.name +
                                                     "\", too; give every camera its own device");
  }
}

/// Fields of another source are not known, except that an emulated camera may stand in for any.
void read_cameras(TomlTable& root, std::vector<CameraConfig>& cameras) {
  for (TomlTable& table : root.tables("camera")) {
    table.require("name", "\"left\"");
    table.require("source", "\"emulated\"");
    CameraConfig camera;
    camera.name = table.text("name").value_or("");
    if (!camera.name.empty() &&
        std::ranges::find(cameras, camera.name, &CameraConfig::name) != cameras.end())
      table.fail("name", "\"" + camera.name + "\" stands twice; give every camera its own name");
    const auto source = table.one_of("source", {"emulated", "wiimote", "video"});
    camera.source = source_from(source.value_or("emulated"));
    if (camera.source != CameraSource::wiimote) camera.video = read_video(table);
    if (camera.source != CameraSource::video) read_wiimote(table, camera);
    if (camera.source == CameraSource::video && !table.has("device") && !table.has("file"))
      table.fail("device", "is missing; write device = \"/dev/video0\", or file for a video");
    camera.lag_ms = table.number("lag_ms", {-1000, 1000}).value_or(camera.lag_ms);
    camera.intrinsics = read_intrinsics(table, intrinsics_before_calibration(camera));
    internal::expect_a_view(table, camera);
    camera.room_from_camera = read_camera_pose(table);
    camera.use_calibration = table.boolean("calibration").value_or(true);
    refuse_shared_device(table, camera, cameras);
    table.finish();
    if (cameras.size() == kMaxCameras)
      table.fail("name", fmt::format("is that of one camera too many; {} are tracked at most",
                                     kMaxCameras));
    cameras.push_back(std::move(camera));
  }
}

Site site_of(const toml::table& parsed, const std::string& file) {
  Problems problems(file);
  TomlTable root(parsed, "", problems);
  Site site;
  read_wall(root, site);
  read_viewer(root, site.viewer);
  read_heads(root, site.heads);
  read_tracking(root, site);
  read_scene(root, site.scene);
  read_cluster(root, site.cluster);
  read_touch(root, site.touch);
  read_cameras(root, site.cameras);
  internal::apply_calibrations(root, site);
  root.has("tile");  // read with the wall, known even where that failed
  root.finish();
  problems.throw_if_any();
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (!site.scene.model.empty()) site.scene.model = (folder / site.scene.model).string();
  if (!site.cluster.keys.empty()) site.cluster.keys = (folder / site.cluster.keys).string();
  for (CameraConfig& camera : site.cameras)
    if (!camera.video.file.empty()) camera.video.file = (folder / camera.video.file).string();
  return site;
}

}  // namespace

Site read_site(const std::string& file) {
  Site site = site_of(internal::parse_toml_file(file), file);
  internal::apply_calibration_files(file, site);
  return site;
}

Site parse_site(const std::string& text, const std::string& file) {
  return site_of(internal::parse_toml_text(text, file), file);
}

std::string name_of(CameraSource source) {
  return source == CameraSource::wiimote ? "wiimote"
         : source == CameraSource::video ? "video"
                                         : "emulated";
}

std::string name_of(Placement placement) {
  constexpr const char* kNames[] = {"fit", "life-size", "as-is"};
  return kNames[static_cast<int>(placement)];
}

std::optional<Placement> placement_from(std::string_view name) {
  if (name == "fit") return Placement::fit;
  if (name == "life-size") return Placement::life_size;
  if (name == "as-is") return Placement::as_is;
  return std::nullopt;
}

Rigid3 look_at(const Vec3& position_in_room, const Vec3& target_in_room) {
  const Vec3 forward = (target_in_room - position_in_room).normalized();
  const bool vertical = std::abs(forward.y()) > 1 - 1e-9;
  const Vec3 up = vertical ? Vec3(0, 0, std::copysign(1.0, forward.y())) : Vec3(0, 1, 0);
  const Vec3 right = forward.cross(up).normalized();
  Mat3 rotation;
  rotation << right, forward.cross(right), forward;
  return Rigid3::from(rotation, position_in_room);
}

Rigid3 camera_from_thesis_angles(const Vec3& position_in_room, double heading_rad, double pitch_rad,
                                 double roll_rad) {
  const Mat3 upright_from_opencv = Vec3(1, -1, -1).asDiagonal();
  return Rigid3::from(room_from_thesis_world() * thesis_rotation(heading_rad, pitch_rad, roll_rad) *
                          upright_from_opencv,
                      position_in_room);
}

}  // namespace vindu
