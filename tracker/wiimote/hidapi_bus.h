// The HID devices of this machine, by hidapi over Linux' hidraw.
#pragma once

#include "tracker/wiimote/hid_device.h"

namespace vindu {

/// `clock` stamps the reports and must outlive the bus and its devices. Throws Error when hidapi
/// does not start.
std::unique_ptr<HidBus> make_hidapi_bus(Clock& clock);

/// "0.13.1", of the library in use.
std::string hidapi_version();

}  // namespace vindu
