// Any bytes as what comes over the network or stands in a recording, and as a participant's text:
// nothing crashes, and whatever is taken can be sent and comes back the same. For libFuzzer;
// tests/fuzz/run.sh builds and runs it.
#include <cstdlib>
#include <string_view>

#include "cluster/cdr.h"
#include "cluster/internal/participant_text.h"

namespace {

using namespace vindu;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_message(Topic topic, std::span<const std::uint8_t> bytes) {
  const auto message = message_from_cdr(topic, bytes);
  if (!message) return;
  require(topic_of(*message) == topic);
  const Bytes again = to_cdr(*message);
  require(!again.empty());
  const auto back = message_from_cdr(topic, again);
  require(back && to_cdr(*back) == again);
}

void check_state(std::span<const std::uint8_t> bytes) {
  const auto state = frame_state_from_cdr(bytes);
  if (!state) return;
  const auto back = frame_state_from_cdr(to_cdr(*state));
  require(back && hash_of(*back) == hash_of(*state));
}

void check_participant(std::string_view text) {
  const auto participant = internal::participant_from(text);
  if (participant)
    require(internal::participant_from(internal::text_of(*participant)) == participant);
}

}  // namespace

/// The first byte says which.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span bytes(data + 1, size - 1);
  const int which = data[0] % (kTopics + 1);
  if (which < kTopics - 1)
    check_message(static_cast<Topic>(which), bytes);
  else if (which == kTopics - 1)
    check_state(bytes);
  else
    check_participant({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return 0;
}
