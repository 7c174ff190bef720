// What vindu wiimote watch shows: the dots of every device, as text for a terminal and as a picture
// for a window.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.h"
#include "tracker/wiimote/live.h"

namespace vindu::app {

/// A device as it was last seen.
struct WatchedWiimote {
  std::string title;  ///< "1  00:1F:32:AB:CD:01"
  LiveWiimoteState state;
  std::optional<DataReport> data;
  double reports_per_s = 0;
};

/// One line of counts: rate, battery, buttons, acceleration, gaps by cause, what the driver had to
/// do; and another of what is wrong, if anything is.
std::string summary_of(const WatchedWiimote& wiimote);

/// Frames of 64 x 24 characters below each other; dots are the digits of their slots.
std::string screen_text(const std::vector<WatchedWiimote>& wiimotes);

/// The same, 560 pixels wide a device, beside each other.
Image screen_picture(const std::vector<WatchedWiimote>& wiimotes);

}  // namespace vindu::app
