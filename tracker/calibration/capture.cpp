#include "tracker/calibration/capture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/log.h"
#include "tracker/camera_model.h"
#include "tracker/joint/capture_clock.h"
#include "tracker/recording_devices.h"
#include "tracker/wiimote/reader.h"

namespace vindu {
namespace {

constexpr double kCell_px = 4;
constexpr double kStaticShare = 0.3;

/// WiiBrew's typical values, for a unit whose own are not in the recording.
constexpr AccelerationCalibration kUsualCalibration{{0x200, 0x200, 0x200}, {0x268, 0x268, 0x268}};

struct Contents {
  std::vector<RecordedDevice> devices;
  Time first = Time::max(), last{};
};

Contents contents_of(const std::string& recording) {
  RecordingReader reader(recording, DamagePolicy::skip);
  Contents contents;
  while (const auto report = reader.next()) {
    contents.first = std::min(contents.first, report->arrival);
    contents.last = std::max(contents.last, report->arrival);
  }
  contents.devices = reader.info().devices;
  for (const std::string& remark : reader.problems().remarks) log_warning("recording", remark);
  if (contents.first > contents.last)
    throw Error(
        {"holds no reports", recording, "look whether the cameras are on, and record again"});
  return contents;
}

std::optional<std::size_t> camera_of(const RecordedDevice& device, const Site& site) {
  const auto camera = std::ranges::find(site.cameras, device.name, &CameraConfig::name);
  if (camera != site.cameras.end()) return static_cast<std::size_t>(camera - site.cameras.begin());
  const auto index = static_cast<std::size_t>(device.index);
  if (!device.name.empty() || index >= site.cameras.size()) return std::nullopt;
  return index;
}

void read_device(std::unique_ptr<HidDevice> device, const Contents& contents, std::size_t camera,
                 Capture& capture) {
  WiimoteReader reader(std::move(device), static_cast<int>(camera));
  std::vector<std::array<int, 3>> raw;
  for (const Time until : {contents.first, contents.last})
    while (const auto sample = reader.next_sample(until)) {
      if (sample->data.acceleration_raw) raw.push_back(*sample->data.acceleration_raw);
      if (const auto observation = reader.observation_of(*sample))
        capture.observations.push_back(*observation);
    }
  const auto calibration = reader.session().health().calibration.value_or(kUsualCalibration);
  std::vector<Vec3> readings_g;
  for (const auto& counts : raw) {
    const auto g = acceleration_g(counts, calibration);
    readings_g.emplace_back(g[0], g[1], g[2]);
  }
  capture.up_in_camera[camera] = up_in_camera(readings_g);
}

using Cell = std::pair<int, int>;

Cell cell_of(const Vec2& dot_px) {
  return {static_cast<int>(std::floor(dot_px.x() / kCell_px)),
          static_cast<int>(std::floor(dot_px.y() / kCell_px))};
}

/// A dot that stands on the edge of cells lights up to four of them.
bool is_static(const std::map<Cell, int>& lit, const Vec2& dot_px, double limit) {
  const auto [x, y] = cell_of(dot_px);
  int count = 0;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      if (const auto cell = lit.find({x + dx, y + dy}); cell != lit.end()) count += cell->second;
  return count > limit;
}

void drop_static_dots(CameraTrack& track) {
  std::map<Cell, int> lit;
  for (const CameraTrack::Picture& picture : track.pictures)
    for (const Vec2& dot : picture.dots_px) ++lit[cell_of(dot)];
  const double limit = kStaticShare * static_cast<double>(track.pictures.size());
  for (CameraTrack::Picture& picture : track.pictures)
    std::erase_if(picture.dots_px, [&](const Vec2& dot) { return is_static(lit, dot, limit); });
}

/// Scatter of times about a straight line through 21 of them, the median over the capture.
double jitter_of(const std::vector<double>& times_s) {
  constexpr std::size_t kWindow = 21;
  std::vector<double> scatter_s;
  for (std::size_t begin = 0; begin + kWindow <= times_s.size(); begin += kWindow) {
    double sum_kk = 0, sum_kt = 0, mean_s = 0, sum_tt = 0;
    for (std::size_t i = 0; i < kWindow; ++i) mean_s += times_s[begin + i] / kWindow;
    for (std::size_t i = 0; i < kWindow; ++i) {
      const double k = static_cast<double>(i) - 10, t_s = times_s[begin + i] - mean_s;
      sum_kk += k * k, sum_kt += k * t_s, sum_tt += t_s * t_s;
    }
    scatter_s.push_back(std::sqrt(std::max(0.0, sum_tt - sum_kt * sum_kt / sum_kk) / kWindow));
  }
  if (scatter_s.empty()) return 0;
  const auto middle = scatter_s.begin() + static_cast<std::ptrdiff_t>(scatter_s.size() / 2);
  std::ranges::nth_element(scatter_s, middle);
  return *middle;
}

/// Whether a device's reports come in bursts: more of them wait for the radio than a clock that
/// lost count now and then makes it seem.
bool in_bursts(const std::vector<Time>& arrivals, const std::vector<CaptureTime>& captured) {
  constexpr double kWaited_s = 1.5e-3, kShare = 0.1;
  std::size_t waited = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i)
    if (seconds(arrivals[i] - captured[i].time) > kWaited_s) ++waited;
  return static_cast<double>(waited) > kShare * static_cast<double>(arrivals.size());
}

/// When each of one camera's observations was captured, later by its lag, and how uncertain that
/// is. Where reports come at once, or their clock is not known, it is the arrival.
std::vector<CaptureTime> capture_times(const std::vector<Time>& arrivals, CameraSource source) {
  std::vector<double> arrivals_s;
  for (const Time arrival : arrivals) arrivals_s.push_back(seconds(arrival.time_since_epoch()));
  const Duration jitter = from_seconds(jitter_of(arrivals_s));
  CaptureClock clock(Duration::zero());
  std::vector<CaptureTime> as_arrived, captured;
  for (const Time arrival : arrivals) {
    as_arrived.push_back({arrival, jitter});
    captured.push_back(clock.capture_of(arrival));
  }
  const bool clock_helps = source != CameraSource::video && in_bursts(arrivals, captured);
  return clock_helps ? captured : as_arrived;
}

CameraTrack track_of(const Capture& capture, int camera, CameraSource source) {
  std::vector<Time> arrivals;
  for (const Observation& seen : capture.observations)
    if (seen.camera == camera) arrivals.push_back(seen.arrival);
  const auto times = capture_times(arrivals, source);
  CameraTrack track;
  for (const Observation& seen : capture.observations) {
    if (seen.camera != camera) continue;
    const CaptureTime& time = times[track.pictures.size()];
    CameraTrack::Picture picture{seconds(time.time.time_since_epoch()), seconds(time.sigma), {}};
    for (const Dot& dot : seen.dots)
      picture.dots_px.push_back(image_from_raw(source, {dot.x_px, dot.y_px}));
    track.pictures.push_back(std::move(picture));
  }
  std::ranges::stable_sort(track.pictures, {}, &CameraTrack::Picture::t_s);
  return track;
}

}  // namespace

