// The two frame locks that are compared, each as a master and a tile that play a wall: Vindu's own,
// WallMaster and WallTile over DDS on loopback; and the floor, a barrier of raw UDP datagrams,
// multicast to the tiles and unicast back, which knows neither late tiles nor dead ones.
#pragma once

#include <functional>

#include "bench/frame_lock/sheet.h"

namespace vindu {

/// Asked all the time, with the number of the newest frame that has begun.
using GoOn = std::function<bool(std::uint64_t begun)>;

struct LockKind {
  const char* name;
  void (*master)(Sheet& sheet, const GoOn& go_on);
  void (*tile)(Sheet& sheet, int tile);  ///< never returns
};

void bus_master(Sheet& sheet, const GoOn& go_on);
[[noreturn]] void bus_tile(Sheet& sheet, int tile);

void udp_master(Sheet& sheet, const GoOn& go_on);
[[noreturn]] void udp_tile(Sheet& sheet, int tile);

constexpr LockKind kBusLock{"bus", bus_master, bus_tile};
constexpr LockKind kUdpLock{"udp", udp_master, udp_tile};

}  // namespace vindu
