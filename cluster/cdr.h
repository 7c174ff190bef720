// Messages as bytes: XTypes' CDR by Cyclone's own serialiser, of the types in wire.idl, with the
// four bytes before it that say which (RTPS 9.4.2.13 "encapsulation"). What travels and what
// recordings hold is the same. Bytes from elsewhere are checked in full: bounds, ranges, NaN.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/topics.h"

namespace vindu {

using Bytes = std::vector<std::uint8_t>;

/// Empty when the state is one that from_cdr would refuse.
Bytes to_cdr(const FrameState& state);

/// Refuses (empty) what is cut short or too long, not finite, farther than 1e9 m, of an unknown
/// mode, turned by no unit quaternion, scaled by nothing, or numbered 0.
std::optional<FrameState> frame_state_from_cdr(std::span<const std::uint8_t> bytes);

/// Empty when the message is one that message_from_cdr would refuse. Of all topics but presence,
/// which never travels.
Bytes to_cdr(const Message& message);
std::optional<Message> message_from_cdr(Topic topic, std::span<const std::uint8_t> bytes);

}  // namespace vindu
