#include "renderer/diagram.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vindu {
namespace {

constexpr int kSamples = 4;  // a pixel and axis

double side_of(const Vec2& from, const Vec2& to, const Vec2& point) {
  const Vec2 way = to - from, off = point - from;
  return way.x() * off.y() - way.y() * off.x();
}

bool inside(std::span<const Vec2> corners, const Vec2& point) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double side = side_of(corners[i], corners[(i + 1) % corners.size()], point);
    (side > 0 ? left : right) = true;
    if (left && right) return false;
  }
  return true;
}

/// Share of a pixel that a convex shape covers.
double cover_of(std::span<const Vec2> corners, int x, int y) {
  if (inside(corners, Vec2(x, y)) && inside(corners, Vec2(x + 1, y)) &&
      inside(corners, Vec2(x, y + 1)) && inside(corners, Vec2(x + 1, y + 1)))
    return 1;
  int hits = 0;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i)
      hits += inside(corners, Vec2(x + (i + 0.5) / kSamples, y + (j + 0.5) / kSamples));
  return hits / static_cast<double>(kSamples * kSamples);
}

/// From where to where a convex shape reaches in a row of pixels; empty: the second is less.
Vec2 reach_in_row(std::span<const Vec2> corners, int y) {
  Vec2 reach(1e300, -1e300);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double low = std::max(std::min(a.y(), b.y()), static_cast<double>(y)),
                 high = std::min(std::max(a.y(), b.y()), y + 1.0);
    if (low > high) continue;
    const auto x_at = [&](double at) {
      return a.y() == b.y() ? a.x() : a.x() + (at - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    };
    for (const double x : {x_at(low), x_at(high), a.y() == b.y() ? b.x() : x_at(low)}) {
      reach[0] = std::min(reach[0], x);
      reach[1] = std::max(reach[1], x);
    }
  }
  return reach;
}

}  // namespace

void blend(Rgba8& pixel, const Rgba8& colour, double cover) {
  const double share = cover * colour[3] / 255;
  for (int part = 0; part < 3; ++part)
    pixel[part] =
        static_cast<std::uint8_t>(std::lround(pixel[part] + share * (colour[part] - pixel[part])));
}

void Diagram::clip(const Vec2& least_px, const Vec2& largest_px) {
  clip_least_px_ = least_px.cwiseMax(Vec2::Zero());
  clip_largest_px_ = largest_px.cwiseMin(Vec2(image_.width_px, image_.height_px));
}

void Diagram::clear_clip() { clip({0, 0}, {image_.width_px, image_.height_px}); }

void Diagram::rectangle(const Vec2& least_px, const Vec2& largest_px, Rgba8 colour) {
  const std::array<Vec2, 4> corners = {least_px, Vec2(largest_px.x(), least_px.y()), largest_px,
                                       Vec2(least_px.x(), largest_px.y())};
  polygon(corners, colour);
}

void Diagram::polygon(std::span<const Vec2> corners_px, Rgba8 colour) {
  Vec2 least = corners_px.front(), largest = least;
  for (const Vec2& corner : corners_px) {
    least = least.cwiseMin(corner);
    largest = largest.cwiseMax(corner);
  }
  const Vec2 from = least.cwiseMax(clip_least_px_), to = largest.cwiseMin(clip_largest_px_);
  if ((from.array() >= to.array()).any()) return;
  for (int y = static_cast<int>(from.y()); y < to.y(); ++y) {
    // A slanted line's box is mostly empty. A tenth of a pixel more than it reaches, for rounding.
    const Vec2 reach = reach_in_row(corners_px, y);
    const double left = std::max(from.x(), reach[0] - 0.1),
                 right = std::min(to.x(), reach[1] + 0.1);
    for (int x = static_cast<int>(left); x < right; ++x)
      blend(image_.at(x, y), colour, cover_of(corners_px, x, y));
  }
}

void Diagram::line(const Vec2& from_px, const Vec2& to_px, double width_px, Rgba8 colour) {
  if (from_px == to_px) return;
  const Vec2 way = (to_px - from_px).normalized();
  const Vec2 aside = 0.5 * width_px * Vec2(-way.y(), way.x());
  const std::array<Vec2, 4> corners = {from_px + aside, to_px + aside, to_px - aside,
                                       from_px - aside};
  polygon(corners, colour);
}

void Diagram::disc(const Vec2& centre_px, double radius_px, Rgba8 colour) {
  std::array<Vec2, 24> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double angle_rad = 2 * kPi * static_cast<double>(i) / corners.size();
    corners[i] = centre_px + radius_px * Vec2(std::cos(angle_rad), std::sin(angle_rad));
  }
  polygon(corners, colour);
}

void Diagram::text(const Vec2& at_px, std::string_view words, const TextStyle& style, Align align) {
  const int width_px = text_width_px(words, style);
  const int left_px = align == Align::left ? 0 : align == Align::middle ? width_px / 2 : width_px;
  draw_text(image_, static_cast<int>(at_px.x()) - left_px, static_cast<int>(at_px.y()), words,
            style);
}

}  // namespace vindu
