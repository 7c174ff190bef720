#include "app/viewer.h"

#include <fmt/format.h>

#include <cmath>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/log.h"
#include "renderer/notice.h"

namespace vindu::app {
namespace {

constexpr double kDeskHeight_m = 1.2;                       // of a screen's centre above the floor
constexpr Duration kUpload = std::chrono::milliseconds(4);  // of a frame
constexpr Duration kSaidOfEye = std::chrono::seconds(1);
constexpr Duration kSaid = std::chrono::seconds(8);  // for people to read

/// The screen as it was typed, or as the monitor reports it, checked for sense. Metres.
Vec2 screen_size_m(const ViewOptions& options, const ScreenReport& screen) {
  if (options.screen_mm.size() == 2) return 1e-3 * Vec2(options.screen_mm[0], options.screen_mm[1]);
  const std::string doubt = doubt_about(screen);
  if (doubt.empty()) return 1e-3 * Vec2(screen.width_mm, screen.height_mm);
  Vec2 assumed = 25.4e-3 / 96 * Vec2(screen.size.width, screen.size.height);
  log_warning("screen " + screen.name, doubt + "; taken as " +
                                           std::to_string(std::lround(1e3 * assumed.x())) + " x " +
                                           std::to_string(std::lround(1e3 * assumed.y())) +
                                           " mm; measure it and say --screen-mm WIDTH HEIGHT");
  return assumed;
}

/// The file's screen, wherever it stands, unless its size was typed: then one of that size.
Wall screen_wall(const ViewOptions& options, const ScreenReport& screen, const Site* written) {
  if (!written || !options.screen_mm.empty()) {
    const Vec2 size_m = screen_size_m(options, screen);
    Wall wall = single_screen(size_m.x(), size_m.y(), screen.size.width, screen.size.height);
    if (written) wall.tiles.front().mount = written->wall.tiles.front().mount;
    wall.room_from_wall =
        written ? written->wall.room_from_wall : room_from_wall_at(kDeskHeight_m, 0);
    return wall;
  }
  Wall wall = written->wall;
  Tile& tile = wall.tiles.front();
  wall.grid.width_m = tile.corners.width_m();
  wall.grid.height_m = tile.corners.height_m();
  wall.grid.tile_width_px = tile.width_px = screen.size.width;
  wall.grid.tile_height_px = tile.height_px = screen.size.height;
  return wall;
}

std::string file_name(const std::string& model) {
  return model.empty() ? "the scene" : std::filesystem::path(model).filename().string();
}

/// The first of FOLDER/MODEL-1.png, -2, ... that is not there.
std::filesystem::path next_picture(const std::filesystem::path& folder, const std::string& model) {
  const std::string stem = model.empty() ? "scene" : std::filesystem::path(model).stem().string();
  std::error_code unreadable;  // then writing says why
  for (int number = 1;; ++number) {
    auto file = folder / fmt::format("{}-{}.png", stem, number);
    if (!std::filesystem::exists(file, unreadable)) return file;
  }
}

}  // namespace

Site screen_site(const ViewOptions& options, const ScreenReport& screen) {
  std::optional<Site> written;
  if (!options.wall_file.empty()) written = read_site(options.wall_file);
  if (written && written->wall.tiles.size() != 1)
    throw Error(
        {"has " + std::to_string(written->wall.tiles.size()) + " tiles, but view shows one screen",
         options.wall_file, "use vindu simulate, or vindu render"});
  Site site = written.value_or(Site{});
  site.wall = screen_wall(options, screen, written ? &*written : nullptr);
  const double width_m = site.wall.grid.width_m;
  if (!written) site.viewer.default_eye_in_wall = {0, 0.15 * width_m, 1.3 * width_m};
  return site;
}

void pose_on(const Stage& stage, double animation_time_s, GpuScene& scene) {
  scene.pose(matrix_of(stage.navigation.wall_from_scene, stage.navigation.scale), animation_time_s,
             stage.clip);
}

LoadedScene load_before(const std::string& model, const ViewOptions& options, const Site& site,
                        const TileCorners& content, const std::stop_token& stop) {
  Site place_before = site;  // fitted to the window, not to the screen
  place_before.wall = single_screen(content.width_m(), content.height_m(), 1, 1);
  LoadedScene loaded = load_scene(model, options.place, place_before,
                                  model == options.model ? options.clip : "", stop);
  const bool own_place = options.place == Placement::as_is;
  if (!own_place)
    loaded.navigation.wall_from_scene =
        content.wall_from_screen() * loaded.navigation.wall_from_scene;
  return loaded;
}

Viewer::Viewer(const ViewOptions& options, Window& window)
    : options_(options),
      window_(window),
      site_(screen_site(options, window.screen())),
      renderer_(live_look()),
      patterns_(site_.wall, Style::lit),
      statistics_(window, site_.rate_hz),
      shadow_(live_look()) {}

bool Viewer::load_first() {
  const Time began = std::chrono::steady_clock::now();
  start(options_.model);
  for (WaitingPage shown; !arrived();) {
    if (reading_.running()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const Duration waited = std::chrono::steady_clock::now() - began;
    const WaitingPage page{picture_size(), std::chrono::floor<std::chrono::seconds>(waited)};
    const bool due = window_.take_damaged() || page != shown;
    if (due && waited > std::chrono::milliseconds(300))
      draw(shown = page);
    else
      window_.handle_events();
    if (window_.close_wanted()) return false;
  }
  change();
  return true;
}

bool Viewer::due(FrameState state) {
  if (window_.size().width < 1 || window_.size().height < 1) return false;  // minimised
  if (!shown_->stage.plays()) state.animation_time_s = 0;
  const TileCorners content = content_corners(site_.wall.tiles.front(), window_);
  Showing next{.content_hash = content_hash_of(state),
               .models = models_,
               .size = window_.size(),
               .lower_left_in_wall = content.lower_left_in_wall,
               .caption = caption_.words(std::chrono::steady_clock::now()),
               .statistics = statistics_.on()};
  if (window_.take_presses(WindowKey::f12) > 0) picture_wanted_ = true;
  const bool picture = picture_wanted_ && !saving_.running();
  const bool changed = window_.take_damaged() || picture || next.statistics || next != showing_;
  showing_ = std::move(next);
  return changed;
}

int Viewer::draw(const FrameState& state) {
  const SizePx size = picture_size();
  if (size.width < 1 || size.height < 1) return 0;  // minimised
  if (!canvas_ || canvas_->size() != size) {
    canvas_ = std::make_unique<Canvas>(size, live_look());
    picture_ = std::make_unique<Picture>(size, Style::lit);
  }
  const Tile content = content_tile(size);
  auto view = tile_view(content.corners, state.eye_in_wall);
  if (view) view->detail = detail_need(content.corners, size, state.eye_in_wall);
  pose_on(shown_->stage, state.animation_time_s, shown_->scene);
  const GpuScene* scenes[] = {&shown_->scene};
  shadow_.update(scenes, shadow_region(site_.wall));
  canvas_->begin();
  const Time began = std::chrono::steady_clock::now();
  statistics_.timer().begin();
  const bool model = view && shows_model(state);
  const DrawCount count = model ? renderer_.draw(*view, scenes, {}, &shadow_) : DrawCount{};
  canvas_->resolve(*picture_);
  if (!shows_model(state)) patterns_.draw(state, content, {0, 0, size}, *picture_);
  PatternPainter::draw_number(state, {0, 0, size}, *picture_);
  statistics_.timer().end();
  if (picture_wanted_ && !saving_.running()) save(picture_->read());
  if (!view)
    caption_.say("the eye is at or behind the screen: there is nothing to see", began + kSaidOfEye);
  caption_.draw(*picture_, began);
  put_into_window(*picture_);
  statistics_.draw_over(renderer_);
  glFinish();
  statistics_.drew(count, std::chrono::steady_clock::now() - began);
  return view ? 0 : 1;
}

void Viewer::follow_wishes() {
  follow_drops();
  follow_saving();
}

void Viewer::follow_drops() {
  if (auto file = window_.take_dropped_file()) {
    dropped_ = std::move(file);
    reading_.stop();
    coming_.reset();
  }
  try {
    if (arrived()) change();
  } catch (const Error& error) {
    refuse(error);
  }
  if (!dropped_ || reading_.running()) return;
  caption_.say(file_name(*dropped_) + " is being read");
  start(*std::exchange(dropped_, std::nullopt));
}

void Viewer::follow_saving() {
  if (!saving_.done()) return;
  const Time until = std::chrono::steady_clock::now() + kSaid;
  try {
    const std::string file = saving_.take().string();
    log_info("view", "saved " + file);
    caption_.say("saved " + file, until);
  } catch (const Error& error) {
    log_warning("view", error.what());
    caption_.say("the picture cannot be saved: see the terminal", until);
  }
}

void Viewer::finish() {
  while (saving_.running()) {
    follow_saving();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void Viewer::save(Image picture) {
  picture_wanted_ = false;
  saving_.start([picture = std::move(picture), folder = options_.out,
                 model = shown_->model](const std::stop_token&) {
    make_folder(folder);
    std::filesystem::path file = next_picture(folder, model);
    write_png(picture, file.string());
    return file;
  });
}

void Viewer::start(const std::string& model) {
  model_ = model;
  const TileCorners content = content_corners(site_.wall.tiles.front(), window_);
  reading_.start([this, model, content](const std::stop_token& stop) {
    return load_before(model, options_, site_, content, stop);
  });
}

/// Brings what was read to the GPU, for a few milliseconds; whether all of it is there. Throws
/// Error for a model that cannot be shown.
bool Viewer::arrived() {
  const Time until = std::chrono::steady_clock::now() + kUpload;
  if (reading_.done()) {
    coming_.reset();  // its memory, before more is taken
    LoadedScene loaded = reading_.take();
    if (dropped_) return false;  // another one is wanted
    coming_.emplace(std::move(loaded));
  }
  while (coming_ && coming_->scene.free() && std::chrono::steady_clock::now() < until)
    if (coming_->scene.step()) return true;
  return false;
}

void Viewer::change() {
  shown_ = Shown{coming_->scene.take(), coming_->stage, model_};
  coming_.reset();
  ++models_;
  caption_.say("");
}

void Viewer::refuse(const Error& error) {
  coming_.reset();
  if (dropped_) return;  // stopped for it
  log_warning("view", std::string(error.what()) + " (the scene before it stays)");
  caption_.say(file_name(model_) + " cannot be shown: see the terminal",
               std::chrono::steady_clock::now() + kSaid);
}

void Viewer::draw(const WaitingPage& page) {
  if (page.size.width < 1 || page.size.height < 1) return window_.handle_events();  // minimised
  Picture picture(page.size, Style::lit);
  picture.write(draw_notice(
      {.title = "Vindu",
       .lines = {"reads " + file_name(model_), fmt::format("{} s", page.waited.count())}},
      page.size));
  put_into_window(picture);
  window_.present();
}

/// Of what the viewer sees: a screen may be turned.
SizePx Viewer::picture_size() const {
  const SizePx size = window_.size();
  const bool turned = site_.wall.tiles.front().mount.rotate_deg % 180 == 90;
  return turned ? SizePx{size.height, size.width} : size;
}

void Viewer::put_into_window(Picture& picture) {
  picture.make_mipmaps();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, window_.size().width, window_.size().height);
  renderer_.present(picture, site_.wall.tiles.front().mount);
}

/// The window's content as a tile of its own.
Tile Viewer::content_tile(SizePx size) const {
  Tile tile = site_.wall.tiles.front();
  tile.corners = content_corners(tile, window_);
  tile.width_px = size.width;
  tile.height_px = size.height;
  return tile;
}

}  // namespace vindu::app
