// A drawing on an image: smooth-edged shapes and words, in pixels from the upper left. For plans,
// plots and pages of words and marks, not for frames of scenes.
#pragma once

#include <span>
#include <string_view>

#include "core/rigid3.h"
#include "renderer/image.h"
#include "renderer/text.h"

namespace vindu {

constexpr Rgba8 kPaper{255, 255, 255, 255};
constexpr Rgba8 kInk{30, 34, 40, 255};
constexpr Rgba8 kDim{105, 112, 122, 255};
constexpr Rgba8 kFaint{222, 226, 230, 255};
// Of Okabe & Ito's colours (Color Universal Design, 2008), which people of every colour vision tell
// apart.
constexpr Rgba8 kBlue{0, 114, 178, 255};
constexpr Rgba8 kVermilion{213, 94, 0, 255};
constexpr Rgba8 kOrange{230, 159, 0, 255};
constexpr Rgba8 kSky{86, 180, 233, 255};
constexpr Rgba8 kYellow{240, 228, 66, 255};
// Of pages for a dark room.
constexpr Rgba8 kDarkPaper{16, 18, 22, 255};
constexpr Rgba8 kBright{240, 240, 240, 255};
constexpr Rgba8 kSoft{150, 158, 170, 255};
// Of a tile's own pages.
constexpr Rgba8 kNight{24, 28, 34, 255};
constexpr Rgba8 kNightWords{200, 205, 212, 255};

/// The colour over the pixel; its alpha and `cover`, 0 to 1, are how much of it.
void blend(Rgba8& pixel, const Rgba8& colour, double cover);

class Diagram {
 public:
  Diagram(SizePx size, Rgba8 paper) : image_(Image::filled(size.width, size.height, paper)) {
    clear_clip();
  }

  /// What is drawn from now on stays within; words are not cut.
  void clip(const Vec2& least_px, const Vec2& largest_px);
  void clear_clip();

  /// The colours' alpha is how much they cover.
  void rectangle(const Vec2& least_px, const Vec2& largest_px, Rgba8 colour);
  /// Convex, either way round.
  void polygon(std::span<const Vec2> corners_px, Rgba8 colour);
  void line(const Vec2& from_px, const Vec2& to_px, double width_px, Rgba8 colour);
  void disc(const Vec2& centre_px, double radius_px, Rgba8 colour);

  enum class Align { left, middle, right };
  /// `at_px` is at the top of the line.
  void text(const Vec2& at_px, std::string_view words, const TextStyle& style,
            Align align = Align::left);

  const Image& image() const { return image_; }

 private:
  Image image_;
  Vec2 clip_least_px_, clip_largest_px_;
};

}  // namespace vindu
