#include "app/caption.h"

#include <algorithm>
#include <utility>

#include "renderer/diagram.h"
#include "renderer/text.h"

namespace vindu::app {

void Caption::say(std::string words, Time until) {
  words_ = std::move(words);
  until_ = until;
}

const std::string& Caption::words(Time now) {
  if (now >= until_) words_.clear();
  return words_;
}

void Caption::draw(Picture& picture, Time now) {
  if (words(now).empty()) return;
  const SizePx size = picture.size();
  const TextStyle style{.height_px = std::max(12.0, size.height / 40.0), .colour = kBright};
  const int pad_px = static_cast<int>(style.height_px / 2), margin_px = size.width / 100;
  const SizePx line{std::min(text_width_px(words_, style) + 2 * pad_px, size.width - 2 * margin_px),
                    static_cast<int>(style.height_px) + 2 * pad_px};
  if (line.width < 1 || line.height + margin_px > size.height) return;
  Image image = Image::filled(line.width, line.height, kDarkPaper);
  draw_text(image, pad_px, pad_px, words_, style);
  picture.write(image, margin_px, margin_px);
}

}  // namespace vindu::app
