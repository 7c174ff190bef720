// TUIO as its senders send it, and as nobody should.
#include "app/tuio.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/app/osc_bytes.h"

namespace vindu::app {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TuioChange change(EventPhase phase, int id, double x, double y, const std::string& source = "") {
  return {source, phase, id, Vec2(x, y)};
}

TEST(OscBytes, AreThoseOfTheSpecificationsExample) {
  // alive 5: address, types, "alive", 5; each padded to four bytes.
  const std::string expected("/tuio/2Dcur\0,si\0alive\0\0\0\0\0\0\x05", 12 + 4 + 8 + 4);
  const Bytes bytes = alive({5});
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), expected);
}

TEST(Tuio, APointBeginsMovesAndEnds) {
  TuioReader reader;
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 0.5f, 0.25f), fseq(1)})),
              ElementsAre(change(EventPhase::begin, 7, 0.5, 0.25)));
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 0.75f, 0.25f), fseq(2)})),
              ElementsAre(change(EventPhase::change, 7, 0.75, 0.25)));
  EXPECT_THAT(reader.read(bundle({alive({7}), fseq(3)})), IsEmpty());
  EXPECT_THAT(reader.read(bundle({alive({}), fseq(4)})),
              ElementsAre(change(EventPhase::end, 7, 0.75, 0.25)));
  EXPECT_EQ(reader.refused(), 0u);
}

TEST(Tuio, NothingIsKnownBeforeAFrameEnds) {
  TuioReader reader;
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 0.5f, 0.25f)})), IsEmpty());
  EXPECT_THAT(reader.read(fseq(1)), SizeIs(1));
}

TEST(Tuio, AFrameThatWasOvertakenIsDropped) {
  TuioReader reader;
  reader.read(bundle({alive({7}), set(7, 0.5f, 0.5f), fseq(10)}));
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 0.1f, 0.1f), fseq(9)})), IsEmpty());
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 0.6f, 0.5f), fseq(11)})), SizeIs(1));
}

TEST(Tuio, ASenderThatWasStartedAgainCountsFromItsBeginning) {
  TuioReader reader;
  reader.read(bundle({alive({7}), set(7, 0.5f, 0.5f), fseq(5000)}));
  EXPECT_THAT(
      reader.read(bundle({alive({1}), set(1, 0.25f, 0.5f), fseq(1)})),
      ElementsAre(change(EventPhase::end, 7, 0.5, 0.5), change(EventPhase::begin, 1, 0.25, 0.5)));
}

TEST(Tuio, SendersDoNotMix) {
  TuioReader reader;
  reader.read(bundle({source("left"), alive({1}), set(1, 0.25f, 0.5f), fseq(40)}));
  EXPECT_THAT(reader.read(bundle({source("right"), alive({1}), set(1, 0.5f, 0.5f), fseq(3)})),
              ElementsAre(change(EventPhase::begin, 1, 0.5, 0.5, "right")));
  EXPECT_THAT(reader.read(bundle({source("left"), alive({}), fseq(41)})),
              ElementsAre(change(EventPhase::end, 1, 0.25, 0.5, "left")));
}

TEST(Tuio, APointBesideThePictureCountsAsItsEdgeAndOneThatIsNoNumberAsNone) {
  TuioReader reader;
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, 1.5f, -0.25f), fseq(1)})),
              ElementsAre(change(EventPhase::begin, 7, 1, 0)));
  EXPECT_THAT(reader.read(bundle({alive({7}), set(7, NAN, 0.5f), fseq(2)})), IsEmpty());
}

TEST(Tuio, WhatIsCutOffAnywhereChangesNothingThatItDoesNotSay) {
  const Bytes whole = bundle({alive({7}), set(7, 0.5f, 0.25f), fseq(1)});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    TuioReader reader;
    EXPECT_THAT(reader.read(std::span(whole).first(size)), IsEmpty()) << size;
  }
}

TEST(Tuio, RandomAndDamagedDatagramsAreSurvived) {
  std::mt19937 random(7);
  const Bytes whole = bundle({source("a"), alive({7, 8}), set(7, 0.5f, 0.25f), fseq(1)});
  TuioReader reader;
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes = whole;
    if (i % 4 == 0) bytes.resize(random() % 80);
    for (unsigned change = 0; change < 1 + random() % 4 && !bytes.empty(); ++change)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    for (const TuioChange& change : reader.read(bytes)) {
      ASSERT_TRUE(change.at.allFinite());
      ASSERT_LE(change.at.maxCoeff(), 1);
      ASSERT_GE(change.at.minCoeff(), 0);
    }
  }
  EXPECT_GT(reader.refused(), 0u);
}

TEST(Tuio, BundlesInBundlesWithoutEndAreRefused) {
  Bytes nested = bundle({});
  for (int depth = 0; depth < 1000; ++depth) nested = bundle({nested});
  TuioReader reader;
  EXPECT_THAT(reader.read(nested), IsEmpty());
  EXPECT_EQ(reader.refused(), 1u);
}

}  // namespace
}  // namespace vindu::app
