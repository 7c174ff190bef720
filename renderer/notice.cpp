#include "renderer/notice.h"

#include <algorithm>

#include "renderer/diagram.h"
#include "renderer/text.h"

namespace vindu {
namespace {

/// Cut between words; a word that is wider than the page stands alone.
std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, int width_px) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width_px(longer, style) <= width_px)
      lines.back() = longer;
    else
      lines.push_back(word);
    begin = end + 1;
  }
  return lines;
}

}  // namespace

Image draw_notice(const Notice& notice, SizePx size) {
  Image page = Image::filled(size.width, size.height, kNight);
  const TextStyle title{.height_px = std::clamp(size.width / 12.0, 8.0, 90.0), .bold = true};
  const TextStyle words{.height_px = std::clamp(size.width / 30.0, 6.0, 36.0),
                        .colour = kNightWords};
  std::vector<std::string> lines;
  for (const std::string& line : notice.lines)
    for (std::string& part : wrapped(line, words, size.width * 9 / 10))
      lines.push_back(std::move(part));
  const double height =
      1.4 * title.height_px + 1.3 * words.height_px * static_cast<double>(lines.size());
  double y = 0.5 * (size.height - height);
  const auto set = [&](const std::string& line, const TextStyle& style, double step) {
    draw_text(page, (size.width - text_width_px(line, style)) / 2, static_cast<int>(y), line,
              style);
    y += step * style.height_px;
  };
  set(notice.title, title, 1.4);
  for (const std::string& line : lines) set(line, words, 1.3);
  return page;
}

}  // namespace vindu
