// What a running wall was asked for, first by its command line and then by consoles: all that a
// master needs to go on where another one was.
#pragma once

#include <optional>
#include <string>

#include "core/pattern.h"
#include "core/rigid3.h"
#include "core/site.h"

namespace vindu {

struct Asked {
  std::string model{};  ///< empty: the wall file's
  std::string clip{};
  std::optional<Placement> place{};
  std::string mode = "track";
  Pattern pattern = Pattern::none;
  bool blank = false;
  bool overlay = false;                   ///< tiles show their figures
  std::optional<Vec3> middle_in_scene{};  ///< vindu goto's point; empty: as the scene was placed

  bool operator==(const Asked&) const = default;
};

/// As a TOML file's text. `session`: whose it is.
std::string text_of(const Asked& asked, const std::string& session);

/// Of such a file; empty where it is another session's. Throws Error where it cannot be read.
std::optional<Asked> read_asked(const std::string& file, const std::string& session);

}  // namespace vindu
