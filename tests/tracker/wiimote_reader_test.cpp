// The reader on a device that is played from a list.
#include "tracker/wiimote/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace vindu {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

struct DeviceEvent {
  Time arrival{};
  Bytes bytes;  // empty: the device goes away
};

/// What was played and written, seen from the test.
struct Script {
  std::vector<DeviceEvent> events;
  std::vector<Bytes> written = {};
  int refuses = 0;  // so many of what is written next
  std::size_t next = 0;
};

class PlayedDevice final : public HidDevice {
 public:
  explicit PlayedDevice(Script& script) : script_(script) {}

  HidRead read(std::span<std::uint8_t> buffer, Time until) override {
    if (script_.next == script_.events.size()) return {};
    const DeviceEvent& event = script_.events[script_.next];
    if (event.arrival > until) return {};
    ++script_.next;
    if (event.bytes.empty()) return {HidStatus::gone, 0, {}};
    std::ranges::copy(event.bytes, buffer.begin());
    return {HidStatus::report, event.bytes.size(), event.arrival};
  }
  bool write(std::span<const std::uint8_t> report) override {
    script_.written.emplace_back(report.begin(), report.end());
    return script_.refuses == 0 || --script_.refuses < 0;
  }

 private:
  Script& script_;
};

Time at_ms(int ms) { return Time{} + milliseconds(ms); }

// One dot in slot 1, (x, 100) size 3, x below 256.
Bytes report_with_dot(std::uint8_t x_px) {
  return {0x33, 0,   0,    0x80, 0x80, 0x9a, 0xff, 0xff, 0xff,
          x_px, 100, 0x03, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff};
}

TEST(WiimoteReader, DrainsWhatHasArrivedInOrderAndSkipsReportsWithoutDots) {
  Script script{.events = {{at_ms(1), report_with_dot(10)},
                           {at_ms(2), {0x20, 0, 0, 0, 0, 0, 0}},
                           {at_ms(2), {0x30, 0, 0}},
                           {at_ms(3), report_with_dot(20)},
                           {at_ms(9), report_with_dot(30)}}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(script), 1);
  std::vector<Observation> seen;
  while (const auto observation = reader.next(at_ms(5))) seen.push_back(*observation);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].camera, 1);
  EXPECT_EQ(seen[0].arrival, at_ms(1));
  EXPECT_THAT(seen[0].dots, ElementsAre(Dot{10, 100, 3}));
  EXPECT_EQ(seen[1].arrival, at_ms(3));
  EXPECT_EQ(reader.session().health().samples, 3u);
  EXPECT_FALSE(reader.gone());
}

TEST(WiimoteReader, HandsOutAnObservationWithoutDotsWhenNoneAreInView) {
  Bytes none = report_with_dot(0);
  std::fill(none.begin() + 6, none.end(), 0xff);
  Script script{.events = {{at_ms(1), none}}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(script), 0);
  const auto observation = reader.next(at_ms(5));
  ASSERT_TRUE(observation);
  EXPECT_THAT(observation->dots, IsEmpty());
}

TEST(WiimoteReader, CountsReportsThatNobodyCanRead) {
  Script script{.events = {{at_ms(1), {0x33, 0, 0}}, {at_ms(2), {0x77}}}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(script), 0);
  EXPECT_FALSE(reader.next(at_ms(5)));
  EXPECT_EQ(reader.session().health().refused, 2u);
}

TEST(WiimoteReader, BeginsWithAStatusRequestAndRepeatsWhatIsNotAnswered) {
  Script script{.events = {}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(script), 0);
  reader.next(at_ms(1));
  EXPECT_THAT(script.written, ElementsAre(Bytes{0x15, 0x00}));
  reader.next(at_ms(600));
  EXPECT_THAT(script.written, ElementsAre(Bytes{0x15, 0x00}, Bytes{0x15, 0x00}, Bytes{0x15, 0x00}));
}

TEST(WiimoteReader, SaysThatADeviceRefusesWhatIsWrittenAlsoASecondTime) {
  for (const int refused : {1, 2}) {
    Script script{.events = {}, .refuses = refused};
    WiimoteReader reader(std::make_unique<PlayedDevice>(script), 0);
    reader.next(at_ms(1));
    EXPECT_THAT(script.written, ElementsAre(Bytes{0x15, 0x00}, Bytes{0x15, 0x00}));
    EXPECT_EQ(reader.refuses(), refused == 2);
  }
}

TEST(WiimoteReader, EndsWhenTheDeviceIsGoneAndGoesOnWhenItIsBack) {
  Script script{.events = {{at_ms(0), report_with_dot(10)}, {at_ms(0), {}}}};
  WiimoteReader reader(std::make_unique<PlayedDevice>(script), 0);
  EXPECT_TRUE(reader.next(at_ms(0)));
  EXPECT_FALSE(reader.next(at_ms(0)));
  EXPECT_TRUE(reader.gone());
  EXPECT_FALSE(reader.next(at_ms(1)));
  Script again{.events = {{at_ms(50), report_with_dot(20)}}};
  reader.reconnect(std::make_unique<PlayedDevice>(again), at_ms(40));
  EXPECT_TRUE(reader.next(at_ms(60)));
  EXPECT_THAT(again.written, Contains(Bytes{0x15, 0x00}));
  EXPECT_EQ(reader.session().health().samples, 2u);
}

}  // namespace
}  // namespace vindu
