// vindu touch: hands before the wall, to the master of a running wall, whose mode touch follows
// them. They come as TUIO from a touch frame or a camera system, or from the pointer in a window.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/commands.h"
#include "app/common.h"
#include "app/stop_signals.h"
#include "app/touch_pad.h"
#include "app/tuio.h"
#include "app/wall_console.h"
#include "cluster/dds.h"
#include "core/error.h"
#include "core/log.h"

namespace vindu::app {
namespace {

struct TouchCommand {
  std::string wall_file;
  std::string listen = "127.0.0.1";
  int port = 3333;
  bool pointer = false;
  std::optional<double> seconds;
};

/// A UDP port that is listened to.
class Datagrams {
 public:
  /// Throws Error where the address is none of this machine's or the port is taken.
  Datagrams(const std::string& address, int port) {
    const std::string where = fmt::format("{}:{}", address, port);
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(static_cast<std::uint16_t>(port));
    if (inet_pton(AF_INET, address.c_str(), &own.sin_addr) != 1)
      throw Error({"is no IPv4 address", "--listen " + address, "0.0.0.0 means all of this host"});
    file_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (file_ < 0 || bind(file_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
      const std::string why = std::strerror(errno);
      close_file();
      throw Error({"cannot be listened to (" + why + ")", where,
                   "see which program has the port (ss -ulp), or choose another with --port"});
    }
  }
  ~Datagrams() { close_file(); }
  Datagrams(const Datagrams&) = delete;
  Datagrams& operator=(const Datagrams&) = delete;

  /// The next one, or an empty one where none came within 50 ms.
  std::span<const std::uint8_t> next() {
    pollfd poll_file{.fd = file_, .events = POLLIN, .revents = 0};
    if (poll(&poll_file, 1, 50) <= 0) return {};
    const ssize_t size = recv(file_, buffer_.data(), buffer_.size(), 0);
    return std::span(buffer_).first(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }

 private:
  void close_file() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }
  int file_ = -1;
  std::array<std::uint8_t, 65536> buffer_{};
};

/// What is touched, to the wall.
class Sender {
 public:
  explicit Sender(const Site& site)
      : picture_px_(site.wall.picture_px()),
        transport_(network_of(site, Role::console)),
        bus_(transport_.join({this_console(site), {Topic::event}, {}})),
        terminal_(isatty(STDERR_FILENO) == 1) {}
  ~Sender() {
    if (terminal_ && sent_ > 0) std::fputc('\n', stderr);
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void send(const TuioChange& change) {
    const Vec2 at_px = change.at.cwiseProduct(picture_px_);
    const std::string name = change.source.empty() ? "tuio" : change.source;
    bus_->publish(EventMessage{.source = host_name() + "/" + name,
                               .kind = EventKind::touch,
                               .phase = change.phase,
                               .id = change.id,
                               .x_px = at_px.x(),
                               .y_px = at_px.y()});
    ++sent_;
    if (terminal_)
      fmt::print(stderr, "\r\x1b[Kpoint {} at {:.0f}, {:.0f} of {:.0f} x {:.0f} px", change.id,
                 at_px.x(), at_px.y(), picture_px_.x(), picture_px_.y());
  }
  std::uint64_t sent() const { return sent_; }

 private:
  Vec2 picture_px_;
  DdsTransport transport_;
  std::unique_ptr<Bus> bus_;
  bool terminal_;
  std::uint64_t sent_ = 0;
};

void listen(const TouchCommand& command, Sender& sender, const std::function<bool()>& goes_on) {
  Datagrams datagrams(command.listen, command.port);
  TuioReader reader;
  log_info("touch", fmt::format("listens for TUIO on {}:{}", command.listen, command.port));
  while (goes_on())
    if (const auto datagram = datagrams.next(); !datagram.empty())
      for (const TuioChange& change : reader.read(datagram)) sender.send(change);
  fmt::print("{} changes of points sent, {} messages were no TUIO\n", sender.sent(),
             reader.refused());
}

void point(const Site& site, Sender& sender, const std::function<bool()>& goes_on) {
  TouchPad pad(site.wall);
  while (goes_on() && pad.show())
    if (const auto change = pad.take_change()) sender.send(*change);
  fmt::print("{} changes of points sent\n", sender.sent());
}

int touch(const TouchCommand& command) {
  const Site site = load_site(command.wall_file);
  const StopSignals signals;
  Sender sender(site);
  const MonotonicClock clock;
  const Time start = clock.now();
  const auto goes_on = [&] {
    return !signals.came_within(Duration::zero()) &&
           !(command.seconds && seconds(clock.now() - start) > *command.seconds);
  };
  if (command.pointer)
    point(site, sender, goes_on);
  else
    listen(command, sender, goes_on);
  return 0;
}

}  // namespace

void add_touch(CLI::App& parent, Action& chosen) {
  auto command = std::make_shared<TouchCommand>();
  CLI::App* app = parent.add_subcommand(
      "touch", "Hands before the wall (TUIO, or a window's pointer), for the mode touch");
  app->add_option("--wall", command->wall_file, "Wall file (default: the 7x4 Tromsø wall)")
      ->type_name("FILE");
  app->add_option("--listen", command->listen, "IPv4 address of this host for TUIO 1.1")
      ->capture_default_str()
      ->type_name("ADDRESS");
  app->add_option("--port", command->port, "UDP port")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  app->add_flag("--pointer", command->pointer,
                "A small wall in a window: the pointer over it is the hand");
  app->add_option("--seconds", command->seconds, "Length (default: until it is stopped)")
      ->check(between(0.05, 1e8));
  app->footer(
      "\nExamples:\n"
      "  vindu mode touch --wall wall.toml                    then one of these:\n"
      "  vindu touch --wall wall.toml --pointer               the pointer is the hand\n"
      "  vindu touch --wall wall.toml --listen 192.168.5.2    a TUIO sender on the network\n");
  app->callback([command, &chosen] { chosen = [command] { return touch(*command); }; });
}

}  // namespace vindu::app
