// By how many pixels a tile's picture is displaced from the reference, pixel by pixel: the
// difference of the position code divided by its gradient.
#pragma once

#include <vector>

#include "tests/closed_loop/reference_view.h"

namespace vindu::test {

struct Displacements {
  std::vector<float> length_px;  ///< of every pixel where it can be read
  std::size_t pixels = 0;        ///< of the tiles

  void append(const Displacements& other);
  double mean_px() const;
  double quantile_px(double share) const;
  double read_share() const {
    return static_cast<double>(length_px.size()) / static_cast<double>(pixels);
  }
};

/// Pixels at the code's turning points, at edges and where the surfaces differ cannot be read and
/// are left out.
Displacements displacements(const Image& tile, const Levels& reference);

}  // namespace vindu::test
