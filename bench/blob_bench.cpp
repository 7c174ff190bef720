// What finding the dots of a picture costs, beside OpenCV's ways to do the same:
// SimpleBlobDetector, and connectedComponentsWithStats with our centroids on its boxes. The ratios
// are counters of the same run, in which all take turns; how far each one's dots lie from the truth
// is shown. The picture that was timed is kept as out/blob_bench_WIDTH.png.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tracker/ir_camera/blobs.h"

namespace vindu {
namespace {

using Points = std::vector<cv::Point2d>;
using Stopwatch = std::chrono::steady_clock;

/// Eight LEDs on a noisy dark ground, as an infrared camera with a filter sees them.
struct Picture {
  cv::Mat grey;
  Points truth;

  Picture(int width_px, int height_px) {
    cv::Mat light(height_px, width_px, CV_32F, cv::Scalar(10));
    std::mt19937 random(52);
    std::normal_distribution<float> noise(0, 3);
    for (int i = 0; i < 8; ++i) {
      truth.emplace_back(width_px * (0.1 + 0.11 * i) + 0.31 * i, height_px * (0.2 + 0.07 * i));
      for (int y = -12; y <= 12; ++y)
        for (int x = -12; x <= 12; ++x) {
          const cv::Point at(cvRound(truth[static_cast<std::size_t>(i)].x) + x,
                             cvRound(truth[static_cast<std::size_t>(i)].y) + y);
          const cv::Point2d d = cv::Point2d(at) - truth[static_cast<std::size_t>(i)];
          light.at<float>(at) += static_cast<float>(200 * std::exp(-d.dot(d) / (2 * 1.8 * 1.8)));
        }
    }
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x) light.at<float>(y, x) += noise(random);
    light.convertTo(grey, CV_8U);
    std::filesystem::create_directories("out");
    cv::imwrite("out/blob_bench_" + std::to_string(width_px) + ".png", grey);
  }
};

Points ours(const cv::Mat& grey) {
  Points points;
  for (const Dot& dot : detect_blobs({grey.data, grey.cols, grey.rows, grey.cols}, {}))
    points.emplace_back(dot.x_px, dot.y_px);
  return points;
}

Points simple_blob_detector(const cv::Mat& grey) {
  cv::SimpleBlobDetector::Params params;
  params.minThreshold = 64;
  params.maxThreshold = 65;
  params.thresholdStep = 1;
  params.minRepeatability = 1;
  params.blobColor = 255;
  params.minArea = 3;
  params.maxArea = 2000;
  params.filterByCircularity = params.filterByConvexity = params.filterByInertia = false;
  std::vector<cv::KeyPoint> keys;
  cv::SimpleBlobDetector::create(params)->detect(grey, keys);
  Points points;
  for (const cv::KeyPoint& key : keys) points.emplace_back(key.pt);
  return points;
}

Points connected_components(const cv::Mat& grey) {
  cv::Mat mask, labels, table, centres;
  cv::threshold(grey, mask, 64, 255, cv::THRESH_BINARY);
  const int count = cv::connectedComponentsWithStats(mask, labels, table, centres, 8, CV_32S);
  Points points;
  for (int i = 1; i < count; ++i) {
    const int* row = table.ptr<int>(i);
    if (row[cv::CC_STAT_AREA] < 3 || row[cv::CC_STAT_AREA] > 2000) continue;
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                       row[cv::CC_STAT_HEIGHT]);
    cv::Mat weights;
    cv::subtract(grey(box), 64, weights, labels(box) == i);
    const cv::Moments moments = cv::moments(weights);
    points.emplace_back(box.x + moments.m10 / moments.m00, box.y + moments.m01 / moments.m00);
  }
  return points;
}

/// Root mean square distance from the truth; 99 when the number of dots differs.
double error_px(const Points& found, const Points& truth) {
  if (found.size() != truth.size()) return 99;
  double sum2 = 0;
  for (const cv::Point2d& point : truth) {
    double nearest2 = 1e9;
    for (const cv::Point2d& other : found)
      nearest2 = std::min(nearest2, (other - point).dot(other - point));
    sum2 += nearest2;
  }
  return std::sqrt(sum2 / static_cast<double>(truth.size()));
}

void detect_blobs_over_opencv(benchmark::State& state) {
  const Picture picture(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  constexpr std::array kWays = {ours, simple_blob_detector, connected_components};
  std::array<double, 3> spent_s{}, errors_px{};
  cv::setNumThreads(1);
  for (std::size_t way = 0; way < 3; ++way)
    errors_px[way] = error_px(kWays[way](picture.grey), picture.truth);
  if (!(errors_px[0] < 0.1)) return state.SkipWithError("the dots are not where they should be");
  for (auto _ : state)
    for (std::size_t way = 0; way < 3; ++way) {
      const auto start = Stopwatch::now();
      benchmark::DoNotOptimize(kWays[way](picture.grey));
      spent_s[way] += std::chrono::duration<double>(Stopwatch::now() - start).count();
    }
  state.counters["ours_us"] = 1e6 * spent_s[0] / static_cast<double>(state.iterations());
  state.counters["of_simple_blob"] = spent_s[0] / spent_s[1];
  state.counters["of_components"] = spent_s[0] / spent_s[2];
  std::array<char, 96> label{};
  std::snprintf(label.data(), label.size(),
                "error px: ours %.3f, simple blob %.3f, components %.3f", errors_px[0],
                errors_px[1], errors_px[2]);
  state.SetLabel(label.data());
}
BENCHMARK(detect_blobs_over_opencv)
    ->ArgNames({"width_px", "height_px"})
    ->Args({640, 480})
    ->Args({1280, 720})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vindu
