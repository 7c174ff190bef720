#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "bench/frame_lock/locks.h"
#include "core/error.h"

namespace vindu {
namespace {

// Until all tiles are there; then only against a lost packet, which loopback does not lose.
constexpr Duration kHello = std::chrono::milliseconds(5);
constexpr Duration kRepeat = std::chrono::milliseconds(50);

/// Master to tiles: all that a tile needs. 0: no frame yet.
struct Frame {
  std::uint64_t newest = 0, released = 0;
};

/// Tile to master: 0 says that it is there.
struct Ready {
  std::int64_t tile = 0, number = 0;
};

class Socket {
 public:
  Socket() : handle_(socket(AF_INET, SOCK_DGRAM, 0)) {}
  ~Socket() { close(handle_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  template <class Value>
  void set(int level, int option, const Value& value) {
    check(setsockopt(handle_, level, option, &value, sizeof value));
  }
  void bind_to(const sockaddr_in& address) {
    check(bind(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address));
  }
  template <class Value>
  void send(const Value& value, const sockaddr_in& to) {
    sendto(handle_, &value, sizeof value, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  /// With who sent it; empty at the deadline.
  template <class Value>
  std::optional<std::pair<Value, sockaddr_in>> receive(Duration most) {
    pollfd waited{handle_, POLLIN, 0};
    const timespec timeout{most.count() / 1'000'000'000, most.count() % 1'000'000'000};
    if (ppoll(&waited, 1, &timeout, nullptr) <= 0) return std::nullopt;
    std::pair<Value, sockaddr_in> got{};
    socklen_t size = sizeof got.second;
    if (recvfrom(handle_, &got.first, sizeof got.first, 0, reinterpret_cast<sockaddr*>(&got.second),
                 &size) != sizeof(Value))
      return std::nullopt;
    return got;
  }

 private:
  static void check(int result) {
    if (result != 0)
      throw Error({"raw UDP does not work here", std::strerror(errno),
                   "loopback must be up and take multicast"});
  }
  int handle_;
};

const in_addr kLoopback{htonl(INADDR_LOOPBACK)};

sockaddr_in group(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = inet_addr("239.255.77.2");
  return address;
}

}  // namespace

void udp_master(Sheet& sheet, const GoOn& go_on) {
  const MonotonicClock clock;
  Socket socket;
  socket.set(IPPROTO_IP, IP_MULTICAST_IF, kLoopback);
  std::vector<std::int64_t> heard(static_cast<std::size_t>(sheet.plan.tiles), -1);
  Frame frame;
  Time sent{};
  const auto send = [&](Time now) {
    socket.send(frame, group(sheet.plan.port));
    sent = now;
  };
  Ticks ticks(clock.now(), sheet.plan.rate_hz);
  while (go_on(frame.newest)) {
    const Time now = clock.now();
    const Duration repeat = frame.newest == 0 ? kHello : kRepeat;
    const bool all = std::ranges::all_of(
        heard, [&](std::int64_t number) { return number == std::int64_t(frame.newest); });
    if (all && frame.released < frame.newest) {
      frame.released = frame.newest;
      send(now);
      sheet.release(frame.released, heard.size());
    }
    if (all && now >= ticks.next()) {
      ++frame.newest;
      send(now);
      ticks.pass(now);
    } else if (!all && now - sent >= repeat) {
      send(now);
    }
    const Time wake = all ? ticks.next() : sent + repeat;
    const auto ready = socket.receive<Ready>(std::max(wake - clock.now(), Duration::zero()));
    if (ready && std::cmp_less(ready->first.tile, heard.size()))
      heard[static_cast<std::size_t>(ready->first.tile)] = ready->first.number;
  }
}

void udp_tile(Sheet& sheet, int tile) {
  const MonotonicClock clock;
  Socket socket;
  socket.set(SOL_SOCKET, SO_REUSEADDR, 1);
  socket.bind_to(group(sheet.plan.port));
  socket.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, ip_mreq{group(sheet.plan.port).sin_addr, kLoopback});
  PlayedDrawing drawing(sheet.plan, tile);
  std::uint64_t drawn = 0, swapped = 0;
  while (true) {
    const auto message = socket.receive<Frame>(std::chrono::seconds(1));
    if (!message) continue;
    const auto& [frame, master] = *message;
    if (drawn > swapped && frame.released >= drawn) {
      sheet.swapped(tile, drawn, clock.now());
      if (frame.released != drawn) sheet.wrong();
      swapped = drawn;
    }
    if (frame.newest > drawn) {
      drawn = frame.newest;
      drawing.draw();
      sheet.ready(tile, drawn, clock.now());
    }
    if (drawn > frame.released || drawn == 0)
      socket.send(Ready{tile, static_cast<std::int64_t>(drawn)}, master);
  }
}

}  // namespace vindu
