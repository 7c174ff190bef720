// Messages as bytes: what goes in comes out bit by bit; anything else is refused and harms nobody.
#include "cluster/cdr.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "tests/cluster/random_messages.h"

namespace vindu {
namespace {

using testing::random_message;
using testing::random_state;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(FrameStateCdr, ComesBackBitByBit) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const FrameState state = random_state(random);
    const Bytes bytes = to_cdr(state);
    const auto back = frame_state_from_cdr(bytes);
    ASSERT_TRUE(back);
    ASSERT_EQ(hash_of(*back), hash_of(state));
    ASSERT_EQ(to_cdr(*back), bytes);
  }
}

// What recordings rest on: these bytes may change only together with kProtocolVersion.
TEST(FrameStateCdr, IsPlainLittleEndianCdrBehindItsHeader) {
  const Bytes bytes = to_cdr(FrameState{.number = 0x0102, .pattern = Pattern::bar, .blank = true});

  EXPECT_EQ(bytes.size(), 4 + 8 * (2 + 3 + 4 + 3 + 2) + 4 + 4 + 4u);
  EXPECT_THAT(Bytes(bytes.begin(), bytes.begin() + 12),
              ::testing::ElementsAre(0, 1, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(
      Bytes(bytes.end() - 4, bytes.end()),
      ::testing::ElementsAre(static_cast<int>(Mode::track), static_cast<int>(Pattern::bar), 1, 0));
}

TEST(FrameStateCdr, RefusesEveryLengthButItsOwn) {
  Bytes bytes = to_cdr(FrameState{.number = 1});
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(frame_state_from_cdr({bytes.data(), length})) << length;
  bytes.push_back(0);
  EXPECT_FALSE(frame_state_from_cdr(bytes));
}

TEST(FrameStateCdr, RefusesWhatIsNoState) {
  const auto changed = [](auto change) {
    FrameState state{.number = 1};
    change(state);
    return to_cdr(state);
  };
  EXPECT_FALSE(changed([](FrameState&) {}).empty());
  for (const double bad : {kNan, kInfinite, -kInfinite, 1e300}) {
    EXPECT_TRUE(changed([=](FrameState& state) { state.eye_in_wall.y() = bad; }).empty());
    EXPECT_TRUE(changed([=](FrameState& state) { state.animation_time_s = bad; }).empty());
    EXPECT_TRUE(changed([=](FrameState& state) { state.navigation.scale = bad; }).empty());
    EXPECT_TRUE(changed([=](FrameState& state) {
                  state.navigation.wall_from_scene.rotation.w() = bad;
                }).empty());
  }
  EXPECT_TRUE(changed([](FrameState& state) { state.number = 0; }).empty());
  EXPECT_TRUE(changed([](FrameState& state) { state.navigation.scale = 0; }).empty());
  EXPECT_TRUE(changed([](FrameState& state) { state.clip = -2; }).empty());
  EXPECT_TRUE(changed([](FrameState& state) { state.photon_time = Time::max(); }).empty());
}

TEST(FrameStateCdr, RefusesTheSameFromOutside) {
  const Bytes good = to_cdr(FrameState{.number = 1});
  const auto with = [&good](std::size_t at, std::initializer_list<int> values) {
    Bytes bytes = good;
    for (const int value : values) bytes[at++] = static_cast<std::uint8_t>(value);
    return bytes;
  };
  ASSERT_TRUE(frame_state_from_cdr(good));
  EXPECT_FALSE(frame_state_from_cdr(with(4, {0}))) << "number 0";
  EXPECT_FALSE(frame_state_from_cdr(with(4 + 8 + 7, {0x7f}))) << "a time of 292 years";
  EXPECT_FALSE(frame_state_from_cdr(with(4 + 16 + 6, {0xf8, 0x7f}))) << "NaN";
  EXPECT_FALSE(frame_state_from_cdr(with(4 + 16 + 6, {0xf0, 0x7f}))) << "infinite";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 4, {3}))) << "no mode";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 3, {8}))) << "no pattern";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 2, {2}))) << "neither blank nor not";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 5, {0x80}))) << "clip -2^31";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 1, {1})))
      << "a touch page, and it is not there";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 1, {2}))) << "neither a touch page nor none";
  EXPECT_FALSE(frame_state_from_cdr(with(1, {0}))) << "big endian";
  EXPECT_FALSE(frame_state_from_cdr(with(1, {9}))) << "another encoding";
}

