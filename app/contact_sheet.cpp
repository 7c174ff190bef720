#include "app/contact_sheet.h"

#include <algorithm>

#include "renderer/text.h"

namespace vindu::app {
namespace {

constexpr Rgba8 kPaper{16, 18, 22, 255};
constexpr Rgba8 kBright{240, 240, 240, 255};
constexpr Rgba8 kDim{150, 158, 170, 255};
constexpr Rgba8 kAccent{120, 190, 235, 255};
constexpr int kMargin = 28;
constexpr int kGap = 20;
constexpr int kHeader = 104;
constexpr int kCaption = 34;

struct Row {
  const char* caption;
  Image Moment::*image;
};
constexpr Row kRows[] = {{"In the room", &Moment::room},
                         {"What the wall shows", &Moment::wall},
                         {"What the person sees through it", &Moment::eye}};

int row_height(const Row& row, const Moment& moment) {
  return (moment.*row.image).height_px + kCaption;
}

}  // namespace

Image contact_sheet(const SheetText& text, const std::vector<Moment>& moments) {
  const int column_width = moments.front().wall.width_px;
  const int columns = static_cast<int>(moments.size());
  int height = kHeader + kMargin;
  for (const Row& row : kRows) height += row_height(row, moments.front());
  Image sheet = Image::filled(2 * kMargin + columns * column_width + (columns - 1) * kGap,
                              height + 40, kPaper);
  draw_text(sheet, kMargin, 20, text.title, {34, kBright, true});
  draw_text(sheet, kMargin, 64, text.subtitle, {19, kDim});
  for (int column = 0; column < columns; ++column) {
    const Moment& moment = moments[column];
    const int x = kMargin + column * (column_width + kGap);
    int y = kHeader;
    draw_text(sheet, x, y, moment.title, {22, kAccent, true});
    draw_text(sheet, x + text_width_px(moment.title, {22, kAccent, true}) + 14, y + 4,
              moment.caption, {17, kDim});
    y += 36;
    for (const Row& row : kRows) {
      paste(moment.*row.image, x, y, sheet);
      y += (moment.*row.image).height_px;
      draw_text(sheet, x, y + 5, row.caption, {16, kDim});
      y += kCaption;
    }
  }
  return sheet;
}

}  // namespace vindu::app
