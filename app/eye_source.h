// Where the eye comes from, one of a closed set: tracked by cameras, a camera path, a fixed point,
// or a window's pointer. Asked once a frame, for all tiles. All are bound to the render thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/camera_warnings.h"
#include "app/cameras.h"
#include "core/camera_path.h"
#include "core/frame_parts.h"
#include "core/frame_state.h"
#include "core/pose.h"
#include "core/site.h"
#include "renderer/surface.h"
#include "simulator/emulated_room.h"
#include "tracker/eye_ease.h"
#include "tracker/tracker.h"

namespace vindu::app {

/// The eye for one frame.
struct EyeNow {
  Vec3 eye_in_wall = Vec3::Zero();
  Mode mode = Mode::track;
  std::optional<PoseSample> pose{};  ///< that the eye rests on; empty where nothing is tracked
  bool tracked = false;              ///< it is the pose's eye, not held and not being led to it
};

/// How the frame that shows this eye began: tracked where the eye is seen, not held.
FrameOrigin origin_of(const EyeNow& eye, Time tick, Time found);

class EyeSource {
 public:
  virtual ~EyeSource() = default;
  /// `photon`: when the light of this frame will leave the wall.
  virtual EyeNow at(Time now, Time photon) = 0;
};

struct TrackedEyeOptions {
  CamerasOptions cameras;
  /// Called after each frame; may be empty.
  std::function<void(const Tracker&)> on_frame;
};

/// The eye of the person whom the site's cameras see.
class TrackedEye final : public EyeSource {
 public:
  /// The site, the room and the clock must outlive this. Throws Error for cameras that cannot be
  /// opened.
  TrackedEye(const Site& site, const EmulatedRoom& room, Clock& clock,
             const TrackedEyeOptions& options);

  EyeNow at(Time now, Time photon) override;
  const Tracker& tracker() const { return tracker_; }
  const Cameras& cameras() const { return cameras_; }

 private:
  Tracker tracker_;
  EyeEase ease_;
  Cameras cameras_;
  CameraWarnings warnings_;
  std::function<void(const Tracker&)> on_frame_;
};

/// The path begins with the first frame.
std::unique_ptr<EyeSource> follow_path(CameraPath path);

/// The eye of the simulated person as it truly is, without cameras.
std::unique_ptr<EyeSource> follow_person(const Person& person);

std::unique_ptr<EyeSource> stay(const Vec3& eye_in_wall);

/// The pointer moves the eye over the wall's width and height; the wheel moves it nearer and
/// farther.
std::unique_ptr<EyeSource> follow_pointer(Window& window, const Wall& wall,
                                          const Vec3& start_in_wall);

}  // namespace vindu::app
