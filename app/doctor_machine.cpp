// What a machine is and has, whatever wall it is for: Vindu's files, OpenGL, cameras.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/doctor.h"
#include "app/wiimote.h"
#include "app/wiimote_findings.h"
#include "core/error.h"
#include "renderer/resources.h"
#include "renderer/scene_cache.h"
#include "renderer/surface.h"
#include "tracker/wiimote/bluez.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

/// Devices of a folder whose names begin so, in order.
std::vector<fs::path> devices(const fs::path& folder, const std::string& beginning) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().filename().string().starts_with(beginning)) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

bool may_use(const fs::path& device) { return ::access(device.c_str(), R_OK | W_OK) == 0; }

/// The nearest folder above that is there.
fs::path existing_part(fs::path folder) {
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

Finding examine_cache() {
  constexpr std::uintmax_t kLittle = std::uintmax_t{1} << 30;
  const fs::path folder = SceneCache::usual_folder();
  const std::string remedy = "set XDG_CACHE_HOME to a folder of yours with some gigabytes";
  if (folder.empty())
    return {"files", Health::note, "packed models are kept nowhere: there is no home folder",
            remedy};
  const fs::path there = existing_part(folder);
  if (!fs::is_directory(there) || ::access(there.c_str(), W_OK) != 0)
    return {"files", Health::note, "packed models cannot be kept in " + folder.string(), remedy};
  std::error_code error;
  const fs::space_info space = fs::space(there, error);
  const std::string text =
      fmt::format("packed models are kept in {}, with {:.1f} GiB free", folder.string(),
                  static_cast<double>(space.available) / 1073741824.0);
  if (!error && space.available < kLittle) return {"files", Health::note, text, remedy};
  return {"files", Health::good, text};
}

/// Why it may be the processor that draws.
std::string remedy_for_software() {
  const auto cards = devices("/dev/dri", "renderD");
  const bool usable = std::ranges::any_of(cards, may_use);
  if (!cards.empty() && !usable)
    return "there is " + cards.front().string() +
           ", but you may not use it: sudo usermod -aG video,render $USER, and log in again";
  if (cards.empty()) return "fine for trying out; a wall wants a graphics card and its driver";
  return "there is " + cards.front().string() + ": install its driver for OpenGL 4.5";
}

Finding graphics_finding(const std::string& with) {
  const std::string what = with + ": " + gl_description();
  if (draws_in_software())
    return {"graphics", Health::note, what + ", drawn by the processor", remedy_for_software()};
  return {"graphics", Health::good, what};
}

/// Vindu's own errors bring their remedies.
Finding failure(const std::string& part, Health health, const Error& error) {
  return {part, health, error.what()};
}

void examine_window(Findings& findings) {
  if (!has_display()) {
    findings.push_back({"display", Health::note, "none: neither DISPLAY nor WAYLAND_DISPLAY is set",
                        "log in at the screen; over ssh: DISPLAY=:0 vindu ..."});
    return;
  }
  try {
    const auto window = make_window({.size = {320, 200}, .title = "Vindu looks at this display"});
    window->present();
    findings.push_back(graphics_finding("with a window"));
    const ScreenReport screen = window->screen();
    std::string text = fmt::format("{}: {} x {} pixels, {} x {} mm", screen.name, screen.size.width,
                                   screen.size.height, screen.width_mm, screen.height_mm);
    if (const std::string names = window->monitor_names(); names != screen.name)
      text += "; monitors " + names;
    const std::string doubt = doubt_about(screen);
    if (doubt.empty())
      findings.push_back({"display", Health::good, text});
    else
      findings.push_back(
          {"display", Health::note, text + ": " + doubt,
           "measure it, and write it into the wall file or say vindu view --screen-mm"});
  } catch (const Error& error) {
    findings.push_back(failure("display", Health::bad, error));
  }
}

void examine_all_wiimotes(Findings& findings) {
  try {
    WiimoteBus devices(false);
    std::vector<WiimoteFinding> wiimotes = examine_wiimotes(devices.bus(), devices.clock());
    const BluezView view = bluez_wiimotes();
    add_bluetooth(view, wiimotes);
    for (const WiimoteFinding& wiimote : wiimotes)
      findings.push_back({"wiimotes",
                          wiimote.forbidden          ? Health::bad
                          : wiimote.state == "ready" ? Health::good
                                                     : Health::note,
                          label_of(wiimote.info) + ": " + wiimote.state});
    if (wiimotes.empty())
      findings.push_back({"wiimotes", Health::note, "none is known here", "vindu wiimote pair"});
    if (!view.trouble.empty()) findings.push_back({"bluetooth", Health::note, view.trouble});
    for (const std::string& warning : adapter_warnings(view.wiimotes))
      findings.push_back({"bluetooth", Health::note, warning});
  } catch (const Error& error) {
    findings.push_back(failure("wiimotes", Health::bad, error));
  }
}

}  // namespace

Findings examine_files() {
  Findings findings;
  try {
    find_shader("scene.frag");
    const fs::path show = find_asset("walls/tromso.toml");
    findings.push_back({"files", Health::good,
                        fmt::format("vindu {}, shaders and assets in {}", VINDU_VERSION,
                                    show.parent_path().parent_path().parent_path().string())});
  } catch (const Error& error) {
    findings.push_back(failure("files", Health::bad, error));
  }
  findings.push_back(examine_cache());
  return findings;
}

Findings examine_graphics() {
  Findings findings;
  try {
    const auto surface = make_headless_surface();
    findings.push_back(graphics_finding("without a window"));
  } catch (const Error& error) {
    findings.push_back(failure("graphics", Health::bad, error));
  }
  examine_window(findings);
  return findings;
}

Findings examine_cameras() {
  Findings findings;
  examine_all_wiimotes(findings);
  for (const fs::path& device : devices("/dev", "video"))
    if (may_use(device))
      findings.push_back({"cameras", Health::good, device.string() + " may be used"});
    else
      findings.push_back({"cameras", Health::note, device.string() + " may not be used",
                          "sudo usermod -aG video $USER, and log in again"});
  return findings;
}

}  // namespace vindu::app
