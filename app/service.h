// What a service says to systemd, or to vindu launch, by the protocol that sd_notify(3) describes
// and leaves open to others: datagrams to the socket that $NOTIFY_SOCKET names.
#pragma once

#include "core/clock.h"

namespace vindu::app {

/// Says that it works, every second, from the thread that does the work: one that hangs is started
/// anew. Never waits; nothing happens where nobody asked.
class SignOfLife {
 public:
  void give(Time now);

 private:
  Time given_{};
};

}  // namespace vindu::app
