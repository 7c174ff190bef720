#include "tests/faults/host.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <stdexcept>

namespace vindu::testing {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

void write_text(const char* file, const std::string& text) { std::ofstream(file) << text; }

int make_card() {
  const int card = open("/dev/net/tun", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (card < 0) fail("/dev/net/tun");
  ifreq request{};
  std::strcpy(request.ifr_name, "e0");
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  if (ioctl(card, TUNSETIFF, &request) != 0) fail("a TAP device");
  return card;
}

}  // namespace

bool become_master_of_namespaces() {
  if (geteuid() != 0) {
    const auto user = geteuid();
    const auto group = getegid();
    if (unshare(CLONE_NEWUSER) != 0) return false;
    write_text("/proc/self/setgroups", "deny");
    write_text("/proc/self/uid_map", fmt::format("0 {} 1", user));
    write_text("/proc/self/gid_map", fmt::format("0 {} 1", group));
  }
  return unshare(CLONE_NEWNS) == 0 &&
         mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

Host::Host(std::string name, int number, std::string folder)
    : name_(std::move(name)), folder_(std::move(folder)) {
  make_disk();
  // A thread can leave for another network by itself; what it opens there stays.
  std::async(std::launch::async, [this, number] { make_network(number); }).get();
}

Host::~Host() {
  close(card_);
  close(network_);
  umount2(folder_.c_str(), MNT_DETACH);
}

void Host::make_network(int number) {
  if (unshare(CLONE_NEWNET) != 0) fail("a network namespace");
  network_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  if (network_ < 0) fail("/proc/thread-self/ns/net");
  card_ = make_card();
  const std::string commands = fmt::format(
      "ip addr add 10.77.0.{}/24 dev e0 && ip link set e0 up && ip link set lo up && "
      "ip route add 224.0.0.0/4 dev e0",
      number);
  if (std::system(commands.c_str()) != 0) throw std::runtime_error(commands);
}

void Host::make_disk() {
  if (mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=48m") != 0) fail("a disk at " + folder_);
}

std::string Host::network() const {
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(network_));
}

void Host::plug(bool in) {
  const int carrier = in;
  if (ioctl(card_, TUNSETCARRIER, &carrier) != 0) fail("the carrier of " + name_);
}

void Host::fill_disk(bool full) {
  if (!full) {
    std::filesystem::remove(ballast());
    return;
  }
  const int file = open(ballast().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  // Ever smaller pieces, until not one byte is left.
  const std::string piece(65536, 'x');
  for (std::size_t size = piece.size(); size > 0; size /= 2)
    while (write(file, piece.data(), size) > 0) continue;
  close(file);
}

std::function<void()> Host::entrance() const {
  return [this] {
    if (setns(network_, CLONE_NEWNET) != 0 || unshare(CLONE_NEWUTS) != 0 ||
        sethostname(name_.c_str(), name_.size()) != 0 || chdir(folder_.c_str()) != 0)
      _exit(126);
    setenv("HOME", folder_.c_str(), 1);
    setenv("TMPDIR", folder_.c_str(), 1);
    unsetenv("XDG_CACHE_HOME");
    unsetenv("MESA_SHADER_CACHE_DIR");
  };
}

}  // namespace vindu::testing
