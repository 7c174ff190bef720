// vindu plan: where the head can be tracked with given cameras and helmet, how exactly, and where N
// cameras would stand best; as figures, picture, and cameras for the wall file.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/common.h"
#include "app/plan_picture.h"
#include "core/error.h"
#include "simulator/led_sight.h"

namespace vindu::app {
namespace {

struct PlanOptions {
  std::string wall_file;
  std::vector<double> area, room, heights;
  double yaw_deg = 40;
  double rail_height_m = 2.3;
  double ceiling_m = 2.6;
  double good_mm = 10;
  double noise_px = kDotNoise_px;
  int propose = 0;
  std::string out = "out/plan.png";
  bool json = false;
};

/// Throws CLI::ValidationError (called wrong) unless the text is finite numbers with commas, within
/// these counts.
std::vector<double> parse_numbers(const std::string& name, const std::string& text,
                                  std::size_t least, std::size_t most) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool good = error == std::errc{} && std::abs(value) < 1e3;
    if (good) values.push_back(value);
    if (good && next == end && values.size() >= least && values.size() <= most) return values;
    if (!good || next == end || *next != ',')
      throw CLI::ValidationError(name, "\"" + text + "\" is not what it takes: metres with commas");
    at = next + 1;
  }
}

void check_rectangle(const std::string& name, const std::vector<double>& values) {
  if (!values.empty() && (values[0] >= values[2] || values[1] >= values[3]))
    throw CLI::ValidationError(name, "must be x0,z0,x1,z1 with x0 < x1 and z0 < z1");
}

struct Plan {
  Site site;
  WalkingArea area;
  std::vector<Rail> rails;
  DotNoise noise;
};

/// Rails at the room's walls behind and beside the area, from where somebody in front of it can be
/// seen from behind; the room's four upper corners.
std::vector<Rail> rails_of(const Vec2& least, const Vec2& largest, const PlanOptions& options) {
  const double y = options.rail_height_m, top = options.ceiling_m;
  const Vec3 left(least.x(), y, largest.y()), right(largest.x(), y, largest.y());
  std::vector<Rail> rails = {
      {left, right}, {{least.x(), y, least.y()}, left}, {{largest.x(), y, least.y()}, right}};
  for (const double x : {least.x(), largest.x()})
    for (const double z : {least.y(), largest.y()}) rails.push_back({{x, top, z}, {x, top, z}});
  return rails;
}

/// Throws Error for an area of which every point is behind all tiles.
void expect_before_the_wall(const std::vector<double>& area, const Site& site,
                            const std::vector<double>& eye_heights_m) {
  double wall_z_m = 0;  // in wall
  for (const Tile& tile : site.wall.tiles)
    for (const Vec3& corner : {tile.corners.lower_left_in_wall, tile.corners.lower_right_in_wall,
                               tile.corners.upper_left_in_wall, tile.corners.upper_right_in_wall()})
      wall_z_m = std::min(wall_z_m, corner.z());
  const Rigid3 wall_from_room = inverse(site.wall.room_from_wall);
  for (const double y : eye_heights_m)
    if ((wall_from_room * Vec3(area[0], y, area[3])).z() > wall_z_m) return;
  throw Error(
      {fmt::format("{:g},{:g},{:g},{:g} lies behind the wall", area[0], area[1], area[2], area[3]),
       "--area", "z grows from the wall towards the viewers: as in -1.5,1,1.5,3"});
}

Plan plan_of(const PlanOptions& options) {
  constexpr double kAside_m = 1.2, kBehind_m = 2.0;
  Plan plan{load_site(options.wall_file), {}, {}, {}};
  plan.area = area_before(plan.site);
  plan.area.yaw_deg = options.yaw_deg;
  if (!options.heights.empty()) plan.area.eye_heights_m = options.heights;
  if (!options.area.empty()) {
    expect_before_the_wall(options.area, plan.site, plan.area.eye_heights_m);
    plan.area.least_in_room = {options.area[0], options.area[1]};
    plan.area.largest_in_room = {options.area[2], options.area[3]};
  }
  Vec2 least(plan.area.least_in_room.x() - kAside_m, 0);
  Vec2 largest = plan.area.largest_in_room + Vec2(kAside_m, kBehind_m);
  if (!options.room.empty()) {
    least = {options.room[0], options.room[1]};
    largest = {options.room[2], options.room[3]};
  }
  plan.rails = rails_of(least, largest, options);
  plan.noise = helmet_dot_noise(plan.site.heads.front(), options.noise_px);
  return plan;
}