FrameState touch_state(const TouchPage& page) { return {.number = 1, .touch_page = page}; }

TouchPage touch_page_of(std::size_t points) {
  return {.points = {points, {{1, 2, 0}, "tile-3-1"}},
          .done = 1,
          .held = 0.25,
          .remark = "only left sees the LED"};
}

TEST(TouchPageCdr, ComesBackWhole) {
  for (const std::size_t points : {std::size_t{1}, std::size_t{5}, kMostTouchPoints}) {
    const auto back = frame_state_from_cdr(to_cdr(touch_state(touch_page_of(points))));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->touch_page, touch_page_of(points));
  }
}

// So a wall that shows none carries nothing for it, sixty times a second.
TEST(TouchPageCdr, TakesNoRoomWhereThereIsNone) {
  const std::size_t without = to_cdr(FrameState{.number = 1}).size();
  EXPECT_GT(to_cdr(touch_state(touch_page_of(1))).size(), without + 24 * kMostTouchPoints);
}

TEST(TouchPageCdr, RefusesWhatIsNoPage) {
  const auto changed = [](auto change) {
    TouchPage page = touch_page_of(3);
    change(page);
    return to_cdr(touch_state(page));
  };
  EXPECT_FALSE(changed([](TouchPage&) {}).empty());
  for (const double bad : {kNan, kInfinite, -1.0, 1e300}) {
    EXPECT_TRUE(changed([=](TouchPage& page) { page.held = bad; }).empty());
    EXPECT_TRUE(changed([=](TouchPage& page) { page.ring_m = bad; }).empty());
  }
  for (const double bad : {kNan, kInfinite, 2e4})
    EXPECT_TRUE(changed([=](TouchPage& page) { page.points[2].x_in_wall.z() = bad; }).empty());
  EXPECT_TRUE(changed([](TouchPage& page) { page.points[1].tile.clear(); }).empty());
  EXPECT_TRUE(changed([](TouchPage& page) { page.done = 4; }).empty());
  EXPECT_TRUE(to_cdr(touch_state(touch_page_of(kMostTouchPoints + 1))).empty());
}

/// The byte that tells the two apart.
std::size_t place_of_difference(const Bytes& a, const Bytes& b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

TEST(TouchPageCdr, RefusesTheSameFromOutside) {
  TouchPage one = touch_page_of(3), other = one;
  other.done = 2;
  Bytes bytes = to_cdr(touch_state(one));
  const std::size_t done = place_of_difference(bytes, to_cdr(touch_state(other))), count = done - 1;
  ASSERT_EQ(bytes[done], 1);
  ASSERT_EQ(bytes[count], 3);
  bytes[done] = 4;
  EXPECT_FALSE(frame_state_from_cdr(bytes)) << "4 of 3 are touched";
  bytes[done] = 1;
  for (const int bad : {21, 255}) {
    bytes[count] = static_cast<std::uint8_t>(bad);
    EXPECT_FALSE(frame_state_from_cdr(bytes)) << bad << " points";
  }
  bytes[count] = 4;
  EXPECT_FALSE(frame_state_from_cdr(bytes)) << "the fourth is on no tile";
}

TEST(TouchPageCdr, TravelsInACommand) {
  const CommandMessage command{.sender = "c",
                               .request = 1,
                               .verb = Verb::touch_page,
                               .touch_page = touch_page_of(kMostTouchPoints)};
  const auto back = message_from_cdr(Topic::command, to_cdr(command));
  ASSERT_TRUE(back);
  EXPECT_EQ(std::get<CommandMessage>(*back).touch_page, command.touch_page);
}

class MessageCdr : public ::testing::TestWithParam<Topic> {};

TEST_P(MessageCdr, ComesBackByteByByte) {
  Random random(2);
  for (int i = 0; i < 2'000; ++i) {
    const Bytes bytes = to_cdr(random_message(random, GetParam()));
    const auto back = message_from_cdr(GetParam(), bytes);
    ASSERT_TRUE(back);
    ASSERT_EQ(topic_of(*back), GetParam());
    ASSERT_EQ(to_cdr(*back), bytes);
  }
}

TEST_P(MessageCdr, RefusesWhatIsCutShort) {
  Random random(3);
  const Bytes bytes = to_cdr(random_message(random, GetParam()));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<long>(length));
    EXPECT_FALSE(message_from_cdr(GetParam(), cut)) << length;
  }
}

