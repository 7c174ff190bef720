// A tile that only talks, as a process of its own: bus_peer NAME WALL. Says its status every 50 ms
// and that each frame is ready.
#include <cstdlib>
#include <string>

#include "cluster/dds.h"

int main(int count, char** words) {
  using namespace vindu;
  if (count != 3) return 2;
  const std::string tile = words[1];
  DdsTransport transport({.name = words[2]});
  const auto bus = transport.join(
      {{Role::tile, tile, "here", "0.1"}, {Topic::ready, Topic::tile_status}, {Topic::frame}});
  Time next_status{};
  while (true) {
    const Time now = std::chrono::steady_clock::now();
    if (now >= next_status) {
      bus->publish(StatusMessage{.tile = tile, .incarnation = 1});
      next_status = now + std::chrono::milliseconds(50);
    }
    bus->wait({Topic::frame}, next_status);
    if (const auto frame = bus->take_newest<FrameMessage>())
      bus->publish(ReadyMessage{
          .tile = tile, .incarnation = 1, .epoch = frame->epoch, .number = frame->newest.number});
  }
}
