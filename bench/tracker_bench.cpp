// What the tracker costs: parsing one report, and one poll of the thesis' method (two reports in,
// pose out) beside OpenCV's own calls for the same dots, undistortPoints and triangulatePoints. The
// ratio to OpenCV is a counter of the same run, in which both take turns; what both found is
// compared and shown.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <ctime>
#include <opencv2/calib3d.hpp>

#include "simulator/emulated_room.h"
#include "simulator/single_frame.h"
#include "simulator/trial.h"
#include "tracker/tracker.h"
#include "tracker/wiimote/emulator.h"
#include "tracker/wiimote/report.h"

namespace vindu {
namespace {

using Stopwatch = std::chrono::steady_clock;

/// Two cameras of the thesis' wall, one head between them, and the reports of both.
struct Scene {
  Site site = read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml");
  Rigid3 room_from_head{Quat::Identity(), {0.1, 1.75, 2.1}};
  std::array<Observation, 2> seen;
  std::array<std::array<std::uint8_t, 18>, 2> reports;

  explicit Scene(bool distorted) {
    for (std::size_t i = 0; i < 2; ++i) {
      CameraConfig& camera = site.cameras[i];
      if (distorted) camera.intrinsics.distortion = {0.03, -0.02, 0.001, 0.001, 0};
      EmulatedSensor sensor(camera, site.heads.front(), 0.3, i);
      reports[i] = encode_report_0x33(sensor.look(room_from_head));
      seen[i] = {static_cast<int>(i), Time{},
                 dots_of(*std::get<DataReport>(*parse_report(reports[i]).report).slots)};
    }
  }
};

/// The same by OpenCV: dots sorted, undistorted, triangulated by its linear least squares.
class OpenCvReference {
 public:
  explicit OpenCvReference(const Scene& scene) {
    for (std::size_t i = 0; i < 2; ++i) {
      const CameraConfig& camera = scene.site.cameras[i];
      const Intrinsics& k = camera.intrinsics;
      matrix_[i] = {k.fx_px, 0, k.cx_px, 0, k.fy_px, k.cy_px, 0, 0, 1};
      for (int j = 0; j < 5; ++j) distortion_[i](j) = k.distortion[static_cast<std::size_t>(j)];
      const Mat4 camera_from_room = matrix_of(inverse(camera.room_from_camera));
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
          projection_[i](row, column) = camera_from_room(row, column);
    }
  }

  std::array<Vec3, 3> triangulate(const std::array<Observation, 2>& seen) const {
    std::array<cv::Mat, 2> straight;
    for (std::size_t i = 0; i < 2; ++i) {
      DotList dots = seen[i].dots;
      std::ranges::sort(dots, {}, &Dot::x_px);
      std::array<cv::Vec2d, 3> image;
      for (std::size_t j = 0; j < 3; ++j)
        image[j] = {dots[j].x_px, kWiimoteHeight_px - 1 - dots[j].y_px};
      const cv::Mat points(3, 1, CV_64FC2, image.data());
      cv::undistortPoints(points, straight[i], matrix_[i], distortion_[i]);
    }
    cv::Mat homogeneous;
    cv::triangulatePoints(projection_[0], projection_[1], straight[0], straight[1], homogeneous);
    std::array<Vec3, 3> found;
    for (int j = 0; j < 3; ++j) {
      const Vec4 x(homogeneous.at<double>(0, j), homogeneous.at<double>(1, j),
                   homogeneous.at<double>(2, j), homogeneous.at<double>(3, j));
      found[static_cast<std::size_t>(j)] = x.head<3>() / x.w();
    }
    return found;
  }

