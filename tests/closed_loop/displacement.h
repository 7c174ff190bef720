// By how many pixels a tile's picture is displaced from the reference, pixel by pixel: the
// difference of the position code divided by its gradient.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/closed_loop/reference_view.h"

namespace vindu::test {

enum Corner { lower_left, lower_right, upper_left, upper_right };

struct Displacements {
  std::vector<float> length_px;  ///< of every pixel that shows what the reference shows there
  std::size_t readable = 0;      ///< pixels where the reference's code can be read
  std::size_t pixels = 0;        ///< of the tiles
  /// Mean displacement near each Corner of a tile, +x right and +y down; empty where too few pixels
  /// can be read. What the geometry gets wrong within a tile is a homography, which four corners
  /// fix.
  std::array<std::optional<Eigen::Vector2f>, 4> corner_px;

  /// The pixels of both; those of the corners remain this tile's.
  void append(const Displacements& other);
  double mean_px() const;
  double quantile_px(double share) const;
  double readable_share() const {
    return static_cast<double>(readable) / static_cast<double>(pixels);
  }
  /// Of the readable pixels, those that show the same surface.
  double agreeing_share() const {
    return static_cast<double>(length_px.size()) / static_cast<double>(readable);
  }
};

/// The reference cannot be read at the code's turning points, at edges, and where the code is so
/// coarse that rounding may read as more than half a pixel.
Displacements displacements(const Image& tile, const Levels& reference);

/// Does one tile show what the eye sees: displaced by at most 0.5 px on average and 1 px in 99 of
/// 100 pixels?
::testing::AssertionResult shows_what_the_eye_sees(const Displacements& tile);

}  // namespace vindu::test
