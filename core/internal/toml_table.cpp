#include "core/internal/toml_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/error.h"

namespace vindu::internal {
namespace {

std::string show(double value) {
  std::ostringstream out;
  out.precision(10);
  out << value;
  return out.str();
}

std::string show(const Range& range) {
  if (range.high >= 1e9) return "at least " + show(range.low);
  return "from " + show(range.low) + " to " + show(range.high);
}

/// As it would stand in a file, on one line and cut where it is long.
std::string show(const toml::node& node) {
  if (node.is_table()) return "a table";
  std::string text;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& item : *array) text += (text.empty() ? "" : ", ") + show(item);
    text = "[" + text + "]";
  } else if (const auto* number = node.as_floating_point()) {
    text = show(number->get());
  } else {
    std::ostringstream out;
    out << toml::toml_formatter(node, toml::format_flags::none);
    text = out.str();
    std::ranges::replace(text, '\n', ' ');
  }
  constexpr std::size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " ...";
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

bool within(double value, const Range& range) {
  return std::isfinite(value) && value >= range.low && value <= range.high;
}

}  // namespace

void Problems::add(const toml::node& at, const std::string& field, const std::string& what) {
  const unsigned line = at.source().begin.line;
  const std::string place = line ? file_ + ":" + std::to_string(line) : file_;
  lines_.emplace_back(line, place + ": " + field + ": " + what);
}

void Problems::throw_if_any() const {
  if (lines_.empty()) return;
  auto sorted = lines_;
  std::ranges::stable_sort(sorted, {}, &std::pair<unsigned, std::string>::first);
  std::string all;
  for (const auto& [line, text] : sorted) all += (all.empty() ? "" : "\n") + text;
  throw Error(all);
}

const toml::node* TomlTable::find(const std::string& name) {
  if (std::ranges::find(known_, name) == known_.end()) known_.push_back(name);
  return table_.get(name);
}

bool TomlTable::has(const std::string& name) { return find(name) != nullptr; }

bool TomlTable::is_list(const std::string& name) {
  const toml::node* node = find(name);
  return node && node->is_array();
}

std::optional<double> TomlTable::number(const std::string& name, Range range) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  const std::optional<double> value = node->value<double>();
  if (!node->is_number() || !value)
    problems_.add(*node, field(name),
                  "is " + show(*node) + "; a number " + show(range) + " is allowed");
  else if (!within(*value, range))
    problems_.add(*node, field(name), "is " + show(*value) + "; " + show(range) + " is allowed");
  else
    return value;
  return std::nullopt;
}

std::optional<int> TomlTable::integer(const std::string& name, Range range) {
  const std::optional<double> value = number(name, range);
  if (!value) return std::nullopt;
  if (*value == std::floor(*value)) return static_cast<int>(*value);
  fail(name, "is " + show(*value) + "; a whole number " + show(range) + " is allowed");
  return std::nullopt;
}

std::optional<bool> TomlTable::boolean(const std::string& name) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_boolean()) return value->get();
  problems_.add(*node, field(name), "is " + show(*node) + "; true or false is allowed");
  return std::nullopt;
}

std::optional<std::string> TomlTable::text(const std::string& name) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_string(); value && !value->get().empty()) return value->get();
  problems_.add(*node, field(name),
                "is " + show(*node) + "; a text in quotes, not empty, is allowed");
  return std::nullopt;
}

std::optional<std::string> TomlTable::one_of(const std::string& name,
                                             const std::vector<std::string>& allowed) {
  std::optional<std::string> value = text(name);
  if (!value || std::ranges::find(allowed, *value) != allowed.end()) return value;
  const std::string near = nearest_name(*value, allowed);
  const std::string hint = near.empty() ? "" : " (did you mean \"" + near + "\"?)";
  fail(name, "is \"" + *value + "\"" + hint + "; allowed: " + joined(allowed));
  return std::nullopt;
}

std::optional<std::vector<double>> TomlTable::numbers(const std::string& name, std::size_t count,
                                                      Range range) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  std::vector<double> values;
  if (const toml::array* array = node->as_array())
    for (const toml::node& item : *array)
      if (const auto value = item.value<double>();
          value && item.is_number() && within(*value, range))
        values.push_back(*value);
  const toml::array* array = node->as_array();
  if (array && array->size() == count && values.size() == count) return values;
  problems_.add(*node, field(name),
                "is " + show(*node) + "; " + std::to_string(count) + " numbers " + show(range) +
                    " in brackets are allowed");
  return std::nullopt;
}

