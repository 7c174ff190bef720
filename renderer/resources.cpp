#include "renderer/resources.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/error.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

/// The first folder that holds both shaders and assets.
const fs::path& data_folder() {
  static const fs::path found = [] {
    std::vector<fs::path> candidates;
    if (const char* named = std::getenv("VINDU_DATA")) candidates.emplace_back(named);
    std::error_code error;
    const fs::path binary = fs::read_symlink("/proc/self/exe", error);
    candidates.push_back(binary.parent_path() / "../share/vindu");
    candidates.emplace_back(VINDU_SOURCE_DIR);
    for (const fs::path& folder : candidates)
      if (fs::is_directory(folder / "shaders", error) && fs::is_directory(folder / "assets", error))
        return fs::weakly_canonical(folder, error);
    throw Error({"the folders shaders and assets are not found", "Vindu's data",
                 "set VINDU_DATA to the folder that holds both"});
  }();
  return found;
}

std::string find_in(const char* folder, const std::string& name) {
  const fs::path path = data_folder() / folder / name;
  std::error_code error;
  if (!fs::exists(path, error)) throw Error({"is missing", path.string(), "install Vindu again"});
  return path.string();
}

}  // namespace

std::string find_shader(const std::string& name) { return find_in("shaders", name); }
std::string find_asset(const std::string& name) { return find_in("assets", name); }

std::string find_font(const std::string& name) {
  const fs::path carried = data_folder() / "fonts" / name;
  std::error_code error;
  return fs::exists(carried, error) ? carried.string() : "/usr/share/fonts/truetype/dejavu/" + name;
}

}  // namespace vindu
