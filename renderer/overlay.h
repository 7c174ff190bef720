// Pages of figures over what is drawn: each is kept as a texture, of which a new frame changes a
// few columns; all of it is drawn anew when its words change. Bound to the render thread.
#pragma once

#include <memory>

#include "renderer/overlay_page.h"
#include "renderer/scene_renderer.h"

namespace vindu {

class OverlayPanel {
 public:
  /// Into the bound framebuffer, in the upper left of `place`; blended, so that what is behind
  /// shines through a little. Returns how wide it is; 0: there was no room.
  int draw(const OverlayPage& page, const RectPx& place, const SceneRenderer& renderer);

 private:
  bool same_words(const OverlayPage& page, const OverlayLayout& layout) const;
  void bring_up_to_date(const OverlayPage& page, const OverlayLayout& layout, Style style);
  void upload(const ColumnsPx& columns);

  OverlayPage shown_;
  OverlayLayout layout_;
  Image image_;
  std::unique_ptr<Picture> picture_;
};

}  // namespace vindu
