#include "renderer/import_opengex.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>

namespace vindu {
namespace {

constexpr std::size_t kBeginning = 16384;

/// `Metric (key = "distance") {float {0.01}}` -> "0.01".
std::optional<std::string> metric(const std::string& text, const std::string& key) {
  const std::regex structure("Metric\\s*\\(\\s*key\\s*=\\s*\"" + key +
                             R"re("\s*\)\s*\{\s*\w+\s*\{\s*"?([^"}\s]+))re");
  std::smatch found;
  if (!std::regex_search(text, found, structure)) return std::nullopt;
  return found[1].str();
}

}  // namespace

OpenGexMetrics opengex_metrics(const std::string& file) {
  std::string text(kBeginning, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  OpenGexMetrics metrics;
  if (const auto distance = metric(text, "distance")) {
    const double metres = std::strtod(distance->c_str(), nullptr);
    if (std::isfinite(metres) && metres > 0) metrics.metres_per_unit = metres;
  }
  const std::string up = metric(text, "up").value_or("z");
  if (up.size() == 1 && up[0] >= 'x' && up[0] <= 'z') metrics.up_axis = up[0] - 'x';
  return metrics;
}

}  // namespace vindu