/// A camera like the wall file's first, but for what is its own; else a Wiimote.
CameraConfig lens_of(const Site& site) {
  CameraConfig camera;
  if (site.cameras.empty()) return camera;
  const CameraConfig& first = site.cameras.front();
  if (first.source == CameraSource::video) camera.source = CameraSource::video;
  camera.video = first.video;
  camera.intrinsics = first.intrinsics;
  camera.intrinsics.fy_px = camera.intrinsics.fx_px;
  camera.intrinsics.distortion = {};
  return camera;
}

/// The pose grid of the search is coarser than the study's.
PlacementTask task_of(const Plan& plan, const PlanOptions& options) {
  constexpr double kPlaces = 14;  // along the longer side
  constexpr int kYaws = 5, kAimsAcross = 5, kAimsDeep = 3;
  const WalkingArea& area = plan.area;
  const Vec2 size_m = area.largest_in_room - area.least_in_room;
  const auto [lowest_m, highest_m] = std::ranges::minmax(area.eye_heights_m);
  PlacementTask task;
  task.head = plan.site.heads.front();
  task.poses = poses_in(area, size_m.maxCoeff() / kPlaces, kYaws, task.head);
  task.rails = plan.rails;
  for (int i = 0; i < kAimsAcross; ++i)
    for (int k = 0; k < kAimsDeep; ++k)
      task.aims_in_room.emplace_back(area.least_in_room.x() + size_m.x() * (i + 0.5) / kAimsAcross,
                                     0.5 * (lowest_m + highest_m),
                                     area.least_in_room.y() + size_m.y() * (k + 0.5) / kAimsDeep);
  task.camera = lens_of(plan.site);
  const Rail& back = plan.rails.front();
  task.spacing_m = std::max(0.4, (back.to_in_room - back.from_in_room).norm() / 20);
  task.spacing_m = std::max(task.spacing_m, size_m.maxCoeff() / 15);
  task.good_eye_m = 1e-3 * options.good_mm;
  return task;
}

std::vector<CameraConfig> propose(const Plan& plan, const PlanOptions& options) {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto progress = [&](double share) {
    if (terminal)
      fmt::print(stderr, "\rplacing {} cameras: {:3.0f} %{}", options.propose, 100 * share,
                 share >= 1 ? "\n" : "");
  };
  return place_cameras(task_of(plan, options), options.propose, plan.noise, progress);
}

