// The camera path of loop mode: keys of an eye over time, in a TOML file, played round and round.
// The thesis' OSGDWL had it hard-coded (3.5.2).
#pragma once

#include <string>
#include <vector>

#include "core/rigid3.h"

namespace vindu {

struct PathKey {
  double t_s = 0;
  Vec3 eye_in_wall = Vec3::Zero();
};

/// Closed: after the last key the eye returns to the first within `closing_s`.
class CameraPath {
 public:
  /// At least two keys, times ascending from 0; closing_s > 0.
  CameraPath(std::vector<PathKey> keys, double closing_s);

  double period_s() const { return keys_.back().t_s + closing_s_; }
  /// Smooth through all keys (a closed cubic Hermite spline, tangents of finite differences), for
  /// any time.
  Vec3 eye_at(double t_s) const;

 private:
  std::size_t wrapped(std::size_t index) const { return index % keys_.size(); }
  double span_s(std::size_t from) const;
  Vec3 tangent_m_s(std::size_t key) const;

  std::vector<PathKey> keys_;
  double closing_s_;
};

/// Such a file, with a second from the last key to the first. Throws Error when it cannot be
/// written.
void write_camera_path(const std::vector<PathKey>& keys, const std::string& file);

/// File: closing_s = 2.0 and [[key]] tables with t_s and eye_m. Throws Error with file and line.
CameraPath read_camera_path(const std::string& file);

}  // namespace vindu
