#include <algorithm>

#include "bench/frame_lock/locks.h"
#include "cluster/dds.h"
#include "cluster/wall_master.h"
#include "cluster/wall_tile.h"

namespace vindu {
namespace {

constexpr const char* kHost = "here";

std::string name_of_tile(int tile) { return "tile-" + std::to_string(tile) + "-0"; }

std::uint64_t count_evictions(WallMaster& wall) {
  return static_cast<std::uint64_t>(
      std::ranges::count(wall.take_events(), MemberChange::evicted, &MemberEvent::change));
}

}  // namespace

void bus_master(Sheet& sheet, const GoOn& go_on) {
  const MonotonicClock clock;
  DdsTransport transport({.name = sheet.plan.wall});
  const auto bus = transport.join(
      {{Role::master, "master", kHost, "bench"}, WallMaster::publishes(), WallMaster::hears()});
  std::vector<std::string> tiles;
  for (int tile = 0; tile < sheet.plan.tiles; ++tile) tiles.push_back(name_of_tile(tile));
  WallMaster wall(*bus,
                  {.epoch = 1, .self = {.role = Role::master, .host = kHost}, .tiles = tiles});
  wall.show("nothing", "", Placement::fit);
  Ticks ticks(clock.now(), sheet.plan.rate_hz);
  std::uint64_t begun = 0, released = 0;
  while (go_on(begun)) {
    const Time now = clock.now();
    wall.poll(now);
    sheet.evictions += count_evictions(wall);
    if (wall.open() && released < begun) sheet.release(released = begun, wall.active());
    if (wall.open() && now >= ticks.next()) {
      wall.begin({}, now);
      ++begun;
      ticks.pass(now);
    }
    bus->wait(WallMaster::hears(), wall.open() ? ticks.next() : wall.wake_time());
  }
}

void bus_tile(Sheet& sheet, int tile) {
  const MonotonicClock clock;
  DdsTransport transport({.name = sheet.plan.wall});
  const auto bus = transport.join(
      {{Role::tile, name_of_tile(tile), kHost, "bench"}, WallTile::publishes(), WallTile::hears()});
  WallTile wall(
      *bus,
      {.host = kHost, .incarnation = static_cast<std::uint64_t>(tile) + 1, .version = "bench"},
      {name_of_tile(tile)});
  PlayedDrawing drawing(sheet.plan, tile);
  std::uint64_t drawn = 0, swapped = 0;
  while (true) {
    const Time now = clock.now();
    wall.poll(now);
    if (const auto scene = wall.take_scene()) {
      wall.loads(now);
      wall.loaded(scene->revision);
    }
    switch (wall.next(now, true)) {
      case WallTile::Next::show: {
        const Time swap = clock.now();
        sheet.swapped(tile, drawn, swap);
        if (drawn <= swapped) sheet.wrong();
        swapped = drawn;
        wall.showed(now, swap);
        break;
      }
      case WallTile::Next::draw: {
        drawn = wall.to_draw()->newest.number;
        drawing.draw();
        const Time ready = clock.now();
        sheet.ready(tile, drawn, ready);
        wall.drew(drawn, now, ready);
        break;
      }
      case WallTile::Next::wait:
        bus->wait(WallTile::hears(), wall.wake_time(now));
    }
  }
}

}  // namespace vindu
