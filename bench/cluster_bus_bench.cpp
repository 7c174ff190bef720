// Poses to 1..28 processes at 240 Hz over the bus, beside a raw UDP multicast sender of as many
// bytes in the same run, both on loopback. A latency is from before publish() to after take() in
// the receiver; "last" is when the last of all processes has a message: that is what a wall feels.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "bench/quantile.h"
#include "cluster/cdr.h"
#include "cluster/dds.h"
#include "cluster/keys/authority.h"

namespace vindu {
namespace {

constexpr int kMostReceivers = 64;
constexpr int kMessages = 720;
constexpr int kRounds = 3;  // of each in turn, so that the machine's moods meet both
const Duration kPeriod = from_seconds(1.0 / 240);

Time now() { return std::chrono::steady_clock::now(); }

/// Latencies of all processes, in memory that they share; 0: not received.
struct Sheet {
  std::atomic<int> hearing = 0;
  double latency_us[kMostReceivers][kMessages] = {};
};

struct SheetUnmapper {
  void operator()(Sheet* sheet) const { munmap(sheet, sizeof(Sheet)); }
};
using SharedSheet = std::unique_ptr<Sheet, SheetUnmapper>;

SharedSheet make_sheet() {
  void* const memory =
      mmap(nullptr, sizeof(Sheet), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) std::abort();
  return SharedSheet(new (memory) Sheet);
}

/// A message: its index among those that count (-1 while some do not hear yet), and when it left.
struct Stamp {
  int index = -1;
  Time sent{};
};

using Send = std::function<void(const Stamp&)>;
using Receive = std::function<std::optional<Stamp>()>;  ///< blocks for at most some time

/// One way to carry stamps; made anew in every process.
struct Carrier {
  std::function<Send()> sender;
  std::function<Receive()> receiver;
};

[[noreturn]] void receive_for_ever(const Carrier& carrier, Sheet& sheet, int self) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Receive receive = carrier.receiver();
  bool heard = false;
  while (true) {
    const auto stamp = receive();
    if (!stamp) continue;
    if (!heard) ++sheet.hearing;
    heard = true;
    if (stamp->index >= 0)
      sheet.latency_us[self][stamp->index] = 1e6 * seconds(now() - stamp->sent);
  }
}

/// Forks before any thread runs here, so that the children may do as they like.
SharedSheet run(const Carrier& carrier, int receivers) {
  SharedSheet sheet = make_sheet();
  std::vector<pid_t> children;
  for (int i = 0; i < receivers; ++i) {
    children.push_back(fork());
    if (children.back() == 0) receive_for_ever(carrier, *sheet, i);
  }
  {
    const Send send = carrier.sender();
    MonotonicClock clock;
    Time next = now();
    for (int index = -1; index < kMessages;) {
      clock.sleep_until(next += kPeriod);
      send({index, now()});
      if (index >= 0 || sheet->hearing == receivers) ++index;
    }
    clock.sleep_until(now() + from_seconds(0.2));
  }
  for (const pid_t child : children) kill(child, SIGKILL);
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  return sheet;
}

PoseMessage pose_of(const Stamp& stamp) {
  PoseMessage message;
  message.pose.time = stamp.sent;
  message.pose.object = 0;
  message.tracker = std::to_string(stamp.index);
  return message;
}

Carrier over_dds(const DdsSettings& settings) {
  const auto join = [settings](const char* name, Topics publishes, Topics subscribes) {
    auto transport = std::make_shared<DdsTransport>(settings);
    std::shared_ptr<Bus> bus =
        transport->join({{Role::master, name, "here", "bench"}, publishes, subscribes});
    return std::pair(transport, bus);
  };
  return {[join]() -> Send {
            return [pair = join("sender", {Topic::pose}, {})](const Stamp& stamp) {
              pair.second->publish(pose_of(stamp));
            };
          },
          [join]() -> Receive {
            return [pair = join("receiver", {}, {Topic::pose})]() -> std::optional<Stamp> {
              pair.second->wait({Topic::pose}, now() + from_seconds(1));
              const auto message = pair.second->take_newest<PoseMessage>();
              if (!message) return std::nullopt;
              return Stamp{std::atoi(message->tracker.c_str()), message->pose.time};
            };
          }};
}

struct Socket {
  Socket() : handle(socket(AF_INET, SOCK_DGRAM, 0)) {}
  ~Socket() { close(handle); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int handle;
};

sockaddr_in group() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(20000 + getpgrp() % 20000));
  address.sin_addr.s_addr = inet_addr("239.255.77.1");
  return address;
}

