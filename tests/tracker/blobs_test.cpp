// Blobs: which pixels make a dot, where it is, and how exactly.
#include "tracker/ir_camera/blobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/tracker/ir_pictures.h"

namespace vindu {
namespace {

using testing::IrPicture;
using ::testing::SizeIs;
using testing::Spot;

/// The picture that these rows draw: '#' is 200, '+' is 100, everything else is dark.
DotList dots_of(const std::vector<std::string>& rows, const BlobOptions& options) {
  std::vector<std::uint8_t> pixels;
  for (const std::string& row : rows)
    for (const char c : row)
      pixels.push_back(c == '#'   ? std::uint8_t{200}
                       : c == '+' ? std::uint8_t{100}
                                  : std::uint8_t{0});
  const int width_px = static_cast<int>(rows[0].size());
  return detect_blobs({pixels.data(), width_px, static_cast<int>(rows.size()), width_px}, options);
}

const BlobOptions kAnyArea{.threshold = 64, .min_area_px = 1, .max_area_px = 2000, .max_dots = 16};

TEST(Blobs, CountPixelsFromTheCentreOfTheUpperLeftOne) {
  EXPECT_EQ(dots_of({"....", ".#..", "....", "...."}, kAnyArea)[0], (Dot{1, 1, 1}));
}

TEST(Blobs, WeighPixelsByTheirValueAboveTheThreshold) {
  const DotList dots = dots_of({"....", ".#+.", "....", "...."}, kAnyArea);
  EXPECT_DOUBLE_EQ(dots[0].x_px, (136.0 * 1 + 36.0 * 2) / (136 + 36));
  EXPECT_DOUBLE_EQ(dots[0].y_px, 1);
}

TEST(Blobs, AreJoinedByCornersAndByLaterRows) {
  EXPECT_THAT(dots_of({".......", ".#...#.", "..#.#..", "...#...", "......."}, kAnyArea),
              SizeIs(1));
  EXPECT_THAT(dots_of({".......", ".#.#.#.", ".#.#.#.", ".#####.", "......."}, kAnyArea),
              SizeIs(1));
  EXPECT_THAT(dots_of({".......", ".##.##.", ".......", ".##.##.", "......."}, kAnyArea),
              SizeIs(4));
}

TEST(Blobs, ThatAPixelMustExceedTheThresholdToBelongTo) {
  EXPECT_THAT(dots_of({"...", ".+.", "..."}, {.threshold = 99, .min_area_px = 1}), SizeIs(1));
  EXPECT_THAT(dots_of({"...", ".+.", "..."}, {.threshold = 100, .min_area_px = 1}), SizeIs(0));
}

TEST(Blobs, OfTooFewOrTooManyPixelsAreNoDots) {
  const std::vector<std::string> rows = {"..........", ".#.##.###.", "..........", ".........."};
  const DotList dots = dots_of(rows, {.threshold = 64, .min_area_px = 2, .max_area_px = 2});
  ASSERT_THAT(dots, SizeIs(1));
  EXPECT_EQ(dots[0], (Dot{3.5, 1, 2}));
}

TEST(Blobs, CutByThePicturesEdgeAreNoDots) {
  EXPECT_THAT(dots_of({"#....", "....#", ".....", "..#.."}, kAnyArea), SizeIs(0));
}

TEST(Blobs, AreBrightestFirstAndOfEqualsTheUpperThenTheLeftOne) {
  const DotList dots =
      dots_of({"........", ".+...+..", "........", "..#.....", "........"}, kAnyArea);
  ASSERT_THAT(dots, SizeIs(3));
  EXPECT_EQ(dots[0], (Dot{2, 3, 1}));
  EXPECT_EQ(dots[1], (Dot{1, 1, 1}));
  EXPECT_EQ(dots[2], (Dot{5, 1, 1}));
}

TEST(Blobs, BeyondTheLimitLoseTheDarkest) {
  IrPicture picture(400, 60);
  for (int i = 0; i < 20; ++i) picture.add({15.0 + 18 * i, 30, 1.5, 100.0 + 5 * i});
  const DotList all = picture.dots(), three = picture.dots({.max_dots = 3});
  ASSERT_THAT(all, SizeIs(16));
  ASSERT_THAT(three, SizeIs(3));
  EXPECT_NEAR(all[15].x_px, 15 + 18 * 4, 0.1);
  EXPECT_NEAR(three[2].x_px, 15 + 18 * 17, 0.1);
}

TEST(Blobs, OfNoPictureAndOfAllWhiteAreNone) {
  EXPECT_THAT(detect_blobs({}, {}), SizeIs(0));
  EXPECT_THAT(IrPicture(100, 50, 255).dots(), SizeIs(0));
}

TEST(Blobs, AreFoundInAPartOfALargerPicture) {
  const auto pixels = IrPicture(64, 48).add({30, 20, 1.5, 200}).bytes();
  const GreyView part{&pixels[10 * 64 + 20], 24, 24, 64};
  const DotList dots = detect_blobs(part, {});
  ASSERT_THAT(dots, SizeIs(1));
  EXPECT_NEAR(dots[0].x_px, 10, 0.02);
  EXPECT_NEAR(dots[0].y_px, 10, 0.02);
}

// An independent labelling: OpenCV's, with the same rules applied to its table.
TEST(Blobs, OfNoiseAreThoseOfOpenCv) {
  constexpr int kLeastArea_px = 30;
  std::size_t compared = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const auto pixels = IrPicture(97, 61, 40 + seed % 30).add_noise(15, seed).bytes();
    const cv::Mat picture(61, 97, CV_8U, const_cast<std::uint8_t*>(pixels.data()));
    cv::Mat labels, table, centres;
    const int count =
        cv::connectedComponentsWithStats(picture > 64, labels, table, centres, 8, CV_32S);
    std::vector<int> expected, found;
    for (int i = 1; i < count; ++i) {
      const int x = table.at<int>(i, cv::CC_STAT_LEFT), y = table.at<int>(i, cv::CC_STAT_TOP);
      const bool cut = x == 0 || y == 0 || x + table.at<int>(i, cv::CC_STAT_WIDTH) == 97 ||
                       y + table.at<int>(i, cv::CC_STAT_HEIGHT) == 61;
      if (const int area = table.at<int>(i, cv::CC_STAT_AREA); !cut && area >= kLeastArea_px)
        expected.push_back(area);
    }
    for (const Dot& dot : detect_blobs({pixels.data(), 97, 61, 97}, {.min_area_px = kLeastArea_px}))
      found.push_back(dot.size);
    ASSERT_LE(expected.size(), 16u);
    EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(expected));
    compared += found.size();
  }
  EXPECT_GT(compared, 50u);
}

