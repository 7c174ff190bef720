// A participant that only talks, as a process of its own:
//   bus_peer tile NAME WALL [INTERFACE MASTER MULTICAST]    says its status every 50 ms, and ready
//   bus_peer master COUNT WALL [INTERFACE MASTER MULTICAST] ends well when so many tiles are ready
// for one frame, and says which. MASTER is a host, MULTICAST true or false; loopback without them.
#include <sys/prctl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "cluster/dds.h"
#include "core/error.h"

namespace {

using namespace vindu;

[[noreturn]] void be_a_tile(Transport& transport, const std::string& tile) {
  const auto bus = transport.join({{Role::tile, tile, "here", "0.1"},
                                   {Topic::ready, Topic::tile_status},
                                   {Topic::frame, Topic::scene}});
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

void be_the_master(Transport& transport, std::size_t count) {
  const auto bus =
      transport.join({{Role::master, "master", "here", "0.1"}, {Topic::frame}, {Topic::ready}});
  std::set<std::string> ready;
  while (ready.size() < count) {
    bus->publish(FrameMessage{.epoch = 1, .newest = {.number = 1}});
    bus->wait({Topic::ready}, std::chrono::steady_clock::now() + std::chrono::milliseconds(4));
    for (const ReadyMessage& message : bus->take<ReadyMessage>()) ready.insert(message.tile);
  }
  for (const std::string& tile : ready) std::printf("%s\n", tile.c_str());
}

}  // namespace

int main(int count, char** begin) try {
  const std::vector<std::string> words(begin, begin + count);
  if (count != 4 && count != 7) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  ClusterConfig cluster{.name = words[3]};
  if (count == 7) {
    cluster.interface = words[4];
    cluster.master = words[5];
    cluster.multicast = words[6] == "true";
  }
  DdsTransport transport(dds_settings_of(cluster));
  if (words[1] == "tile") be_a_tile(transport, words[2]);
  be_the_master(transport, static_cast<std::size_t>(std::stoi(words[2])));
  return 0;
} catch (const vindu::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
