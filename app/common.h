// What several sub-commands share: options of the same name, loading a model, the default site and
// show.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/pattern.h"
#include "core/site.h"
#include "renderer/canvas.h"
#include "renderer/placement.h"
#include "renderer/scene.h"

namespace vindu {
class Window;
}

namespace vindu::app {

/// An option "x,y,z" in metres.
CLI::Option* add_vec3(CLI::App& app, const std::string& name, std::optional<Vec3>& value,
                      const std::string& help);

/// Three finite numbers with commas; empty for any other text.
std::optional<Vec3> vec3_from(const std::string& text);

/// A number within both limits. CLI11's own Range lets "nan" through.
CLI::Validator between(double least, double largest);

CLI::Validator not_empty();
/// A file's name that ends in .png.
CLI::Validator png_name();

/// --place fit | life-size | as-is
CLI::Option* add_place(CLI::App& app, std::optional<Placement>& value);

/// --pattern NAME; vindu pattern --help says what each is.
CLI::Option* add_pattern_choice(CLI::App& app, Pattern& value);
/// --clip NAME|N
CLI::Option* add_clip(CLI::App& app, std::string& value);

/// The wall file, or the Tromsø wall that comes with Vindu when the name is empty.
Site load_site(const std::string& wall_file);
/// The same without its calibration.
Site load_uncalibrated_site(const std::string& wall_file);

/// Of this machine, as it calls itself.
std::string host_name();

/// As a JSON string, quotes included.
std::string json_text(const std::string& text);
std::string json_vec(const Vec3& v);

/// Writes the PNG and says its name. Throws Error when that fails.
void save_picture(const Image& image, const std::string& file);

/// Makes the folder, with its parents. Throws Error when that fails.
void make_folder(const std::string& folder);

/// A folder of this process alone, removed with all that is in it. Throws Error when it cannot be
/// made.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// How frames are drawn while they run: a CPU that draws does not smooth edges, which costs it more
/// than twice the time. Needs a current context.
Look live_look();

/// A window's content on the screen that is the tile, whose pixels are that screen's; the whole
/// tile where it is mirrored or turned.
TileCorners content_corners(const Tile& tile, const Window& window);

struct LoadedScene {
  PackedScene packed;
  Navigation navigation;
  int clip = 0;
};

/// A scene's path as tiles are told it, on this host: "asset:..." is part of every installation.
std::string model_file(const std::string& path);

/// A model, packed; warnings are logged. Stops as packed_scene() does.
PackedScene read_model(const std::string& file, const std::stop_token& stop = {});

/// Reads a model and places it before the wall; warnings and the placement are logged. An empty
/// name is the wall file's scene or, where it names none, the show. `clip`: see find_clip(). Throws
/// Error for one that the model does not have. Stops as packed_scene() does.
LoadedScene load_scene(const std::string& model, std::optional<Placement> placement,
                       const Site& site, const std::string& clip = "",
                       const std::stop_token& stop = {});

}  // namespace vindu::app
