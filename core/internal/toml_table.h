// Typed, checked reading of a TOML table. Every field that is asked for becomes known; what is left
// over at the end is an error that names the nearest known field. Errors are collected, so that a
// user sees all of them at once. Private to core: toml++ shows in no public header.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "core/rigid3.h"

namespace vindu::internal {

/// All that is wrong with one file, one line each: "file:line: field: what; what is allowed".
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  void add(const toml::node& at, const std::string& field, const std::string& what);
  void throw_if_any() const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::vector<std::pair<unsigned, std::string>> lines_;
};

struct Range {
  double low = -1e9;
  double high = 1e9;
};

class TomlTable {
 public:
  /// `table` and `problems` must outlive this. `path` is shown before every field: "wall" gives
  /// "wall.columns".
  TomlTable(const toml::table& table, std::string path, Problems& problems)
      : table_(table), path_(std::move(path)), problems_(problems) {}

  bool has(const std::string& name);
  bool is_list(const std::string& name);
  std::optional<double> number(const std::string& name, Range range);
  std::optional<int> integer(const std::string& name, Range range);
  std::optional<bool> boolean(const std::string& name);
  std::optional<std::string> text(const std::string& name);
  std::optional<std::string> one_of(const std::string& name,
                                    const std::vector<std::string>& allowed);
  /// `count` numbers.
  std::optional<std::vector<double>> numbers(const std::string& name, std::size_t count,
                                             Range range);
  std::optional<Vec3> vec3(const std::string& name, Range range = {-1000, 1000});
  std::optional<std::vector<Vec3>> vec3s(const std::string& name, std::size_t least,
                                         std::size_t most, Range range);
  std::optional<std::vector<Vec2>> vec2s(const std::string& name, std::size_t least,
                                         std::size_t most, Range range);
  std::optional<TomlTable> table(const std::string& name);
  std::vector<TomlTable> tables(const std::string& name);

  /// Reports an error of this table, at the field if there is one.
  void fail(const std::string& name, const std::string& what);
  void require(const std::string& name, const std::string& example);
  /// Fields that nobody asked for are errors. Call it last.
  void finish();

 private:
  const toml::node* find(const std::string& name);
  std::optional<std::vector<Eigen::VectorXd>> points(const std::string& name, std::size_t axes,
                                                     std::size_t least, std::size_t most,
                                                     Range range);
  std::string field(const std::string& name) const {
    return path_.empty() ? name : path_ + "." + name;
  }

  const toml::table& table_;
  std::string path_;
  Problems& problems_;
  std::vector<std::string> known_;
};

/// Throws Error with file and line where the file cannot be read or is not TOML.
toml::table parse_toml_file(const std::string& file);
/// The same of a text that came from `file`.
toml::table parse_toml_text(const std::string& text, const std::string& file);

}  // namespace vindu::internal