/// To the centimetre, as one can measure it.
std::string toml_vec(const Vec3& v) {
  const auto rounded = [](double value) { return std::round(100 * value) / 100 + 0.0; };
  return fmt::format("[{:.2f}, {:.2f}, {:.2f}]", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

/// A point that the camera looks at, about as far as people stand.
Vec3 aim_of(const CameraConfig& camera) { return camera.room_from_camera * Vec3(0, 0, 3); }

std::string toml_of(const CameraConfig& camera) {
  const Intrinsics& lens = camera.intrinsics;
  const bool video = camera.source == CameraSource::video;
  const std::string source = video ? fmt::format(
                                         "\"video\"\ndevice = \"/dev/video0\"  # each its own\n"
                                         "width_px = {}\nheight_px = {}",
                                         camera.video.width_px, camera.video.height_px)
                                   : "\"emulated\"  # \"wiimote\" with a real one";
  return fmt::format(
      "[[camera]]\nname = \"{}\"\nsource = {}\n"
      "position_m = {}\nlook_at_m = {}\nfocal_px = {}\ncentre_px = [{}, {}]\n\n",
      camera.name, source, toml_vec(camera.room_from_camera.translation), toml_vec(aim_of(camera)),
      lens.fx_px, lens.cx_px, lens.cy_px);
}

void print_study(std::FILE* to, const std::string& title, const Study& study,
                 const PlanOptions& options) {
  fmt::print(to,
             "{}: six-dof within {:g} mm in {:.1f} % of the poses; at every heading on {:.1f} m2\n",
             title, options.good_mm, 100 * study.covered_share, study.always_covered_m2);
  fmt::print(to, "  {:<10}{:>9}{:>14}{:>10}{:>12}{:>10}{:>12}\n", "", "share", "eye median", "p95",
             "lateral", "depth", "rotation");
  for (int level = 0; level < kLevels; ++level) {
    if (level == static_cast<int>(TrackingLevel::held)) continue;
    const LevelFigures& row = study.levels[level];
    fmt::print(to, "  {:<10}{:>7.1f} %", name_of(static_cast<TrackingLevel>(level)),
               100 * row.share);
    if (row.eye_median_m > 0)
      fmt::print(to, "{:>11.1f} mm{:>7.1f} mm{:>9.1f} mm{:>7.1f} mm{:>8.1f} deg",
                 1e3 * row.eye_median_m, 1e3 * row.eye_p95_m, 1e3 * row.lateral_median_m,
                 1e3 * row.depth_median_m, degrees(row.rotation_median_rad));
    fmt::print(to, "\n");
  }
}

std::string json_of(const Study& study) {
  std::string cameras, levels;
  for (const CameraConfig& camera : study.cameras)
    cameras += fmt::format(R"({}{{"name":{},"position_m":{},"look_at_m":{}}})",
                           cameras.empty() ? "" : ",", json_text(camera.name),
                           json_vec(camera.room_from_camera.translation), json_vec(aim_of(camera)));
  for (int level = 0; level < kLevels; ++level) {
    if (level == static_cast<int>(TrackingLevel::held)) continue;
    const LevelFigures& row = study.levels[level];
    levels += fmt::format(R"({}"{}":{{"share":{})", levels.empty() ? "" : ",",
                          name_of(static_cast<TrackingLevel>(level)), row.share);
    if (row.eye_median_m > 0)
      levels += fmt::format(
          R"(,"eye_median_mm":{},"eye_p95_mm":{},"lateral_mm":{},"depth_mm":{},"rotation_deg":{})",
          1e3 * row.eye_median_m, 1e3 * row.eye_p95_m, 1e3 * row.lateral_median_m,
          1e3 * row.depth_median_m, degrees(row.rotation_median_rad));
    levels += "}";
  }
  return fmt::format(
      R"({{"cameras":[{}],"covered_share":{},"always_covered_m2":{},"levels":{{{}}}}})", cameras,
      study.covered_share, study.always_covered_m2, levels);
}

void print_json(const Plan& plan, const PlanOptions& options, const Study& now,
                const std::optional<Study>& proposal) {
  const WalkingArea& area = plan.area;
  fmt::print(R"({{"area_m":[{},{},{},{}],"eye_heights_m":[{}],"yaw_deg":{},"good_mm":{},"now":{})",
             area.least_in_room.x(), area.least_in_room.y(), area.largest_in_room.x(),
             area.largest_in_room.y(), fmt::join(area.eye_heights_m, ","), area.yaw_deg,
             options.good_mm, json_of(now));
  if (proposal) fmt::print(R"(,"proposal":{})", json_of(*proposal));
  fmt::print(R"(,"picture":{}}})"
             "\n",
             json_text(options.out));
}

void draw(const Plan& plan, const PlanOptions& options, const Study& study) {
  const WalkingArea& area = plan.area;
  const Vec2 size_m = area.largest_in_room - area.least_in_room;
  const PlanText text{
      fmt::format("{} camera{} before a wall of {:.2f} m{}", study.cameras.size(),
                  study.cameras.size() == 1 ? "" : "s", plan.site.wall.grid.width_m,
                  options.propose ? ", as proposed" : ""),
      fmt::format("Of a walking area of {:.1f} x {:.1f} m, {:.0f} % is covered: six-dof, the eye "
                  "within {:g} mm. Headings -{:g} to {:g} degrees, eyes at {:.2f} m.",
                  size_m.x(), size_m.y(), 100 * study.covered_share, options.good_mm, area.yaw_deg,
                  area.yaw_deg, fmt::join(area.eye_heights_m, " and "))};
  const auto folder = std::filesystem::path(options.out).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  write_png(plan_picture(plan.site, area, study, text), options.out);
}

int run_plan(const PlanOptions& options) {
  const Plan plan = plan_of(options);
  const auto of = [&](const std::vector<CameraConfig>& cameras) {
    return study(cameras, plan.site.heads.front(), plan.noise, plan.area, 1e-3 * options.good_mm);
  };
  if (plan.site.cameras.empty() && options.propose == 0)
    throw Error(
        {"has no [[camera]]", options.wall_file, "add some, or let --propose 2 find places"});
  const Study now = of(plan.site.cameras);
  std::optional<Study> proposal;
  if (options.propose > 0) proposal = of(propose(plan, options));
  draw(plan, options, proposal ? *proposal : now);
  if (options.json) {
    print_json(plan, options, now, proposal);
    return 0;
  }
  // Cameras that are proposed are for a wall file; what else is said must not come between.
  std::FILE* const to = proposal ? stderr : stdout;
  fmt::print(to, "Walking area x {:.2f} to {:.2f}, z {:.2f} to {:.2f} m in room ({:.1f} m2)\n",
             plan.area.least_in_room.x(), plan.area.largest_in_room.x(),
             plan.area.least_in_room.y(), plan.area.largest_in_room.y(), plan.area.size_m2());
  if (!plan.site.cameras.empty())
    print_study(to, fmt::format("{} cameras of the wall file", plan.site.cameras.size()), now,
                options);
  if (proposal)
    print_study(to, fmt::format("{} cameras proposed", options.propose), *proposal, options);
  fmt::print(to, "{}\n", options.out);
  for (std::size_t i = 0; proposal && i < proposal->cameras.size(); ++i)
    fmt::print("{}", toml_of(proposal->cameras[i]));
  return 0;
}

CLI::Option* add_numbers(CLI::App& app, const std::string& name, std::vector<double>& values,
                         std::size_t least, std::size_t most, const std::string& help) {
  return app
      .add_option_function<std::string>(
          name,
          [&values, name, least, most](const std::string& text) {
            values = parse_numbers(name, text, least, most);
            if (least == 4) check_rectangle(name, values);
          },
          help)
      ->type_name(least == 4 ? "X0,Z0,X1,Z1" : "M,M,...");
}

}  // namespace

void add_plan(CLI::App& parent, Action& chosen) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* app = parent.add_subcommand(
      "plan", "Where the head can be tracked, how exactly, and where cameras stand best");
  app->add_option("WALL", options->wall_file, "Wall file (default: the 7x4 Tromsø wall)");
  add_numbers(*app, "--area", options->area, 4, 4,
              "Walking area, in room (default: before the wall, by its width)");
  add_numbers(*app, "--height", options->heights, 1, 8,
              "Of the eyes above the floor (default: 0.1 m below and above the default eye)");
  app->add_option("--yaw-deg", options->yaw_deg, "How far heads turn to either side")
      ->check(between(0.0, 180.0));
  app->add_option("--good-mm", options->good_mm, "Error of the eye that still counts as covered")
      ->check(between(0.1, 1000.0));
  app->add_option("--noise-px", options->noise_px, "Of a dot, before rounding to whole units")
      ->check(between(0.0, 20.0));
  CLI::Option* const propose =
      app->add_option("--propose", options->propose, "Places for so many cameras")
          ->check(CLI::Range(std::size_t{1}, kMaxCameras))
          ->type_name("N");
  add_numbers(*app, "--room", options->room, 4, 4,
              "Where the rails run, of the proposal (default: 1.2 m aside of the area, 2 m behind)")
      ->needs(propose);
  app->add_option("--rail-height", options->rail_height_m, "Of the rails, metres")
      ->check(between(0.1, 20.0))
      ->needs(propose);
  app->add_option("--ceiling", options->ceiling_m, "Height of the upper corners, metres")
      ->check(between(0.1, 20.0))
      ->needs(propose);
  app->add_option("--out", options->out, "Picture (default: out/plan.png)")
      ->type_name("")
      ->check(png_name());
  app->add_flag("--json", options->json, "Figures as JSON");
  app->footer(
      "\nExamples:\n"
      "  vindu plan\n"
      "  vindu plan wall.toml --area -1.5,1,1.5,3 --height 1.6 --out plan.png\n"
      "  vindu plan wall.toml --propose 4 > proposal.toml      [[camera]] tables for the wall "
      "file\n");
  app->callback([options, &chosen] { chosen = [options] { return run_plan(*options); }; });
}

}  // namespace vindu::app
