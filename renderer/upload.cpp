#include "renderer/upload.h"

#include <algorithm>
#include <utility>

namespace vindu {

void Upload::add(Copy copy) {
  if (copy.items > 0) copies_.push_back(std::move(copy));
}

void Upload::advance(std::size_t bytes) {
  for (bool first = true; !copies_.empty(); first = false) {
    const Copy& copy = copies_.front();
    const std::size_t fitting = std::max<std::size_t>(bytes / copy.item_bytes, first ? 1 : 0);
    const std::size_t count = std::min(fitting, copy.items - moved_);
    if (count == 0) return;
    copy.move(moved_, count);
    moved_ += count;
    bytes -= std::min(bytes, count * copy.item_bytes);
    if (moved_ < copy.items) return;
    copies_.pop_front();
    moved_ = 0;
  }
}

}  // namespace vindu
