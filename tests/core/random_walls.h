// Seeded random numbers and the walls that core's tests go through.
#pragma once

#include <random>

#include "core/wall.h"

namespace vindu::testing {

/// The thesis' wall: 28 tiles, 7 x 4.
inline WallGrid tromso_grid() {
  WallGrid grid;
  grid.columns = 7;
  grid.rows = 4;
  grid.width_m = 5.185;
  grid.height_m = 2.238;
  grid.tile_width_px = 1024;
  grid.tile_height_px = 768;
  return grid;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  /// In front of the wall, from a hand's breadth to ten metres, also far to its sides.
  Vec3 eye_in_wall() { return {between(-5, 5), between(-2, 2), between(0.05, 10)}; }
  Quat rotation() {
    std::normal_distribution<double> normal;
    return Quat(normal(engine_), normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Rigid3 rigid() { return {rotation(), vector(3)}; }

 private:
  std::mt19937 engine_;
};

}  // namespace vindu::testing