Receive udp_receiver() {
  auto socket = std::make_shared<Socket>();
  const int yes = 1;
  setsockopt(socket->handle, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const sockaddr_in address = group();
  if (bind(socket->handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    std::abort();
  const ip_mreq membership{address.sin_addr, {inet_addr("127.0.0.1")}};
  setsockopt(socket->handle, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
  return [socket]() -> std::optional<Stamp> {
    char bytes[2048];
    Stamp stamp;
    if (recv(socket->handle, bytes, sizeof bytes, 0) < long(sizeof stamp)) return std::nullopt;
    std::memcpy(&stamp, bytes, sizeof stamp);
    return stamp;
  };
}

Send udp_sender(std::size_t size) {
  auto socket = std::make_shared<Socket>();
  const in_addr loopback{inet_addr("127.0.0.1")};
  setsockopt(socket->handle, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback);
  return [socket, bytes = std::vector<char>(size)](const Stamp& stamp) mutable {
    std::memcpy(bytes.data(), &stamp, sizeof stamp);
    const sockaddr_in to = group();
    sendto(socket->handle, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
           sizeof to);
  };
}

struct Latencies {
  std::vector<double> each_us;
  std::vector<double> last_us;
  double missed = 0;

  void add(const Sheet& sheet, int receivers) {
    for (int message = 0; message < kMessages; ++message) {
      double last = 0;
      for (int i = 0; i < receivers; ++i) {
        const double latency = sheet.latency_us[i][message];
        if (latency > 0)
          each_us.push_back(latency);
        else
          ++missed;
        last = std::max(last, latency);
      }
      last_us.push_back(last);
    }
  }
};

/// A key that may write and read poses.
Credentials new_credentials() {
  std::string folder = std::filesystem::temp_directory_path() / "vindu_bench_XXXXXX";
  if (!mkdtemp(folder.data())) std::abort();
  const auto now = std::chrono::system_clock::now();
  Authority(folder).issue({Role::master}, {now - std::chrono::days(1), now + std::chrono::days(1)});
  Credentials credentials = read_credential_files(folder, {Role::master});
  std::filesystem::remove_all(folder);
  return credentials;
}

void pose_fan_out(benchmark::State& state, bool with_keys) {
  const auto receivers = static_cast<int>(state.range(0));
  const std::size_t size = to_cdr(pose_of({})).size();
  const Carrier udp{[size] { return udp_sender(size); }, udp_receiver};
  DdsSettings settings{.name = "bench" + std::to_string(getpid())};
  if (with_keys) settings.credentials = new_credentials();
  const Carrier dds = over_dds(settings);
  Latencies bus, raw;
  for (auto _ : state)
    for (int round = 0; round < kRounds; ++round) {
      raw.add(*run(udp, receivers), receivers);
      bus.add(*run(dds, receivers), receivers);
    }
  state.counters["udp_p50_us"] = quantile(raw.each_us, 0.5);
  state.counters["udp_p99_us"] = quantile(raw.each_us, 0.99);
  state.counters["bus_p50_us"] = quantile(bus.each_us, 0.5);
  state.counters["bus_p99_us"] = quantile(bus.each_us, 0.99);
  state.counters["p50_ratio"] = quantile(bus.each_us, 0.5) / quantile(raw.each_us, 0.5);
  state.counters["p99_ratio"] = quantile(bus.each_us, 0.99) / quantile(raw.each_us, 0.99);
  state.counters["last_p99_ratio"] = quantile(bus.last_us, 0.99) / quantile(raw.last_us, 0.99);
  state.counters["bus_conflated"] = bus.missed;
  state.counters["udp_missed"] = raw.missed;
}
BENCHMARK_CAPTURE(pose_fan_out, open, false)
    ->Arg(1)
    ->Arg(2)
    ->Arg(7)
    ->Arg(14)
    ->Arg(28)
    ->Iterations(1)
    ->UseRealTime();
BENCHMARK_CAPTURE(pose_fan_out, with_keys, true)
    ->Arg(1)
    ->Arg(7)
    ->Arg(28)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
}  // namespace vindu
