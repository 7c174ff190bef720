// vindu render: pictures of a model, or of a test pattern, on a wall from one eye, off-screen.
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/common.h"
#include "app/film.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/eye_picture.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"

namespace vindu::app {
namespace {

struct RenderOptions {
  std::string model;
  std::string wall_file;
  std::string tile;
  std::string out = "out";
  std::string clip;
  std::optional<Vec3> eye;
  std::optional<Placement> place;
  std::optional<int> device;
  double scale = 1;
  double time_s = 0;
  Pattern pattern = Pattern::none;
  bool all = false;
  bool unlit = false;
  std::string path_file;
  std::string view = "wall";
  double rate_hz = 30;
  std::optional<double> length_s;
};

void save_tiles(const WallRenderer& wall, const RenderOptions& options) {
  for (std::size_t index = 0; index < wall.wall().tiles.size(); ++index) {
    const std::string& name = wall.wall().tiles[index].name;
    if (options.tile.empty() || options.tile == name)
      save_picture(wall.read_tile(index), options.out + "/" + name + ".png");
  }
}

const Tile* chosen_tile(const Wall& wall, const std::string& name) {
  if (name.empty()) return nullptr;
  const Tile* tile = wall.find(name);
  if (!tile)
    throw Error({"there is no tile \"" + name + "\"", "--tile",
                 "this wall has " + wall.tiles.front().name + " to " + wall.tiles.back().name});
  return tile;
}

void film(const RenderOptions& options, WallRenderer& wall, const FrameState& state) {
  const CameraPath path = read_camera_path(options.path_file);
  make_film(wall, path, state,
            {.rate_hz = options.rate_hz,
             .length_s = options.length_s.value_or(path.period_s()),
             .view = options.tile.empty() ? options.view : options.tile,
             .out = options.out});
}

int render(const RenderOptions& options) {
  const Site site = load_site(options.wall_file);
  const Tile* only = chosen_tile(site.wall, options.tile);
  if (options.out == "-" && options.path_file.empty())
    throw Error({"takes frames of a film alone", "--out -", "add --path FILE, or name a folder"});
  const Time photon_time = Time{} + from_seconds(options.time_s);
  FrameState state{.number = static_cast<std::uint64_t>(options.time_s * site.rate_hz),
                   .photon_time = photon_time,
                   .eye_in_wall = options.eye.value_or(site.viewer.default_eye_in_wall),
                   .animation_time_s = options.time_s,
                   .pattern = options.pattern};
  std::optional<LoadedScene> loaded;
  if (shows_model(state)) loaded = load_scene(options.model, options.place, site, options.clip);
  if (options.out != "-") make_folder(options.out);
  const auto surface = make_headless_surface({.device = options.device});
  log_debug("render", gl_description());
  WallRenderer wall(site.wall, options.scale, Look{options.unlit ? Style::unlit : Style::lit});
  if (loaded) {
    wall.show(loaded->packed);
    state.navigation = loaded->navigation;
    state.clip = loaded->clip;
  }
  if (!options.path_file.empty()) {
    film(options, wall, state);
    return 0;
  }
  const WallFrame frame = wall.draw(state, only);
  for (const std::string& name : frame.black_tiles)
    log_warning(name, "is black: the eye is at or behind its plane");
  save_tiles(wall, options);
  if (only) return 0;
  save_picture(wall.picture().read(), options.out + "/wall.png");
  save_picture(picture_from_eye(wall, state.eye_in_wall, kEyePicture), options.out + "/eye.png");
  return 0;
}

void add_film(CLI::App& app, RenderOptions& options) {
  auto* path = app.add_option("--path", options.path_file,
                              "A film instead: frames along this camera path, frame-00001.png ...")
                   ->type_name("FILE");
  app.add_option("--fps", options.rate_hz, "Of the film (default: 30)")
      ->check(between(0.01, 10000.0))
      ->needs(path);
  app.add_option("--seconds", options.length_s, "Of the film (default: once along the path)")
      ->check(between(0.001, 1e6))
      ->needs(path);
  app.add_option("--view", options.view, "Of the film: wall (default), or eye; --tile for one tile")
      ->check(CLI::IsMember({"wall", "eye"}))
      ->needs(path);
}

}  // namespace

void add_render(CLI::App& parent, Action& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* app = parent.add_subcommand(
      "render", "Pictures of a model on a wall, seen from one eye, off-screen");
  app->add_option("MODEL", options->model,
                  "Any model that Assimp reads (default: the wall file's, or the show)");
  app->add_option("--wall", options->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  add_vec3(*app, "--eye", options->eye,
           "The eye in wall: metres from the wall's centre, +x right, +y up, +z towards\n"
           "the viewer (default: the wall file's default_eye_m)");
  auto* tile = app->add_option("--tile", options->tile, "Only this tile")->type_name("tile-X-Y");
  app->add_flag("--all", options->all,
                "All tiles, the joined wall and the view from the eye (default)")
      ->excludes(tile);
  app->add_option("--scale", options->scale, "Pixels per pixel of the wall")
      ->check(between(0.005, 4.0));
  add_place(*app, options->place);
  add_pattern_choice(*app, options->pattern);
  app->add_flag("--unlit", options->unlit,
                "Base colours as they are: no light, tone, sRGB or multisampling");
  app->add_option("--time", options->time_s,
                  "Animation time in seconds; of a pattern the photon time")
      ->check(between(0.0, 1e9));
  add_clip(*app, options->clip);
  app->add_option("--device", options->device, "EGL device (GPU) by its index");
  app->add_option("--out", options->out,
                  "Folder for the pictures (default: out); of a film also -, the output stream")
      ->type_name("DIR");
  add_film(*app, *options);
  app->footer(
      "\nWrites tile-X-Y.png for each tile, wall.png (the whole wall as one picture) and eye.png "
      "(what the viewer sees).\n"
      "\nExamples:\n"
      "  vindu render model.glb --wall wall.toml --eye -1,0.1,2 --scale 0.25 --out pictures\n"
      "  vindu render scan.ply --tile tile-3-1 --place life-size\n"
      "  vindu render beast.x --clip Walk --time 0.5\n"
      "  vindu render --pattern grid --wall wall.toml --scale 0.25\n"
      "  vindu render model.glb --path walk.toml --view eye --fps 60 --out frames\n");
  app->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace vindu::app
