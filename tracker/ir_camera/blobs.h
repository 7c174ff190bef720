// Finds the bright spots of an infrared picture: threshold, connected components, centroids to a
// fraction of a pixel. Knows no camera and no library; reentrant.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/site.h"
#include "tracker/observation.h"

namespace vindu {

/// A borrowed picture of 8-bit grey values, row by row from the upper left.
struct GreyView {
  const std::uint8_t* pixels = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t row_bytes = 0;  ///< from one row to the next

  const std::uint8_t* row(int y) const { return pixels + y * row_bytes; }
};

/// The dots of a picture, brightest first (by the sum of its weights; of equals the upper, then the
/// left one). A blob is a set of pixels above the threshold that touch each other, also by a
/// corner; its dot is the mean of their places, weighted by value - threshold: a weight that falls
/// to zero at the rim keeps pixels that noise adds or takes away from moving the dot. (0, 0) is the
/// centre of the upper left pixel, as in OpenCV. A blob that touches the picture's edge is cut off,
/// and its centre unknown: it is no dot. Dot::size is the blob's area in pixels.
DotList detect_blobs(const GreyView& picture, const BlobOptions& options);

}  // namespace vindu
