// Where the program's own files are: beside the installed binary, in the source tree it was built
// from, or where the environment variable VINDU_DATA says.
#pragma once

#include <string>

namespace vindu {

/// Path of a file in the shaders folder. Throws Error when no data folder is found.
std::string find_shader(const std::string& name);

/// Path of a file in the assets folder, "show/show.glb".
std::string find_asset(const std::string& name);

/// Path of a font, "DejaVuSans.ttf": in the folder fonts beside assets, where a bundle has it, else
/// where Debian's package installs it.
std::string find_font(const std::string& name);

}  // namespace vindu
