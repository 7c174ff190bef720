// The plot of `vindu measure accuracy`: a row for each measurement, the error of the eye to the
// right on a logarithmic scale, ours beside the thesis' method and the bound.
#pragma once

#include "app/accuracy.h"
#include "renderer/image.h"

namespace vindu::app {

Image accuracy_picture(const Accuracy& accuracy, const AccuracyOptions& options);

}  // namespace vindu::app