std::optional<Vec3> TomlTable::vec3(const std::string& name, Range range) {
  const auto values = numbers(name, 3, range);
  if (!values) return std::nullopt;
  return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<std::vector<Eigen::VectorXd>> TomlTable::points(const std::string& name,
                                                              std::size_t axes, std::size_t least,
                                                              std::size_t most, Range range) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  std::vector<Eigen::VectorXd> points;
  const toml::array* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const toml::array* point = (*array)[i].as_array();
    if (!point || point->size() != axes) break;
    Eigen::VectorXd value(static_cast<Eigen::Index>(axes));
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const toml::node& item = (*point)[axis];
      value(static_cast<Eigen::Index>(axis)) =
          item.is_number() ? item.value_or(std::nan("")) : std::nan("");
    }
    if (std::ranges::all_of(value, [&](double x) { return within(x, range); }))
      points.push_back(std::move(value));
  }
  if (array && points.size() == array->size() && points.size() >= least && points.size() <= most)
    return points;
  problems_.add(*node, field(name),
                "is " + show(*node) + "; " + std::to_string(least) + " to " + std::to_string(most) +
                    " points " + (axes == 3 ? "[x, y, z]" : "[x, y]") + ", each number " +
                    show(range) + ", in brackets are allowed");
  return std::nullopt;
}

std::optional<std::vector<Vec3>> TomlTable::vec3s(const std::string& name, std::size_t least,
                                                  std::size_t most, Range range) {
  const auto found = points(name, 3, least, most, range);
  return found ? std::optional(std::vector<Vec3>(found->begin(), found->end())) : std::nullopt;
}

std::optional<std::vector<Vec2>> TomlTable::vec2s(const std::string& name, std::size_t least,
                                                  std::size_t most, Range range) {
  const auto found = points(name, 2, least, most, range);
  return found ? std::optional(std::vector<Vec2>(found->begin(), found->end())) : std::nullopt;
}

std::optional<TomlTable> TomlTable::table(const std::string& name) {
  const toml::node* node = find(name);
  if (!node) return std::nullopt;
  if (const toml::table* found = node->as_table()) return TomlTable(*found, field(name), problems_);
  problems_.add(*node, field(name),
                "is " + show(*node) + "; a table [" + field(name) + "] is allowed");
  return std::nullopt;
}

std::vector<TomlTable> TomlTable::tables(const std::string& name) {
  std::vector<TomlTable> found;
  const toml::node* node = find(name);
  if (!node) return found;
  const toml::array* array = node->as_array();
  if (!array || !array->is_homogeneous(toml::node_type::table)) {
    problems_.add(*node, field(name),
                  "is " + show(*node) + "; tables [[" + field(name) + "]] are allowed");
    return found;
  }
  for (std::size_t i = 0; i < array->size(); ++i)
    found.emplace_back(*(*array)[i].as_table(), field(name) + "[" + std::to_string(i) + "]",
                       problems_);
  return found;
}

void TomlTable::fail(const std::string& name, const std::string& what) {
  const toml::node* node = table_.get(name);
  problems_.add(node ? *node : table_, field(name), what);
}

void TomlTable::require(const std::string& name, const std::string& example) {
  if (!has(name)) fail(name, "is missing; for example " + name + " = " + example);
}

void TomlTable::finish() {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::ranges::find(known_, name) != known_.end()) continue;
    const std::string near = nearest_name(name, known_);
    problems_.add(node, field(name),
                  near.empty() ? "is not known; known here: " + joined(known_)
                               : "is not known; did you mean \"" + near + "\"?");
  }
}

namespace {

[[noreturn]] void refuse(const toml::parse_error& wrong, const std::string& file) {
  const auto line = wrong.source().begin.line;
  if (line == 0) throw Error({std::string(wrong.description()), file, "make the file readable"});
  throw Error({"is not valid TOML: " + std::string(wrong.description()),
               file + ":" + std::to_string(line), "correct that line"});
}

}  // namespace

toml::table parse_toml_file(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw Error({"cannot be read", file, "give the path of an existing TOML file"});
  try {
    return toml::parse_file(file);
  } catch (const toml::parse_error& wrong) {
    refuse(wrong, file);
  }
}

toml::table parse_toml_text(const std::string& text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& wrong) {
    refuse(wrong, file);
  }
}

}  // namespace vindu::internal
