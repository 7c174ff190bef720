// Where grey pictures come from: a V4L2 camera or a video file, read by OpenCV. OpenCV's video
// input brings some 200 shared libraries, so it lives in a module that is loaded when the first
// camera is opened, and by nobody else.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/clock.h"
#include "tracker/ir_camera/blobs.h"

namespace vindu {

enum class VideoStatus {
  picture,  ///< one was read
  nothing,  ///< none has come for a tenth of a second
  ended,    ///< the file is at its end, the camera is unplugged
};

struct VideoRead {
  VideoStatus status = VideoStatus::nothing;
  GreyView picture;  ///< valid until the next read
  /// Of a camera: the driver's time stamp on CLOCK_MONOTONIC, to be checked by who uses it; of a
  /// file: since its first picture. Empty where there is none.
  std::optional<Duration> stamp;
};

/// Bound to one thread at a time.
class VideoInput {
 public:
  virtual ~VideoInput() = default;

  /// The next picture. A camera's is waited for; a file's comes at once. Throws nothing.
  virtual VideoRead read() = 0;
};

/// Opens the device or file, and sets what the configuration gives. Throws Error with what hinders
/// it: not there, not permitted, no video, pictures of another size. A device may also be named by
/// its number. `camera` is for messages.
std::unique_ptr<VideoInput> open_video(VideoConfig config, const std::string& camera);

}  // namespace vindu
