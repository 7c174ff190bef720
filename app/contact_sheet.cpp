#include "app/contact_sheet.h"

#include <algorithm>

#include "renderer/diagram.h"
#include "renderer/text.h"

namespace vindu::app {
namespace {

constexpr Rgba8 kAccent{120, 190, 235, 255};
constexpr int kSheetMargin = 28;
constexpr int kGap = 20;
constexpr int kHeader = 104;
constexpr int kCaption = 34;

struct SheetRow {
  const char* caption;
  Image Moment::*image;
};
constexpr SheetRow kSheetRows[] = {{"In the room", &Moment::room},
                                   {"What the wall shows", &Moment::wall},
                                   {"What the person sees through it", &Moment::eye}};

int row_height(const SheetRow& row, const Moment& moment) {
  return (moment.*row.image).height_px + kCaption;
}

}  // namespace

Image contact_sheet(const SheetText& text, const std::vector<Moment>& moments) {
  const int column_width = moments.front().wall.width_px;
  const int columns = static_cast<int>(moments.size());
  int height = kHeader + kSheetMargin;
  for (const SheetRow& row : kSheetRows) height += row_height(row, moments.front());
  Image sheet = Image::filled(2 * kSheetMargin + columns * column_width + (columns - 1) * kGap,
                              height + 40, kDarkPaper);
  draw_text(sheet, kSheetMargin, 20, text.title, {34, kBright, true});
  draw_text(sheet, kSheetMargin, 64, text.subtitle, {19, kSoft});
  for (int column = 0; column < columns; ++column) {
    const Moment& moment = moments[column];
    const int x = kSheetMargin + column * (column_width + kGap);
    int y = kHeader;
    draw_text(sheet, x, y, moment.title, {22, kAccent, true});
    draw_text(sheet, x + text_width_px(moment.title, {22, kAccent, true}) + 14, y + 4,
              moment.caption, {17, kSoft});
    y += 36;
    for (const SheetRow& row : kSheetRows) {
      paste(moment.*row.image, x, y, sheet);
      y += (moment.*row.image).height_px;
      draw_text(sheet, x, y + 5, row.caption, {16, kSoft});
      y += kCaption;
    }
  }
  return sheet;
}

}  // namespace vindu::app
