#include "renderer/overlay.h"

#include <algorithm>

namespace vindu {
namespace {

constexpr float kOpacity = 0.96f;

/// The part of the image between two columns.
Image columns_of(const Image& image, const ColumnsPx& columns) {
  Image part = Image::filled(columns.width, image.height_px, {});
  for (int y = 0; y < image.height_px; ++y)
    std::copy_n(&image.at(columns.x, y), columns.width, &part.at(0, y));
  return part;
}

/// Everything is blended alike while this lives; then as before.
class ConstantBlend {
 public:
  ConstantBlend() {
    glGetIntegerv(GL_BLEND_SRC_RGB, &before_[0]);
    glGetIntegerv(GL_BLEND_DST_RGB, &before_[1]);
    glGetIntegerv(GL_BLEND_SRC_ALPHA, &before_[2]);
    glGetIntegerv(GL_BLEND_DST_ALPHA, &before_[3]);
    glEnable(GL_BLEND);
    glBlendColor(0, 0, 0, kOpacity);
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  }
  ConstantBlend(const ConstantBlend&) = delete;
  ConstantBlend& operator=(const ConstantBlend&) = delete;
  ~ConstantBlend() {
    glDisable(GL_BLEND);
    glBlendFuncSeparate(enum_at(0), enum_at(1), enum_at(2), enum_at(3));
  }

 private:
  GLenum enum_at(std::size_t index) const { return static_cast<GLenum>(before_[index]); }
  std::array<GLint, 4> before_{};
};

}  // namespace

bool OverlayPanel::same_words(const OverlayPage& page, const OverlayLayout& layout) const {
  const bool same = picture_ && layout == layout_ && page.title == shown_.title &&
                    page.aside == shown_.aside && page.below == shown_.below &&
                    page.rows == shown_.rows &&
                    page.timeline.has_value() == shown_.timeline.has_value();
  if (!same || !page.timeline) return same;
  const FrameTimeline &now = *page.timeline, &then = *shown_.timeline;
  return now.full_ms == then.full_ms && now.mean_ms == then.mean_ms && now.count >= then.count &&
         now.count - then.count <= static_cast<std::size_t>(layout.bars);
}

void OverlayPanel::upload(const ColumnsPx& columns) {
  picture_->write(columns_of(image_, columns), columns.x, 0);
}

void OverlayPanel::bring_up_to_date(const OverlayPage& page, const OverlayLayout& layout,
                                    Style style) {
  if (!same_words(page, layout)) {
    image_ = draw_page(page, layout);
    if (!picture_ || picture_->size() != layout.size)
      picture_ = std::make_unique<Picture>(layout.size, style);
    picture_->write(image_);
  } else if (page.timeline && layout.plot_height_px > 0) {
    for (std::size_t frame = shown_.timeline->count; frame < page.timeline->count; ++frame)
      upload(draw_bar(*page.timeline, frame, layout, image_));
  }
  shown_ = page;
  layout_ = layout;
}

int OverlayPanel::draw(const OverlayPage& page, const RectPx& place,
                       const SceneRenderer& renderer) {
  if (place.size.width < 40 || place.size.height < 24) return 0;
  bring_up_to_date(page, layout_of(page, place.size), renderer.style());
  const ConstantBlend blend;
  glViewport(place.x, place.y + place.size.height - layout_.size.height, layout_.size.width,
             layout_.size.height);
  renderer.present(*picture_, {});
  return layout_.size.width;
}

}  // namespace vindu
