// The module vindu_video.so: cv::VideoCapture behind VideoInput. OpenCV's V4L2 backend gives the
// driver's time stamp as CAP_PROP_POS_MSEC, and its FFmpeg backend a frame's time in the file
// (modules/videoio/src/cap_v4l.cpp and cap_ffmpeg_impl.hpp of 4.6).
#include "tracker/ir_camera/video_module.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace vindu {
namespace {

/// The picture as 8-bit grey values; `grey` keeps them where they had to be made.
std::optional<GreyView> grey_view(const cv::Mat& picture, cv::Mat& grey) {
  if (picture.depth() != CV_8U || picture.empty()) return std::nullopt;
  if (picture.channels() == 1)
    grey = picture;
  else
    cv::cvtColor(picture, grey, picture.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return GreyView{grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])};
}

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

class Input : public VideoInput {
 public:
  explicit Input(const VideoConfig& config)
      : width_px_(config.width_px), height_px_(config.height_px) {}

  VideoRead read() noexcept override try {
    if (!wait()) return {};
    if (!capture_.read(picture_)) return {VideoStatus::ended, {}, {}};
    const auto view = grey_view(picture_, grey_);
    if (!view || view->width_px != width_px_ || view->height_px != height_px_)
      return {VideoStatus::ended, {}, {}};
    return {VideoStatus::picture, *view, stamp()};
  } catch (const std::exception&) {  // a device that fails while it is polled, a broken file
    return {VideoStatus::ended, {}, {}};
  }

  /// Empty, or what is wrong.
  std::string size_problem(const std::string& name) const {
    const int width_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
    const int height_px = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
    if (width_px == width_px_ && height_px == height_px_) return {};
    return name + " has pictures of " + size_text(width_px, height_px) + " pixels, not " +
           size_text(width_px_, height_px_) +
           "; write width_px and height_px, and the camera's figures, for that size";
  }

 protected:
  virtual bool wait() { return true; }
  virtual std::optional<Duration> stamp() = 0;

  cv::VideoCapture capture_;

 private:
  int width_px_, height_px_;
  cv::Mat picture_, grey_;
};

class Device final : public Input {
 public:
  using Input::Input;

  std::string open(const VideoConfig& config) {
    const std::string& name = config.device;
    if (!capture_.open(name, cv::CAP_V4L2))
      return name + " is no V4L2 camera, or another program holds it; close that program, or " +
             "name another node (`v4l2-ctl --list-devices`; a camera may have several)";
    capture_.set(cv::CAP_PROP_FRAME_WIDTH, config.width_px);
    capture_.set(cv::CAP_PROP_FRAME_HEIGHT, config.height_px);
    if (config.rate_hz) capture_.set(cv::CAP_PROP_FPS, *config.rate_hz);
    if (std::string problem = size_problem(name); !problem.empty()) return problem;
    constexpr int kManual = 1;  // V4L2_EXPOSURE_MANUAL
    if (config.exposure)        // a camera without automatic exposure refuses the first
      capture_.set(cv::CAP_PROP_AUTO_EXPOSURE, kManual);
    if (config.exposure && !capture_.set(cv::CAP_PROP_EXPOSURE, *config.exposure))
      return refused(name, "exposure", *config.exposure);
    if (config.gain && !capture_.set(cv::CAP_PROP_GAIN, *config.gain))
      return refused(name, "gain", *config.gain);
    if (!capture_.grab())  // also starts the stream, so that it can be polled
      return name + " delivers no pictures; unplug it and plug it in again";
    return {};
  }

 private:
  static std::string refused(const std::string& name, const std::string& field, int value) {
    return name + " does not take " + field + " = " + std::to_string(value) +
           "; leave it out, or see `v4l2-ctl -d " + name + " --list-ctrls` for what it takes";
  }

  // In short waits, so that who reads can be stopped; read() alone would sit for ten seconds.
  bool wait() override {
    const std::vector<cv::VideoCapture> streams{capture_};
    std::vector<int> ready;
    constexpr std::int64_t kTenth_ns = 100'000'000;
    return cv::VideoCapture::waitAny(streams, ready, kTenth_ns);
  }
  std::optional<Duration> stamp() override {
    return from_seconds(1e-3 * capture_.get(cv::CAP_PROP_POS_MSEC));
  }
};

class File final : public Input {
 public:
  explicit File(const VideoConfig& config) : Input(config), rate_hz_(config.rate_hz) {}

  std::string open(const VideoConfig& config) {
    const bool sequence = config.file.find('%') != std::string::npos;
    if (!capture_.open(config.file, sequence ? cv::CAP_IMAGES : cv::CAP_FFMPEG))
      return config.file + (sequence ? " names no pictures; give a pattern such as \"f-%04d.png\""
                                     : " is no video that FFmpeg reads; convert it, to MJPEG in "
                                       "AVI for example");
    if (sequence && !rate_hz_)
      return config.file + " is a sequence of pictures without times; write rate_hz";
    return size_problem(config.file);
  }

 private:
  std::optional<Duration> stamp() override {
    if (rate_hz_) return from_seconds(static_cast<double>(count_++) / *rate_hz_);
    const Duration time = from_seconds(1e-3 * capture_.get(cv::CAP_PROP_POS_MSEC));
    if (!first_) first_ = time;
    return time - *first_;
  }

  std::optional<double> rate_hz_;
  std::optional<Duration> first_;
  std::int64_t count_ = 0;
};

template <class Kind>
VideoInput* open_as(const VideoConfig& config, std::string& problem) {
  auto input = std::make_unique<Kind>(config);
  problem = input->open(config);
  return problem.empty() ? input.release() : nullptr;
}

}  // namespace
}  // namespace vindu

vindu::VideoInput* vindu_open_video(const vindu::VideoConfig& config, std::string& problem) noexcept
    try {
  using cv::utils::logging::setLogLevel;
  setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // what is wrong comes back as `problem`
  return config.file.empty() ? vindu::open_as<vindu::Device>(config, problem)
                             : vindu::open_as<vindu::File>(config, problem);
} catch (const std::exception& error) {
  problem = (config.file.empty() ? config.device : config.file) +
            " cannot be opened: " + error.what() + "; try another device or file";
  return nullptr;
}
