// The one exception of Vindu: the world is wrong at set-up. A bug of ours is an assert; a normal
// outcome of a frame (no dots, a late packet) is an optional. main catches Error once, prints it
// and exits with 1.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vindu {

/// What went wrong, where (file, line, device, host), and what the user can do about it.
struct ErrorText {
  std::string what;
  std::string where;
  std::string remedy;
};

/// Reads as one line, "where: what; remedy", whichever parts are there.
class Error : public std::runtime_error {
 public:
  explicit Error(const ErrorText& text);
  /// Several errors of one input, shown one a line.
  explicit Error(const std::string& lines) : std::runtime_error(lines) {}
};

/// The candidate that `word` was probably meant to be, or empty when none is near: at most two
/// edits or a third of the word, but never all of its letters.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

}  // namespace vindu