 private:
  std::array<cv::Matx33d, 2> matrix_;
  std::array<cv::Matx<double, 5, 1>, 2> distortion_;
  std::array<cv::Matx34d, 2> projection_;
};

ThesisResult poll(ThesisMethod& method, const Scene& scene) {
  for (const Observation& observation : scene.seen) method.absorb(observation);
  return method.track(Time{});
}

void parse_one_report(benchmark::State& state) {
  const Scene scene(false);
  for (auto _ : state) benchmark::DoNotOptimize(parse_report(scene.reports[0]));
}
BENCHMARK(parse_one_report);

void thesis_poll(benchmark::State& state) {
  const Scene scene(state.range(0) == 1);
  ThesisMethod method(scene.site.cameras, scene.site.heads.front());
  for (auto _ : state) benchmark::DoNotOptimize(poll(method, scene));
}
BENCHMARK(thesis_poll)->ArgName("distorted")->Arg(0)->Arg(1);

void opencv_undistort_and_triangulate(benchmark::State& state) {
  const Scene scene(state.range(0) == 1);
  const OpenCvReference reference(scene);
  for (auto _ : state) benchmark::DoNotOptimize(reference.triangulate(scene.seen));
}
BENCHMARK(opencv_undistort_and_triangulate)->ArgName("distorted")->Arg(0)->Arg(1);

void thesis_poll_over_opencv(benchmark::State& state) {
  const Scene scene(state.range(0) == 1);
  ThesisMethod method(scene.site.cameras, scene.site.heads.front());
  const OpenCvReference reference(scene);
  Duration ours{}, theirs{};
  for (auto _ : state) {
    const auto start = Stopwatch::now();
    benchmark::DoNotOptimize(poll(method, scene));
    const auto middle = Stopwatch::now();
    benchmark::DoNotOptimize(reference.triangulate(scene.seen));
    theirs += Stopwatch::now() - middle;
    ours += middle - start;
  }
  const ThesisResult found = poll(method, scene);
  const auto expected = reference.triangulate(scene.seen);
  if (!found.pose) return state.SkipWithError("no pose");
  double apart_m = 0;
  for (std::size_t i = 0; i < 3; ++i)
    apart_m = std::max(apart_m, (found.points[i].x_in_room - expected[i]).norm());
  if (apart_m > 0.001) return state.SkipWithError("the points differ");
  const Vec3 middle_mm = 1e3 * found.pose->room_from_head.translation;
  std::array<char, 96> label{};
  std::snprintf(label.data(), label.size(), "m at (%.1f, %.1f, %.1f) mm, OpenCV's %.2f mm away",
                middle_mm.x(), middle_mm.y(), middle_mm.z(), 1e3 * apart_m);
  state.SetLabel(label.data());
  state.counters["ratio"] = seconds(ours) / seconds(theirs);
}
BENCHMARK(thesis_poll_over_opencv)->ArgName("distorted")->Arg(0)->Arg(1);

/// Four LEDs that sway 3 m before cameras behind them, on the radio link of thesis Table 5.1.
TrialOptions swaying_head(int cameras) {
  TrialOptions options;
  options.cameras = cameras_of({.cameras = cameras});
  options.head = four_led_head();
  options.room_from_head = swaying({0, 1.65, 2}, 0.57, radians(75));
  options.wiimote.link = two_on_one_adapter();
  options.length = std::chrono::seconds(20);
  return options;
}

/// Of this thread: what other work on the machine takes does not count.
double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Costs {
  std::vector<double> us_per_report;  // of each tick
  double total_s = 0;
  std::size_t reports = 0;
  Vec3 eye_in_room = Vec3::Zero();  // in the end
};

/// Frames at 60 Hz: what each costs, over the reports that came since the last one.
Costs track_all(Tracker& tracker, const std::vector<Observation>& seen, const Vec3& eye_in_head) {
  Costs costs;
  std::size_t next = 0;
  for (int tick = 1; next < seen.size(); ++tick) {
    const Time now{from_seconds(tick / 60.0)};
    const std::size_t first = next;
    const auto start = Stopwatch::now();
    const double start_s = cpu_s();
    for (; next < seen.size() && seen[next].arrival <= now; ++next) tracker.absorb(seen[next]);
    const auto pose = tracker.track(now, now + std::chrono::milliseconds(30));
    const double took_s = cpu_s() - start_s;
    if (pose) costs.eye_in_room = pose->room_from_head * eye_in_head;
    costs.total_s += seconds(Stopwatch::now() - start);
    if (next > first)
      costs.us_per_report.push_back(1e6 * took_s / static_cast<double>(next - first));
  }
  costs.reports = seen.size();
  return costs;
}

/// The same run again: each tick counts as the least that it took, since all else was the
/// machine's.
void keep_least(Costs& least, const Costs& again) {
  if (least.us_per_report.empty()) least = again;
  assert(again.us_per_report.size() == least.us_per_report.size());
  for (std::size_t i = 0; i < again.us_per_report.size(); ++i)
    least.us_per_report[i] = std::min(least.us_per_report[i], again.us_per_report[i]);
  least.total_s = std::min(least.total_s, again.total_s);
}

double p99_of(std::vector<double> costs) {
  std::ranges::sort(costs);
  return costs[static_cast<std::size_t>(0.99 * static_cast<double>(costs.size() - 1))];
}

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Rollback, the search for the head at the start and its checks included. The thesis' method on
/// the same reports beside it: it looks at two cameras' newest reports alone, and finds nobody
/// among four dots.
void joint_method_per_report(benchmark::State& state) {
  const TrialOptions options = swaying_head(static_cast<int>(state.range(0)));
  const auto seen = observations_of(options);
  HeadConfig lmr;
  Costs ours, theirs;
  std::vector<double> p99_of_runs;
  for (auto _ : state) {
    Tracker tracker(options.cameras, std::vector{options.head}, {});
    const Costs run = track_all(tracker, seen, options.head.eye_in_head);
    state.PauseTiming();
    p99_of_runs.push_back(p99_of(run.us_per_report));
    keep_least(ours, run);
    Tracker thesis(options.cameras, std::vector{lmr}, {}, {.method = "thesis"});
    keep_least(theirs, track_all(thesis, seen, options.head.eye_in_head));
    state.ResumeTiming();
  }
  const double mean_us = 1e6 * ours.total_s / static_cast<double>(ours.reports);
  state.counters["us_mean"] = mean_us;
  state.counters["us_p99"] = median_of(p99_of_runs);
  state.counters["us_p99_of_least"] = p99_of(ours.us_per_report);
  state.counters["thesis_us"] = 1e6 * theirs.total_s / static_cast<double>(theirs.reports);
  state.counters["cores_at_200Hz"] = 1e-6 * mean_us * 200 * static_cast<double>(state.range(0));
  const Vec3 eye_mm = 1e3 * ours.eye_in_room;
  std::array<char, 64> label{};
  std::snprintf(label.data(), label.size(), "eye at (%.1f, %.1f, %.1f) mm", eye_mm.x(), eye_mm.y(),
                eye_mm.z());
  state.SetLabel(label.data());
}
BENCHMARK(joint_method_per_report)->ArgName("cameras")->Arg(2)->Arg(4)->Arg(16)->Iterations(7);

/// What a frame pays while somebody is looked for in vain: the cameras see a helmet of which the
/// wall file knows nothing. Beside it, the 16.7 ms that a frame has.
void joint_method_frame_of_one_who_is_lost(benchmark::State& state) {
  const TrialOptions options = swaying_head(static_cast<int>(state.range(0)));
  const auto seen = observations_of(options);
  HeadConfig lost;
  lost.leds_in_head = {{-0.12, 0, -0.05}, {0, 0.06, 0}, {0.07, 0, -0.09}, {-0.02, -0.05, -0.03}};
  std::vector<double> us_per_frame;
  for (auto _ : state) {
    Tracker tracker(options.cameras, std::vector{lost}, {});
    us_per_frame.clear();
    std::size_t next = 0;
    for (int tick = 1; next < seen.size(); ++tick) {
      const Time now{from_seconds(tick / 60.0)};
      const double start_s = cpu_s();
      for (; next < seen.size() && seen[next].arrival <= now; ++next) tracker.absorb(seen[next]);
      tracker.track(now, now);
      us_per_frame.push_back(1e6 * (cpu_s() - start_s));
    }
  }
  std::ranges::sort(us_per_frame);
  const auto last = static_cast<double>(us_per_frame.size() - 1);
  state.counters["us_p99"] = us_per_frame[static_cast<std::size_t>(0.99 * last)];
  state.counters["us_worst"] = us_per_frame.back();
  state.counters["of_a_frame"] = us_per_frame.back() * 60e-6;
}
BENCHMARK(joint_method_frame_of_one_who_is_lost)->ArgName("cameras")->Arg(2)->Arg(4)->Iterations(1);

}  // namespace
}  // namespace vindu
