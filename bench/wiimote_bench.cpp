// What the Wiimotes' driver costs: a report parsed, a report through the whole session, and eight
// devices at 200 reports a second with their threads. The reference for the last is a thread a
// device that only waits, reads and forgets.
#include <benchmark/benchmark.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>
#include <vector>

#include "tracker/wiimote/live.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr std::array<std::uint8_t, 18> kReport = {0x33, 0x28, 0x68, 0x80, 0x7f, 0x9a,
                                                  0xff, 0x80, 0x53, 0xff, 0xff, 0xff,
                                                  0xff, 0xff, 0xbf, 0x00, 0x00, 0x01};
constexpr int kDevices = 8, kRate_hz = 200;

void parse(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(parse_report(kReport));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(parse);

void session(benchmark::State& state) {
  WiimoteSession wiimote({});
  Time now{};
  for (auto _ : state) {
    now += milliseconds(5);
    benchmark::DoNotOptimize(wiimote.take(kReport, now));
    while (const auto output = wiimote.next_output(now)) benchmark::DoNotOptimize(output);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(session);

/// A device at the other end of a socket, with the system calls that hidapi makes on a hidraw node.
class SocketDevice final : public HidDevice {
 public:
  explicit SocketDevice(int file) : file_(file) {}
  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    const auto wait = std::chrono::ceil<milliseconds>(until - clock_.now()).count();
    pollfd ready{file_, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(wait, 0))) <= 0) return {};
    const auto size = ::recv(file_, buffer.data(), buffer.size(), 0);
    if (size <= 0) return {HidStatus::gone, 0, {}};
    return {HidStatus::report, static_cast<std::size_t>(size), clock_.now()};
  }
  bool write(std::span<const std::uint8_t>) override { return true; }

 private:
  int file_;
  MonotonicClock clock_;
};

/// Eight devices; a thread of this sends their reports.
class Sockets final : public HidBus {
 public:
  Sockets() {
    for (auto& pair : files_) socketpair(AF_UNIX, SOCK_SEQPACKET, 0, pair.data());
    sender_ = std::jthread([this](const std::stop_token& stop) { send(stop); });
  }
  ~Sockets() override {
    sender_ = {};
    for (const auto& pair : files_)
      for (const int file : pair) close(file);
  }
  Sockets(const Sockets&) = delete;
  Sockets& operator=(const Sockets&) = delete;

  std::vector<HidInfo> list() override {
    std::vector<HidInfo> all;
    for (int i = 0; i < kDevices; ++i)
      all.push_back({std::to_string(i), 0x057e, 0x0306, "Nintendo RVL-CNT-01", std::to_string(i)});
    return all;
  }
  std::unique_ptr<HidDevice> open(const std::string& path) override {
    return std::make_unique<SocketDevice>(files_.at(std::stoul(path))[0]);
  }
  double sender_cpu_s() const { return sender_cpu_s_; }

 private:
  void send(const std::stop_token& stop) {
    MonotonicClock clock;
    Time next = clock.now();
    while (!stop.stop_requested()) {
      for (const auto& pair : files_) ::send(pair[1], kReport.data(), kReport.size(), MSG_DONTWAIT);
      timespec used{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
      sender_cpu_s_ = static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
      clock.sleep_until(next += from_seconds(1.0 / kRate_hz));
    }
  }

  std::array<std::array<int, 2>, kDevices> files_{};
  std::atomic<double> sender_cpu_s_ = 0;
  std::jthread sender_;
};

double process_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto total = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return total(usage.ru_utime) + total(usage.ru_stime);
}

/// The share of one core that everything but the sender takes over two seconds.
template <class Work>
double cpu_share(Sockets& sockets, const Work& work) {
  MonotonicClock clock;
  const double cpu_before_s = process_cpu_s(), sender_before_s = sockets.sender_cpu_s();
  const Time begin = clock.now();
  while (clock.now() - begin < std::chrono::seconds(2)) {
    work();
    clock.sleep_until(clock.now() + milliseconds(16));
  }
  const double used_s = process_cpu_s() - cpu_before_s - (sockets.sender_cpu_s() - sender_before_s);
  return used_s / seconds(clock.now() - begin);
}

double bare_readers_share() {
  Sockets sockets;
  MonotonicClock clock;
  std::vector<std::jthread> readers;
  for (const HidInfo& info : sockets.list())
    readers.emplace_back([&sockets, &clock, path = info.path](const std::stop_token& stop) {
      const auto device = sockets.open(path);
      std::array<std::uint8_t, 64> buffer{};
      while (!stop.stop_requested()) device->read(buffer, clock.now() + milliseconds(100));
    });
  return cpu_share(sockets, [] {});
}

double driver_share() {
  Sockets sockets;
  MonotonicClock clock;
  WiimoteClaims claims;
  std::vector<std::unique_ptr<LiveWiimote>> wiimotes;
  for (int i = 0; i < kDevices; ++i)
    wiimotes.push_back(std::make_unique<LiveWiimote>(sockets, clock, claims,
                                                     LiveWiimoteOptions{.camera = i,
                                                                        .name = "bench",
                                                                        .address = {},
                                                                        .path = {},
                                                                        .settings = {},
                                                                        .on_sample = {},
                                                                        .tap = {}}));
  return cpu_share(sockets, [&] {
    for (const auto& wiimote : wiimotes)
      while (const auto observation = wiimote->next(clock.now()))
        benchmark::DoNotOptimize(observation);
  });
}

void eight_devices_at_200_hz(benchmark::State& state) {
  double driver = 0, bare = 0;
  for (auto _ : state) {
    bare = bare_readers_share();
    driver = driver_share();
  }
  state.counters["percent_of_a_core"] = 100 * driver;
  state.counters["ratio_to_bare_readers"] = driver / bare;
}
BENCHMARK(eight_devices_at_200_hz)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vindu