/// Errors of one kind of spot over all places within a pixel.
struct Errors {
  double rms_px = 0;
  double bias_px = 0;     ///< the larger mean of both axes
  double locking_px = 0;  ///< the largest mean error at one tenth of a pixel
  int lost = 0;
};

Errors errors_of(double sigma_px, double peak, double noise, const BlobOptions& options) {
  constexpr int kPlaces = 10, kRepeats = 40;
  double squares = 0, mean_x = 0, mean_y = 0;
  Errors errors;
  for (int i = 0; i < kPlaces; ++i) {
    double mean_here = 0;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      const unsigned seed = static_cast<unsigned>(i * kRepeats + repeat);
      const Spot spot{24 + 0.1 * i, 20 + std::fmod(0.37 * seed, 1.0), sigma_px, peak};
      const DotList dots = IrPicture(48, 40).add(spot).add_noise(noise, seed).dots(options);
      if (dots.size() != 1) {
        ++errors.lost;
        continue;
      }
      const double dx = dots[0].x_px - spot.x_px, dy = dots[0].y_px - spot.y_px;
      squares += dx * dx + dy * dy;
      mean_x += dx / (kPlaces * kRepeats);
      mean_y += dy / (kPlaces * kRepeats);
      mean_here += dx / kRepeats;
    }
    errors.locking_px = std::max(errors.locking_px, std::abs(mean_here));
  }
  errors.rms_px = std::sqrt(squares / (2 * kPlaces * kRepeats));
  errors.bias_px = std::max(std::abs(mean_x), std::abs(mean_y));
  return errors;
}

struct Accuracy {
  double peak;
  double noise;
  double largest_rms_px;
};
class BlobAccuracy : public ::testing::TestWithParam<Accuracy> {};

// Peak and noise in grey values; a peak of 600 saturates all but the rim.
TEST_P(BlobAccuracy, IsAFewHundredthsOfAPixelWithoutBias) {
  for (const double sigma_px : {1.2, 1.5, 2.0, 3.0}) {
    const Errors errors = errors_of(sigma_px, GetParam().peak, GetParam().noise, {});
    std::printf("peak %.0f noise %.0f sigma %.1f px: rms %.4f px, bias %.4f, locking %.4f\n",
                GetParam().peak, GetParam().noise, sigma_px, errors.rms_px, errors.bias_px,
                errors.locking_px);
    EXPECT_EQ(errors.lost, 0);
    EXPECT_LT(errors.rms_px, GetParam().largest_rms_px) << sigma_px;
    EXPECT_LT(errors.bias_px, 0.006) << sigma_px;
    EXPECT_LT(errors.locking_px, 0.04) << sigma_px;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, BlobAccuracy,
                         ::testing::Values(Accuracy{180, 0, 0.03}, Accuracy{180, 3, 0.05},
                                           Accuracy{120, 3, 0.05}, Accuracy{240, 3, 0.05},
                                           Accuracy{600, 3, 0.05}),
                         [](const auto& param) {
                           return "Peak" + std::to_string(static_cast<int>(param.param.peak)) +
                                  "Noise" + std::to_string(static_cast<int>(param.param.noise));
                         });

}  // namespace
}  // namespace vindu
