#include "app/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/packer.h"
#include "core/error.h"
#include "core/log.h"
#include "renderer/clips.h"
#include "renderer/resources.h"
#include "renderer/surface.h"
#include "renderer/view.h"

namespace vindu::app {
namespace {

/// Throws CLI::ValidationError (called wrong) unless the text is three finite numbers with commas.
Vec3 parse_vec3(const std::string& name, const std::string& text) {
  if (const auto value = vec3_from(text)) return *value;
  throw CLI::ValidationError(
      name, "\"" + text + "\" is not x,y,z: three numbers, as -1,0.1,2, none beyond a million");
}

/// The show is made in the metres of the Tromsø wall; on another one it is scaled until its opening
/// covers all of that.
Navigation place_show(const Wall& wall) {
  constexpr double kWidth_m = 5.185, kHeight_m = 2.238;
  Navigation navigation;
  navigation.scale = std::max(wall.grid.width_m / kWidth_m, wall.grid.height_m / kHeight_m);
  return navigation;
}

LoadedScene place(PackedScene packed, Placement placement, const Wall& wall) {
  PlacedScene placed = place_scene(packed, placement, wall);
  if (!placed.remark.empty()) log_info(packed.scene.name, placed.remark);
  return {std::move(packed), placed.navigation, 0};
}

LoadedScene place_as_wished(PackedScene packed, const std::string& model,
                            std::optional<Placement> placement, const Site& site) {
  const bool show = model.empty() && site.scene.model.empty();
  if (show && !placement) return {std::move(packed), place_show(site.wall), 0};
  const Placement wanted = model.empty() ? site.scene.place : Placement::fit;
  return place(std::move(packed), placement.value_or(wanted), site.wall);
}

}  // namespace

CLI::Option* add_vec3(CLI::App& app, const std::string& name, std::optional<Vec3>& value,
                      const std::string& help) {
  return app
      .add_option_function<std::string>(
          name, [&value, name](const std::string& text) { value = parse_vec3(name, text); }, help)
      ->type_name("X,Y,Z");
}

CLI::Option* add_pattern_choice(CLI::App& app, Pattern& value) {
  return app
      .add_option_function<std::string>(
          "--pattern",
          [&value](const std::string& name) { value = pattern_from(name).value_or(Pattern::none); },
          "A test picture instead of the model; see vindu pattern --help")
      ->check(CLI::IsMember(pattern_names()));
}

std::optional<Vec3> vec3_from(const std::string& text) {
  Vec3 value;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [next, error] = std::from_chars(at, end, value[axis]);
    const bool separated = axis == 2 ? next == end : next != end && *next == ',';
    if (error != std::errc{} || !separated || !(std::abs(value[axis]) < 1e6)) return std::nullopt;
    at = next + 1;
  }
  return value;
}

CLI::Validator between(double least, double largest) {
  const std::string limits = fmt::format("{} to {}", least, largest);
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const bool good =
            CLI::detail::lexical_cast(text, value) && value >= least && value <= largest;
        return good ? std::string() : "\"" + text + "\" is not a number from " + limits;
      },
      limits);
}

CLI::Validator not_empty() {
  return CLI::Validator(
      [](const std::string& text) { return text.empty() ? std::string("is empty") : ""; }, "");
}

CLI::Validator png_name() {
  return CLI::Validator(
      [](const std::string& file) {
        return file.ends_with(".png") ? std::string() : "\"" + file + "\" does not end in .png";
      },
      "FILE.png");
}

CLI::Option* add_place(CLI::App& app, std::optional<Placement>& value) {
  return app
      .add_option_function<std::string>(
          "--place", [&value](const std::string& text) { value = placement_from(text); },
          "fit: scaled to the wall; life-size: metres, where the file states its unit;\n"
          "as-is: the model's coordinates are wall coordinates in metres")
      ->check(CLI::IsMember({"fit", "life-size", "as-is"}))
      ->type_name("fit|life-size|as-is");
}

CLI::Option* add_clip(CLI::App& app, std::string& value) {
  return app
      .add_option("--clip", value,
                  "Which of the model's animations plays, by name or number (vindu pack lists\n"
                  "them), or rest (default: the first)")
      ->type_name("NAME|N");
}

Site load_site(const std::string& wall_file) {
  return read_site(wall_file.empty() ? find_asset("walls/tromso.toml") : wall_file);
}

Site load_uncalibrated_site(const std::string& wall_file) {
  const std::string file = wall_file.empty() ? find_asset("walls/tromso.toml") : wall_file;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error({"cannot be read", file, "give the path of a wall file"});
  return parse_site({std::istreambuf_iterator<char>(stream), {}}, file);
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    if (static_cast<unsigned char>(letter) < 0x20)
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned char>(letter));
    else
      quoted += letter;
  }
  return quoted + "\"";
}

std::string json_vec(const Vec3& v) { return fmt::format("[{},{},{}]", v.x(), v.y(), v.z()); }

void save_picture(const Image& image, const std::string& file) {
  write_png(image, file);
  std::printf("%s\n", file.c_str());
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw Error({"cannot be made: " + error.message(), folder, "choose another --out"});
}

TemporaryFolder::TemporaryFolder() {
  path_ = (std::filesystem::temp_directory_path() / "vindu_XXXXXX").string();
  if (!mkdtemp(path_.data())) throw Error({"cannot be made", path_, "free some space"});
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Look live_look() {
  return draws_in_software() ? Look{.samples = 1, .shadows = Shadows::crisp, .anisotropy = 1}
                             : Look{};
}

TileCorners content_corners(const Tile& tile, const Window& window) {
  if (tile.mount != TileMount{}) return tile.corners;
  return part_of_tile(tile, window.content_on_screen_px(), window.size());
}

std::string model_file(const std::string& path) {
  constexpr std::string_view kAsset = "asset:";
  return path.starts_with(kAsset) ? find_asset(path.substr(kAsset.size())) : path;
}

PackedScene read_model(const std::string& file, const std::stop_token& stop) {
  PackedScene packed = packed_scene(file, stop);
  const SceneOutline& scene = packed.scene;
  for (const std::string& warning : packed.warnings) log_warning(scene.name, warning);
  log_debug(scene.name, std::to_string(scene.triangle_count()) + " triangles");
  return packed;
}

LoadedScene load_scene(const std::string& model, std::optional<Placement> placement,
                       const Site& site, const std::string& clip, const std::stop_token& stop) {
  const std::string wanted = model.empty() ? site.scene.model : model;
  const std::string file = wanted.empty() ? find_asset("show/show.glb") : wanted;
  PackedScene packed = read_model(file, stop);
  const int chosen = find_clip(clip_names(packed.scene), clip, file);
  LoadedScene loaded = place_as_wished(std::move(packed), model, placement, site);
  loaded.clip = chosen;
  return loaded;
}

}  // namespace vindu::app
