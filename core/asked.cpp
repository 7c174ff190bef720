#include "core/asked.h"

#include <limits>
#include <sstream>

#include "core/internal/toml_table.h"

namespace vindu {
namespace {

std::optional<Vec3> point_from(const toml::array* numbers) {
  if (!numbers || numbers->size() != 3) return std::nullopt;
  Vec3 point;
  for (std::size_t i = 0; i < 3; ++i)
    point[static_cast<Eigen::Index>(i)] =
        (*numbers)[i].value_or(std::numeric_limits<double>::quiet_NaN());
  return point.allFinite() ? std::optional(point) : std::nullopt;
}

}  // namespace

std::string text_of(const Asked& asked, const std::string& session) {
  toml::table table{{"session", session},
                    {"model", asked.model},
                    {"clip", asked.clip},
                    {"mode", asked.mode},
                    {"blank", asked.blank},
                    {"overlay", asked.overlay},
                    {"pattern", std::string(name_of(asked.pattern))}};
  if (asked.place) table.insert("place", name_of(*asked.place));
  if (const auto& middle = asked.middle_in_scene)
    table.insert("middle", toml::array{middle->x(), middle->y(), middle->z()});
  std::ostringstream text;
  text << table << "\n";
  return text.str();
}

std::optional<Asked> read_asked(const std::string& file, const std::string& session) {
  const toml::table table = internal::parse_toml_file(file);
  if (table["session"].value_or("") != session) return std::nullopt;
  Asked asked{.model = table["model"].value_or(""),
              .clip = table["clip"].value_or(""),
              .mode = table["mode"].value_or("track"),
              .pattern = pattern_from(table["pattern"].value_or("")).value_or(Pattern::none),
              .blank = table["blank"].value_or(false),
              .overlay = table["overlay"].value_or(false),
              .middle_in_scene = point_from(table["middle"].as_array())};
  if (const auto place = table["place"].value<std::string>()) asked.place = placement_from(*place);
  return asked;
}

}  // namespace vindu
