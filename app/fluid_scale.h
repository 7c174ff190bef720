// How many pixels of a wall this machine draws fluidly, found by trying. Sans input and output.
#pragma once

#include <functional>

namespace vindu::app {

/// The largest scale up to 1 at which a frame takes no longer than the budget. `frame_s` draws at a
/// scale and says what a frame took; it is asked at scales that double, until one is over the
/// budget, so that nothing is ever drawn with more than four times the pixels of what fitted.
/// A frame takes time for its triangles, whatever the scale: where these alone come near the
/// budget, a frame may take a fifth more than the fastest did; drawing still smaller would gain
/// little.
double fluid_scale(const std::function<double(double scale)>& frame_s, double budget_s);

}  // namespace vindu::app
