// What a service says to systemd, by the protocol that sd_notify(3) describes and leaves open to
// others: datagrams to the socket that $NOTIFY_SOCKET names.
#pragma once

#include <string_view>

namespace vindu::app {

/// "READY=1" once it works, "WATCHDOG=1" as long as it does. Nothing happens where nobody asked.
void tell_service_manager(std::string_view state);

}  // namespace vindu::app