std::optional<Vec3> up_in_camera(const std::vector<Vec3>& readings_g) {
  if (readings_g.empty()) return std::nullopt;
  Vec3 mean_g = Vec3::Zero();
  for (const Vec3& reading : readings_g) mean_g += reading / static_cast<double>(readings_g.size());
  if (std::abs(mean_g.norm() - 1) > 0.1) return std::nullopt;
  const bool rested = std::ranges::all_of(
      readings_g, [&](const Vec3& reading) { return (reading - mean_g).norm() < 0.15; });
  if (!rested) return std::nullopt;
  return Vec3(-mean_g.x(), -mean_g.z(), -mean_g.y()).normalized();
}

Capture read_capture(const std::string& recording, const Site& site) {
  Capture capture;
  capture.up_in_camera.resize(site.cameras.size());
  const Contents contents = contents_of(recording);
  bool known = false;
  for (const RecordedDevice& device : contents.devices) {
    const auto camera = camera_of(device, site);
    if (!camera) continue;
    known = true;
    ManualClock clock;
    read_device(std::make_unique<ReplayHidDevice>(recording, device.index, clock,
                                                  ReplayOptions{{}, DamagePolicy::skip}),
                contents, *camera, capture);
  }
  if (!known)
    throw Error({"none of its devices is a camera of the wall file", recording,
                 "give the wall file that it was recorded with: --wall FILE"});
  return capture;
}

std::vector<CameraTrack> moving_dots(const Capture& capture,
                                     const std::vector<CameraConfig>& cameras) {
  std::vector<CameraTrack> tracks;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    tracks.push_back(track_of(capture, static_cast<int>(i), cameras[i].source));
    drop_static_dots(tracks.back());
  }
  return tracks;
}

}  // namespace vindu