/// Bytes replaced, inserted and taken away.
Bytes mutated(Bytes bytes, Random& random) {
  const auto place = [&] { return static_cast<long>(random.uniform(0, double(bytes.size()))); };
  const int changes = 1 + static_cast<int>(random.uniform(0, 4));
  for (int i = 0; i < changes && !bytes.empty(); ++i) {
    const double what = random.uniform(0, 1);
    const auto value = static_cast<std::uint8_t>(random.uniform(0, 256));
    if (what < 0.8)
      bytes[static_cast<std::size_t>(place())] = value;
    else if (what < 0.9)
      bytes.insert(bytes.begin() + place(), value);
    else
      bytes.erase(bytes.begin() + place());
  }
  return bytes;
}

TEST_P(MessageCdr, OfMutatedBytesIsRefusedOrAGoodMessage) {
  Random random(4);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (GetParam() == Topic::wall && i == 2'000) break;  // each of them is 60 KB
    const Bytes bytes = mutated(to_cdr(random_message(random, GetParam())), random);
    const auto message = message_from_cdr(GetParam(), bytes);
    if (message) {
      ASSERT_FALSE(to_cdr(*message).empty()) << "taken, but could not be sent";
    }
    refused += !message;
  }
  EXPECT_GT(refused, 100);
}

std::string topic_name(const ::testing::TestParamInfo<Topic>& info) {
  return std::string(rules_of(info.param).name);
}

INSTANTIATE_TEST_SUITE_P(Of, MessageCdr,
                         ::testing::Values(Topic::frame, Topic::ready, Topic::tile_status,
                                           Topic::scene, Topic::wall, Topic::pose, Topic::camera,
                                           Topic::event, Topic::command, Topic::answer, Topic::log,
                                           Topic::report),
                         topic_name);

TEST(MessageCdr, OfAnEpochOrNumberZeroIsRefused) {
  EXPECT_FALSE(to_cdr(FrameMessage{.epoch = 1, .newest = {.number = 1}}).empty());
  EXPECT_TRUE(to_cdr(FrameMessage{.epoch = 0, .newest = {.number = 1}}).empty());
  EXPECT_TRUE(to_cdr(FrameMessage{.epoch = 1, .newest = {.number = 0}}).empty());
  EXPECT_TRUE(to_cdr(FrameMessage{.epoch = 1, .newest = {.number = 1}, .released = 2}).empty());
}

TEST(MessageCdr, CutsLongTextsAtALetterButNeverNamesAndPaths) {
  const std::string letters(600, 'x');
  const auto back = message_from_cdr(
      Topic::log, to_cdr(LogMessage{.source = "a", .text = letters.substr(0, 510) + "\u00e4"}));

  ASSERT_TRUE(back);
  EXPECT_EQ(std::get<LogMessage>(*back).text, letters.substr(0, 510));
  EXPECT_TRUE(to_cdr(LogMessage{.source = letters, .text = "a"}).empty());
  EXPECT_TRUE(to_cdr(SceneMessage{.revision = 1, .path = std::string(1024, 'x')}).empty());
}

}  // namespace
}  // namespace vindu
