// Messages as bytes: what goes in comes out bit by bit; anything else is refused and harms nobody.
#include "cluster/cdr.h"

#include <gmock/gmock.h>

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

  EXPECT_EQ(bytes.size(), 4 + 8 * (2 + 3 + 4 + 3 + 2) + 4 + 4 + 3u);
  EXPECT_THAT(Bytes(bytes.begin(), bytes.begin() + 12),
              ::testing::ElementsAre(0, 1, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(
      Bytes(bytes.end() - 3, bytes.end()),
      ::testing::ElementsAre(static_cast<int>(Mode::track), static_cast<int>(Pattern::bar), 1));
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
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 3, {3}))) << "no mode";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 2, {8}))) << "no pattern";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 1, {2}))) << "neither blank nor not";
  EXPECT_FALSE(frame_state_from_cdr(with(good.size() - 4, {0x80}))) << "clip -2^31";
  EXPECT_FALSE(frame_state_from_cdr(with(1, {0}))) << "big endian";
  EXPECT_FALSE(frame_state_from_cdr(with(1, {9}))) << "another encoding";
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
