#include "core/clock.h"

#include <thread>

namespace vindu {

void MonotonicClock::sleep_until(Time time) { std::this_thread::sleep_until(time); }

}  // namespace vindu
