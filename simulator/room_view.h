// The laboratory as a visitor's friend sees it: the room, the wall with its pictures, the cameras,
// and the tracked person with the helmet. Its world is room. Bound to the render thread.
#pragma once

#include <memory>
#include <vector>

#include "core/site.h"
#include "renderer/wall_renderer.h"

namespace vindu {

class RoomView {
 public:
  /// Loads the laboratory from the assets. Throws Error when one is missing.
  RoomView(const Site& site, SizePx size, const Look& look);

  /// The wall must have been drawn for the same moment. Looks from behind the person, aside.
  void draw(WallRenderer& wall, const Rigid3& room_from_head);

  Picture& picture() { return picture_; }

 private:
  std::vector<const GpuScene*> pose_all(const Rigid3& room_from_head);

  Site site_;
  Canvas canvas_;
  Picture picture_;
  GpuScene lab_;
  GpuScene head_;
  GpuScene body_;
  std::vector<std::unique_ptr<GpuScene>> cameras_;
};

/// A place aside and behind, from which wall, person and cameras are in view.
Camera onlooker(const Site& site, double aspect);

/// The standing body under a head: on the floor, turned as the head is about the vertical.
Rigid3 room_from_body(const Rigid3& room_from_head);

}  // namespace vindu
