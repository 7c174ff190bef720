// A page of figures over the scene: a title, the last frames as bars of their parts, and rows of
// numbers. It is a value, and its picture follows from it and the tile's size alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_parts.h"
#include "renderer/image.h"

namespace vindu {

/// The last frames, written over and over from left to right as an oscilloscope does, so that a new
/// frame changes one bar.
struct FrameTimeline {
  static constexpr std::size_t kFrames = 120;

  std::array<FrameParts, kFrames> frames{};  ///< frame i in slot i % kFrames
  std::size_t count = 0;                     ///< since the start
  double full_ms = 50;                       ///< at the top
  double period_ms = 1e3 / 60;               ///< of the displays' refresh: a line each
  std::array<double, kParts> mean_ms{};      ///< for the legend, by Part

  void add(const FrameParts& parts) { frames[count++ % kFrames] = parts; }
};

/// A round number that leaves room above a duration.
double full_scale_ms(double longest_ms);

struct OverlayRow {
  std::string label{};
  std::vector<std::string> values{};  ///< in columns, the last at the right edge

  bool operator==(const OverlayRow&) const = default;
};

struct OverlayPage {
  double text_px = 0;  ///< height of its letters; 0: as suits the room
  std::string title{};
  std::string aside{};  ///< at the right of the title
  std::string below{};
  std::optional<FrameTimeline> timeline{};
  std::vector<OverlayRow> rows{};  ///< the more important ones first; one without a label is a head
};

/// Where what of a page stands in its picture; what does not fit in the tile is left out.
struct OverlayLayout {
  SizePx size{};                          ///< of the picture
  double text_px = 0;                     ///< height of a line's letters
  int line_px = 0;                        ///< from line to line
  int pad_px = 0;                         ///< around everything
  int plot_y_px = 0, plot_height_px = 0;  ///< from the top; height 0: no bars
  int bars = 0;                           ///< how many, over the width within the padding
  int below_y_px = 0, legend_y_px = 0, rows_y_px = 0;  ///< 0: left out
  int legend_columns = 0;
  std::vector<std::size_t> rows{};  ///< which of the page's

  bool operator==(const OverlayLayout&) const = default;
};

/// Letters that can be read on a tile of this width.
double text_px_for(int tile_width_px);

/// `room`: what the page may take of the tile.
OverlayLayout layout_of(const OverlayPage& page, SizePx room);

/// Throws Error when the font is not there.
Image draw_page(const OverlayPage& page, const OverlayLayout& layout);

/// Draws the bar of frame `frame` (counted from the start) into such a picture, and takes away what
/// follows it. Returns the first column and how many have changed.
struct ColumnsPx {
  int x = 0, width = 0;
};
ColumnsPx draw_bar(const FrameTimeline& timeline, std::size_t frame, const OverlayLayout& layout,
                   Image& image);

}  // namespace vindu
