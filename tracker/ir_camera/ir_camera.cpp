#include "tracker/ir_camera/ir_camera.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "core/log.h"

namespace vindu {
namespace {

constexpr std::size_t kLongestQueue = 64;  // half a second and more of any camera

/// Reads in its own thread; the frame loop only takes what is in the queue.
class LiveCamera final : public IrCamera {
 public:
  LiveCamera(OpenVideo open, const CameraConfig& config, int camera, Duration retry)
      : open_(std::move(open)),
        name_(config.name),
        blobs_(config.video.blobs),
        camera_(camera),
        retry_(retry),
        input_(open_()),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  std::optional<Observation> next(Time until) override {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [this] { return !queue_.empty() || gone_; });
    if (queue_.empty() || queue_.front().arrival > until) return std::nullopt;
    const Observation observation = queue_.front();
    queue_.pop_front();
    return observation;
  }

  bool gone() const override {
    const std::lock_guard lock(mutex_);
    return gone_;
  }

  IrCameraCounts counts() const override {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (!input_) {
        reopen(stop);
        continue;
      }
      const VideoRead read = input_->read();
      if (read.status == VideoStatus::picture) absorb(read);
      if (read.status == VideoStatus::ended) lose();
    }
  }

  void absorb(const VideoRead& read) {
    const Time arrival = std::chrono::steady_clock::now();
    const std::optional<Time> stamped = driver_time(read.stamp, arrival);
    const Observation seen{camera_, stamped.value_or(arrival), detect_blobs(read.picture, blobs_)};
    if (counts_.pictures == 0) say_clock(stamped.has_value());
    {
      const std::lock_guard lock(mutex_);
      ++counts_.pictures;
      if (stamped) ++counts_.stamped;
      if (queue_.size() == kLongestQueue) {
        queue_.pop_front();
        ++counts_.discarded;
      }
      queue_.push_back(seen);
    }
    changed_.notify_one();
  }

  void say_clock(bool of_driver) const {
    log_info(name_, of_driver ? "pictures have the times that the driver gives them"
                              : "the driver gives no times: pictures have those of their arrival");
  }

  void lose() {
    input_.reset();
    {
      const std::lock_guard lock(mutex_);
      gone_ = true;
    }
    changed_.notify_one();
    log_warning(name_, "the camera is gone; trying to open it again each second");
  }

  // The first try comes after a pause: a device that was unplugged needs a moment.
  void reopen(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    pause_.wait_for(lock, stop, retry_, [] { return false; });
    if (stop.stop_requested()) return;
    lock.unlock();
    try {
      input_ = open_();
    } catch (const Error& error) {
      log_debug(name_, error.what());
      return;
    }
    lock.lock();
    gone_ = false;
    ++counts_.returns;
    log_info(name_, "the camera is back");
  }

  const OpenVideo open_;
  const std::string name_;
  const BlobOptions blobs_;
  const int camera_;
  const Duration retry_;
  std::unique_ptr<VideoInput> input_;  // the thread's, once that runs

  mutable std::mutex mutex_;
  std::condition_variable changed_;    // the queue or gone_
  std::condition_variable_any pause_;  // nobody notifies it; stopping ends it
  std::deque<Observation> queue_;
  bool gone_ = false;
  IrCameraCounts counts_;

  std::jthread thread_;  // last: stops before the rest goes
};

/// One picture is read ahead, since its time is known only then.
class FileCamera final : public IrCamera {
 public:
  FileCamera(std::unique_ptr<VideoInput> input, const CameraConfig& config, int camera,
             Clock& clock)
      : input_(std::move(input)),
        name_(config.name),
        blobs_(config.video.blobs),
        camera_(camera),
        clock_(clock),
        start_(clock.now()),
        last_arrival_(start_) {
    read_ahead();
  }

  std::optional<Observation> next(Time until) override {
    if (!ahead_) return std::nullopt;
    clock_.sleep_until(std::min(ahead_->arrival, until));
    if (ahead_->arrival > until) return std::nullopt;
    const std::optional<Observation> observation = ahead_;
    read_ahead();
    return observation;
  }

  bool gone() const override { return !ahead_; }
  IrCameraCounts counts() const override { return counts_; }

 private:
  void read_ahead() {
    ahead_.reset();
    const VideoRead read = input_->read();
    if (read.status != VideoStatus::picture) return log_info(name_, "the video has ended");
    ++counts_.pictures;
    if (read.stamp) ++counts_.stamped;
    // A broken file's times may run back; arrivals never do.
    last_arrival_ = std::max(last_arrival_, start_ + read.stamp.value_or(Duration{}));
    ahead_ = {camera_, last_arrival_, detect_blobs(read.picture, blobs_)};
  }

  std::unique_ptr<VideoInput> input_;
  std::string name_;
  BlobOptions blobs_;
  int camera_;
  Clock& clock_;
  Time start_;
  Time last_arrival_;
  std::optional<Observation> ahead_;
  IrCameraCounts counts_;
};

}  // namespace

std::optional<Time> driver_time(std::optional<Duration> stamp, Time arrival) {
  if (!stamp) return std::nullopt;
  const Time time(*stamp);
  if (time > arrival || arrival - time > std::chrono::seconds(1)) return std::nullopt;
  return time;
}

std::unique_ptr<IrCamera> make_live_camera(OpenVideo open, const CameraConfig& config, int camera,
                                           Duration retry) {
  return std::make_unique<LiveCamera>(std::move(open), config, camera, retry);
}

std::unique_ptr<IrCamera> make_ir_camera(const CameraConfig& config, int camera, Clock& clock) {
  auto open = [config] { return open_video(config.video, config.name); };
  if (config.video.file.empty()) return make_live_camera(open, config, camera);
  return std::make_unique<FileCamera>(open(), config, camera, clock);
}

}  // namespace vindu
