// vindu measure accuracy: figures, plot, and the same again for the same seed.
#include "renderer/image.h"
#include "tests/app/process.h"

namespace vindu {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using MeasureCommand = AppTest;

TEST_F(MeasureCommand, PrintsTheSameFiguresForTheSameSeed) {
  const std::vector<std::string> words = {"measure", "accuracy", "--quick",
                                          "--json",  "--out",    path("plots")};
  const ProcessResult result = vindu(words);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out,
              AllOf(HasSubstr(R"("distance_m":3,"baseline_m":2,"cameras":2,"leds":3,)"),
                    HasSubstr(R"("ours":{"eye_mm":)"), HasSubstr(R"("bound":{"eye_mm":)"),
                    HasSubstr(R"("ours_over_bound":1.0)"), HasSubstr(R"("thesis":{"eye_mm":)"),
                    HasSubstr(R"("thesis_levels":{"six_dof":0,"hybrid":)"),
                    HasSubstr(R"("motion":"still")"), HasSubstr(R"("ours_over_best_fixed":)"),
                    HasSubstr(R"("met":true)"), Not(HasSubstr(R"("met":false)")),
                    HasSubstr(path("plots/accuracy.png"))));
  EXPECT_EQ(result.out.find("nan"), std::string::npos);
  EXPECT_EQ(vindu(words).out, result.out);
}

TEST_F(MeasureCommand, PrintsATableAndDrawsAPlot) {
  const ProcessResult result = vindu({"measure", "accuracy", "--quick", "--out", path("plots")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("Single frames: 100 poses a row"), HasSubstr("Targets"),
                                HasSubstr("3 m, base 2 m, 2 cameras, 3 LEDs"),
                                HasSubstr("sways 0.57 m/s, bursts, 30 ms, 2 cameras, 4 LEDs")));
  const Image plot = read_png(path("plots/accuracy.png"));
  const auto count = [&](Rgba8 colour) { return std::ranges::count(plot.pixels, colour); };
  EXPECT_GT(count({0, 114, 178, 255}), 500);  // Vindu's marks
  EXPECT_GT(count({213, 94, 0, 255}), 300);   // the thesis'
}

TEST_F(MeasureCommand, WrongWordsAreCalledWrong) {
  EXPECT_EQ(vindu({"measure"}).exit_code, 2);
  EXPECT_EQ(vindu({"measure", "accuracy", "--quick", "--poses", "50"}).exit_code, 2);
  EXPECT_EQ(vindu({"measure", "accuracy", "--seconds", "nan"}).exit_code, 2);
}

TEST_F(MeasureCommand, OfTooFewSecondsForAWalkToDifferFromAnotherIsRefused) {
  const ProcessResult result = vindu({"measure", "accuracy", "--seconds", "4"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, ::testing::HasSubstr("--seconds: \"4\" is not a number from 5 to 3600"));
}

}  // namespace
}  // namespace vindu
