// Waiting for what must come, without a word on how long it may take: a test that waits for ever is
// ended by ctest.
#pragma once

#include <functional>
#include <vector>

#include "cluster/bus.h"

namespace vindu::testing {

inline Time in_ms(int value) {
  return std::chrono::steady_clock::now() + std::chrono::milliseconds(value);
}

/// The first message of its topic that fits.
template <class M>
M await(
    Bus& bus, const std::function<bool(const M&)>& fits = [](const M&) { return true; }) {
  while (true) {
    bus.wait({kTopicOf<M>}, in_ms(1000));
    for (const M& message : bus.template take<M>())
      if (fits(message)) return message;
  }
}

/// Publishes again and again until one arrives: the first ones may fall before the two know each
/// other.
template <class M>
M send_until_heard(Bus& from, const M& message, Bus& to) {
  while (true) {
    from.publish(message);
    if (!to.wait({kTopicOf<M>}, in_ms(20))) continue;
    if (auto heard = to.template take_newest<M>()) return *heard;
  }
}

inline Presence await_change(Bus& bus, PresenceChange change, const std::string& name) {
  return await<Presence>(bus, [&](const Presence& presence) {
    return presence.change == change && presence.who.name == name;
  });
}

}  // namespace vindu::testing
