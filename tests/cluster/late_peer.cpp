// A master whose clock is late, so that a key that has ended counts for it: DDS and OpenSSL in this
// process are told the time by the two functions below.
//   late_peer WALL DOMAIN KEYS HOURS    publishes frames of epoch 666 for ever
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>

#include "cluster/dds.h"
#include "cluster/keys/key_folder.h"
#include "core/error.h"

namespace {
time_t late_s = 0;
}

// The linker's names, as <ctime> has declared those functions already.
int late_clock(clockid_t clock, timespec* time) noexcept __asm__("clock_gettime");
time_t late_time(time_t* result) noexcept __asm__("time");

int late_clock(clockid_t clock, timespec* time) noexcept {
  const long result = syscall(SYS_clock_gettime, clock, time);
  if (clock == CLOCK_REALTIME) time->tv_sec -= late_s;
  return static_cast<int>(result);
}
time_t late_time(time_t* result) noexcept {
  timespec now{};
  late_clock(CLOCK_REALTIME, &now);
  if (result) *result = now.tv_sec;
  return now.tv_sec;
}

int main(int count, char** begin) try {
  using namespace vindu;
  const std::vector<std::string> words(begin, begin + count);
  if (count != 5) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  late_s = 3600 * std::stol(words[4]);
  DdsSettings settings{.name = words[1], .domain = std::stoi(words[2])};
  settings.credentials = read_credential_files(words[3], {Role::master});
  DdsTransport transport(settings);
  const auto bus =
      transport.join({{Role::master, "late", "here", "0.1"}, {Topic::frame}, {Topic::ready}});
  std::puts("joined");
  std::fflush(stdout);
  while (true) {
    bus->publish(FrameMessage{.epoch = 666, .newest = {.number = 1}});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
} catch (const vindu::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
