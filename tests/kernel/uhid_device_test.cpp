// The events that a played device exchanges with the kernel, byte by byte at the offsets of
// Documentation/hid/uhid.rst's packed structures, and what a machine without /dev/uhid is told. A
// named pipe stands for the kernel; the real one is met by kernel_test.
#include "tracker/wiimote/uhid_device.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using Bytes = std::vector<std::uint8_t>;

const HidInfo kWiimote = {.path = {},
                          .vendor_id = 0x057e,
                          .product_id = 0x0306,
                          .name = "A name",
                          .address = "00:11:22:33:44:55"};
constexpr std::uint8_t kDescriptor[] = {0x05, 0x01, 0x09};

/// Where the kernel would be: what is written there can be read there.
class Pipe {
 public:
  Pipe() : folder_(::testing::TempDir() + "uhid-" + std::to_string(::getpid())) {
    std::filesystem::create_directories(folder_);
    ::mkfifo(name().c_str(), 0600);
    file_ = ::open(name().c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  ~Pipe() {
    ::close(file_);
    std::filesystem::remove_all(folder_);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  std::string name() const { return folder_ + "/uhid"; }
  Bytes take() {
    Bytes bytes(8192);
    const ssize_t size = ::read(file_, bytes.data(), bytes.size());
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }
  bool give(const Bytes& bytes) {
    return ::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  }

 private:
  std::string folder_;
  int file_ = -1;
};

Bytes part(const Bytes& bytes, std::size_t at, std::size_t size) {
  EXPECT_LE(at + size, bytes.size());
  if (at + size > bytes.size()) return {};
  return {bytes.begin() + static_cast<long>(at), bytes.begin() + static_cast<long>(at + size)};
}

/// Type in four bytes, then `body`, then zeros.
Bytes event(std::uint8_t type, const Bytes& body, std::size_t size) {
  Bytes bytes(size);
  bytes[0] = type;
  std::ranges::copy(body, bytes.begin() + 4);
  return bytes;
}

TEST(UhidDevice, IsCreatedOnTheBluetoothBusWithItsDescriptor) {
  Pipe kernel;
  const UhidDevice device(kWiimote, kDescriptor, kernel.name());

  const Bytes created = kernel.take();

  EXPECT_THAT(part(created, 0, 4), ElementsAre(11, 0, 0, 0));  // UHID_CREATE2
  EXPECT_STREQ(reinterpret_cast<const char*>(&created[4]), "A name");
  EXPECT_STREQ(reinterpret_cast<const char*>(&created[196]), "00:11:22:33:44:55");
  EXPECT_THAT(part(created, 260, 4), ElementsAre(3, 0, 5, 0));  // descriptor's size, bus
  EXPECT_THAT(part(created, 264, 8), ElementsAre(0x7e, 5, 0, 0, 6, 3, 0, 0));
  EXPECT_THAT(part(created, 280, 3), ElementsAre(0x05, 0x01, 0x09));
}

TEST(UhidDevice, GivesItsInputReportsToTheKernel) {
  Pipe kernel;
  UhidDevice device(kWiimote, kDescriptor, kernel.name());
  kernel.take();

  const bool taken = device.input(Bytes{0x30, 0x01, 0x02});

  EXPECT_TRUE(taken);
  EXPECT_THAT(kernel.take(), ElementsAre(12, 0, 0, 0, 3, 0, 0x30, 0x01, 0x02));
}

TEST(UhidDevice, HandsOutOutputReportsOnly) {
  Pipe kernel;
  UhidDevice device(kWiimote, kDescriptor, kernel.name());
  kernel.take();
  Bytes output = event(6, {0x12, 0x04, 0x33}, 4380);  // UHID_OUTPUT: data, then its size
  output[4 + 4096] = 3;

  kernel.give(output);

  EXPECT_THAT(device.next_output(MonotonicClock().now()),
              ::testing::Optional(ElementsAre(0x12, 0x04, 0x33)));
  EXPECT_EQ(device.next_output(MonotonicClock().now()), std::nullopt);
}

TEST(UhidDevice, ObeysARequestToSetAnOutputReport) {
  Pipe kernel;
  UhidDevice device(kWiimote, kDescriptor, kernel.name());
  kernel.take();
  kernel.give(event(13, {8, 0, 0, 0, 0x11, 1, 2, 0, 0x11, 0x10}, 4380));  // UHID_SET_REPORT

  const auto output = device.next_output(MonotonicClock().now());

  EXPECT_THAT(output, ::testing::Optional(ElementsAre(0x11, 0x10)));
  EXPECT_THAT(kernel.take(), ElementsAre(14, 0, 0, 0, 8, 0, 0, 0, 0, 0));
}

TEST(UhidDevice, IsUnpluggedAtItsEnd) {
  Pipe kernel;
  {
    const UhidDevice device(kWiimote, kDescriptor, kernel.name());
    kernel.take();
  }

  EXPECT_THAT(kernel.take(), ElementsAre(1, 0, 0, 0));  // UHID_DESTROY
}

TEST(UhidDevice, AMachineWithoutUhidIsTold) {
  EXPECT_THAT([] { UhidDevice(kWiimote, kDescriptor, "/dev/there-is-no-uhid"); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("/dev/there-is-no-uhid"), HasSubstr("sudo modprobe uhid"))));
}

TEST(UhidDevice, AKernelThatRefusesIsAnError) {
  EXPECT_THAT([] { UhidDevice(kWiimote, kDescriptor, "/dev/full"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("/dev/full"), HasSubstr("A name"))));
}

}  // namespace
}  // namespace vindu
