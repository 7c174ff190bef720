#include "core/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <iomanip>

#include "core/error.h"
#include "core/internal/toml_table.h"

namespace vindu {

CameraPath::CameraPath(std::vector<PathKey> keys, double closing_s)
    : keys_(std::move(keys)), closing_s_(closing_s) {
  assert(keys_.size() >= 2 && closing_s_ > 0);
}

double CameraPath::span_s(std::size_t from) const {
  return from + 1 < keys_.size() ? keys_[from + 1].t_s - keys_[from].t_s : closing_s_;
}

Vec3 CameraPath::tangent_m_s(std::size_t key) const {
  const std::size_t before = wrapped(key + keys_.size() - 1), after = wrapped(key + 1);
  return (keys_[after].eye_in_wall - keys_[before].eye_in_wall) / (span_s(before) + span_s(key));
}

Vec3 CameraPath::eye_at(double t_s) const {
  double t = std::fmod(t_s, period_s());
  if (t < 0) t += period_s();
  const auto later = std::ranges::upper_bound(keys_.begin() + 1, keys_.end(), t, {}, &PathKey::t_s);
  const auto from = static_cast<std::size_t>(later - keys_.begin()) - 1;
  const std::size_t to = wrapped(from + 1);
  const double span = span_s(from), u = (t - keys_[from].t_s) / span;
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * keys_[from].eye_in_wall +
         (u3 - 2 * u2 + u) * span * tangent_m_s(from) + (3 * u2 - 2 * u3) * keys_[to].eye_in_wall +
         (u3 - u2) * span * tangent_m_s(to);
}

void write_camera_path(const std::vector<PathKey>& keys, const std::string& file) {
  std::ofstream stream(file);
  stream << "closing_s = 1.0\n" << std::fixed << std::setprecision(6);
  for (const PathKey& key : keys) {
    const Vec3& eye = key.eye_in_wall;
    stream << "[[key]]\nt_s = " << key.t_s << "\neye_m = [" << eye.x() << ", " << eye.y() << ", "
           << eye.z() << "]\n";
  }
  stream.close();
  if (!stream) throw Error({"cannot be written", file, "choose another file"});
}

CameraPath read_camera_path(const std::string& file) {
  const toml::table parsed = internal::parse_toml_file(file);
  internal::Problems problems(file);
  internal::TomlTable root(parsed, "", problems);
  const double closing_s = root.number("closing_s", {0.01, 1e6}).value_or(1);
  std::vector<PathKey> keys;
  for (internal::TomlTable& table : root.tables("key")) {
    table.require("t_s", "1.5");
    table.require("eye_m", "[0, 0.1, 2]");
    const std::optional<double> t_s = table.number("t_s", {0, 1e6});
    if (t_s && (keys.empty() ? *t_s != 0 : *t_s <= keys.back().t_s))
      table.fail("t_s", keys.empty() ? fmt::format("is {}; 0 is allowed, for the first key", *t_s)
                                     : fmt::format("is {}; more than {}, that of the key before, "
                                                   "is allowed",
                                                   *t_s, keys.back().t_s));
    keys.push_back({t_s.value_or(0), table.vec3("eye_m").value_or(Vec3::Zero())});
    table.finish();
  }
  if (keys.size() < 2)
    root.fail("key", "at least two [[key]] tables are needed, each with t_s and eye_m");
  root.finish();
  problems.throw_if_any();
  return CameraPath(std::move(keys), closing_s);
}

}  // namespace vindu
