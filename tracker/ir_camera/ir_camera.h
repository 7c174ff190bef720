// Any infrared camera as a source of observations: pictures in, dots out. A camera is read by a
// thread of its own and comes back by itself when it was unplugged; a video file is read by who
// asks, at the times that its frames have.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/clock.h"
#include "core/site.h"
#include "tracker/ir_camera/video_input.h"
#include "tracker/observation_source.h"

namespace vindu {

struct IrCameraCounts {
  std::uint64_t pictures = 0;
  std::uint64_t stamped = 0;    ///< of them, those with a time of the driver or the file
  std::uint64_t discarded = 0;  ///< observations that nobody took in time
  std::uint64_t returns = 0;    ///< how often the camera came back
};

class IrCamera : public ObservationSource {
 public:
  virtual IrCameraCounts counts() const = 0;
};

/// The camera or file that `config.video` names. `camera` is the index in the site's list that the
/// observations carry. A file's first picture arrives when this is called. Throws Error where it
/// cannot be opened. The clock must outlive what it makes; a camera needs a monotonic one.
std::unique_ptr<IrCamera> make_ir_camera(const CameraConfig& config, int camera, Clock& clock);

using OpenVideo = std::function<std::unique_ptr<VideoInput>()>;

/// As make_ir_camera, for a live camera behind `open`, which throws Error while there is none: now
/// to the caller; later it is tried again after each `retry`, by the camera's thread.
std::unique_ptr<IrCamera> make_live_camera(OpenVideo open, const CameraConfig& config, int camera,
                                           Duration retry = std::chrono::seconds(1));

/// The time of a picture that the driver says was taken at `stamp` after CLOCK_MONOTONIC's zero,
/// and that was read at `arrival`. Empty unless the stamp lies in the second before: some drivers
/// know no time, or use another clock.
std::optional<Time> driver_time(std::optional<Duration> stamp, Time arrival);

}  // namespace vindu
