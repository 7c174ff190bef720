// The reader on a device that is played from a list.
#include "tracker/wiimote/reader.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"
#include "tracker/wiimote/emulator.h"

namespace vindu {
namespace {

using std::chrono::milliseconds;

struct Event {
  Time arrival{};
  std::vector<std::uint8_t> bytes;  // empty: the device goes away
};

class PlayedDevice final : public HidDevice {
 public:
  PlayedDevice(std::vector<Event> events, std::vector<std::uint8_t>* written, bool accepts = true)
      : events_(std::move(events)), written_(written), accepts_(accepts) {}

  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    if (next_ == events_.size() || events_[next_].arrival > until) return {};
    const Event& event = events_[next_++];
    if (event.bytes.empty()) return {HidStatus::gone, 0, {}};
    std::ranges::copy(event.bytes, buffer.begin());
    return {HidStatus::report, event.bytes.size(), event.arrival};
  }
  bool write(std::span<const std::uint8_t> report) override {
    written_->assign(report.begin(), report.end());
    return accepts_;
  }

 private:
  std::vector<Event> events_;
  std::vector<std::uint8_t>* written_;
  bool accepts_;
  std::size_t next_ = 0;
};

std::vector<std::uint8_t> report_with_dot(int x_px) {
  SensorState state;
  state.slots[1] = SensorDot{x_px, 100, 3};
  const auto bytes = encode_report_0x33(state);
  return {bytes.begin(), bytes.end()};
}

TEST(WiimoteReader, asks_for_report_0x33_continuously) {
  std::vector<std::uint8_t> written;
  const WiimoteReader reader(std::make_unique<PlayedDevice>(std::vector<Event>{}, &written), 0,
                             "left");
  EXPECT_EQ(written, (std::vector<std::uint8_t>{0x12, 0x04, 0x33}));
}

TEST(WiimoteReader, fails_with_the_devices_name_when_the_request_is_refused) {
  std::vector<std::uint8_t> written;
  auto device = std::make_unique<PlayedDevice>(std::vector<Event>{}, &written, false);
  try {
    const WiimoteReader reader(std::move(device), 0, "left");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("left"), std::string::npos);
  }
}

TEST(WiimoteReader, drains_what_has_arrived_in_order_and_skips_other_reports) {
  std::vector<std::uint8_t> written;
  const std::vector<Event> events = {{Time{milliseconds(1)}, report_with_dot(10)},
                                     {Time{milliseconds(2)}, {0x20, 0, 0, 0, 0, 0, 0}},
                                     {Time{milliseconds(3)}, report_with_dot(20)},
                                     {Time{milliseconds(9)}, report_with_dot(30)}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(events, &written), 1, "right");
  std::vector<Observation> seen;
  while (const auto observation = reader.next(Time{milliseconds(5)})) seen.push_back(*observation);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].camera, 1);
  EXPECT_EQ(seen[0].arrival, Time{milliseconds(1)});
  EXPECT_EQ(seen[0].dots[0], (Dot{10, 100, 3}));
  EXPECT_EQ(seen[1].arrival, Time{milliseconds(3)});
  EXPECT_EQ(reader.counts().reports, 2u);
  EXPECT_EQ(reader.counts().refused, 1u);
  EXPECT_FALSE(reader.gone());
}

TEST(WiimoteReader, ends_when_the_device_is_gone) {
  std::vector<std::uint8_t> written;
  const std::vector<Event> events = {{Time{}, report_with_dot(10)}, {Time{}, {}}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(events, &written), 0, "left");
  EXPECT_TRUE(reader.next(Time{}));
  EXPECT_FALSE(reader.next(Time{}));
  EXPECT_TRUE(reader.gone());
  EXPECT_FALSE(reader.next(Time{}));
}

}  // namespace
}  // namespace vindu
