#include "renderer/eye_picture.h"

namespace vindu {

Image picture_from_eye(WallRenderer& wall, const Vec3& eye_in_wall, SizePx size) {
  Canvas canvas(size, Look{wall.renderer().style()});
  Picture picture(size, wall.renderer().style());
  wall.picture().make_mipmaps();
  const double aspect = static_cast<double>(size.width) / size.height;
  const View view = camera_view(camera_on_wall(wall.wall(), eye_in_wall, aspect));
  canvas.begin();
  wall.renderer().draw_panels(view, wall.panels({}));
  canvas.resolve(picture);
  return picture.read();
}

}  // namespace vindu
