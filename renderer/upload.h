// What is still on its way to the GPU: long copies in short pieces, so that frames go on between
// them. Bound to the render thread.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <span>

#include "renderer/gl/handle.h"

namespace vindu {

class Upload {
 public:
  /// `move` brings `count` items from `first` on to the GPU; what it reads must live until then.
  struct Copy {
    std::size_t items = 0;
    std::size_t item_bytes = 1;
    std::function<void(std::size_t first, std::size_t count)> move;
  };
  void add(Copy copy);

  /// Moves as many items as `bytes` hold, and at least one.
  void advance(std::size_t bytes);
  bool done() const { return copies_.empty(); }

 private:
  std::deque<Copy> copies_;
  std::size_t moved_ = 0;  // items of the first
};

/// Of fixed size, which `upload` fills; empty lists are no buffer.
template <class Value>
gl::Buffer make_buffer(std::span<const Value> values, Upload& upload) {
  if (values.empty()) return {};
  gl::Buffer buffer = gl::make_buffer(nullptr, values.size_bytes(), GL_DYNAMIC_STORAGE_BIT);
  upload.add({.items = values.size(),
              .item_bytes = sizeof(Value),
              .move = [name = buffer.name(), values](std::size_t first, std::size_t count) {
                glNamedBufferSubData(name, static_cast<GLintptr>(first * sizeof(Value)),
                                     static_cast<GLsizeiptr>(count * sizeof(Value)),
                                     values.data() + first);
              }});
  return buffer;
}

}  // namespace vindu
