// Compares a picture with the one that was accepted: by the largest and the mean difference of a
// pixel, so that a rounding of one level passes and a moved edge does not.
#pragma once

#include <optional>
#include <string>

#include "renderer/image.h"

namespace vindu::testing {

/// Of all pixels, the difference of one being the largest of its red, green and blue.
struct Difference {
  int largest_levels = 0;
  double mean_levels = 0;
};

/// Software GL of another Mesa or another processor decides for single samples at edges otherwise:
/// one of four, from black to white, is 137 levels; and one pixel in fifteen is rounded by a level
/// (seen between two machines: 0.057 in the mean). Nothing else may differ, so the mean is small.
struct Tolerance {
  int largest_levels = 140;
  double mean_levels = 0.1;
};

/// Empty when the sizes differ.
std::optional<Difference> difference_of(const Image& actual, const Image& expected);

/// Grey where pixels are equal; 16 times the difference where they are not.
Image difference_picture(const Image& actual, const Image& expected);

/// Empty when `actual` is what was accepted as NAME.png; else what differs, and where the actual,
/// the expected and the difference picture were written. With VINDU_ACCEPT_GOLDENS in the
/// environment (tools/accept_goldens.sh sets it), writes the picture as accepted instead.
std::string complaint_about(const Image& actual, const std::string& name,
                            const Tolerance& tolerance = {});

}  // namespace vindu::testing
