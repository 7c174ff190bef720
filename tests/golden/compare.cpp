#include "tests/golden/compare.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;

int levels_between(const Rgba8& a, const Rgba8& b) {
  int largest = 0;
  for (int part = 0; part < 3; ++part) largest = std::max(largest, std::abs(a[part] - b[part]));
  return largest;
}

std::string shown(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

/// Writes what a person needs to judge; returns where.
std::string write_failure(const Image& actual, const Image& expected, const std::string& name) {
  const fs::path folder = VINDU_GOLDEN_FAILURES;
  fs::create_directories(folder);
  const std::string base = (folder / name).string();
  write_png(actual, base + "-actual.png");
  if (!expected.empty()) write_png(expected, base + "-expected.png");
  if (difference_of(actual, expected))
    write_png(difference_picture(actual, expected), base + "-difference.png");
  return base + "-*.png";
}

}  // namespace

std::optional<Difference> difference_of(const Image& actual, const Image& expected) {
  if (actual.width_px != expected.width_px || actual.height_px != expected.height_px ||
      actual.empty())
    return std::nullopt;
  Difference difference;
  double sum = 0;
  for (std::size_t index = 0; index < actual.pixels.size(); ++index) {
    const int levels = levels_between(actual.pixels[index], expected.pixels[index]);
    difference.largest_levels = std::max(difference.largest_levels, levels);
    sum += levels;
  }
  difference.mean_levels = sum / static_cast<double>(actual.pixels.size());
  return difference;
}

Image difference_picture(const Image& actual, const Image& expected) {
  Image picture = Image::filled(actual.width_px, actual.height_px, {64, 64, 64, 255});
  for (std::size_t index = 0; index < picture.pixels.size(); ++index)
    for (int part = 0; part < 3; ++part) {
      const int levels = std::abs(actual.pixels[index][part] - expected.pixels[index][part]);
      if (levels)
        picture.pixels[index][part] = static_cast<std::uint8_t>(std::min(64 + 16 * levels, 255));
    }
  return picture;
}

std::string complaint_about(const Image& actual, const std::string& name,
                            const Tolerance& tolerance) {
  const fs::path accepted = fs::path(VINDU_SOURCE_DIR) / "tests/golden" / (name + ".png");
  if (std::getenv("VINDU_ACCEPT_GOLDENS")) return write_png(actual, accepted.string()), "";
  if (!fs::exists(accepted))
    return "nothing was accepted as " + accepted.string() + "; see " +
           write_failure(actual, {}, name);
  const Image expected = read_png(accepted.string());
  const auto difference = difference_of(actual, expected);
  if (!difference)
    return "the size is " + shown(actual.width_px, actual.height_px) + ", not " +
           shown(expected.width_px, expected.height_px) + "; see " +
           write_failure(actual, expected, name);
  if (difference->largest_levels <= tolerance.largest_levels &&
      difference->mean_levels <= tolerance.mean_levels)
    return "";
  return "differs by up to " + std::to_string(difference->largest_levels) + " levels, " +
         std::to_string(difference->mean_levels) + " in the mean; see " +
         write_failure(actual, expected, name);
}

}  // namespace vindu::testing
