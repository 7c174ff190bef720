#include "core/frame_state.h"

#include <array>
#include <bit>

namespace vindu {
namespace {

/// FNV-1a (Fowler, Noll, Vo), 64 bit.
class Fnv1a {
 public:
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte)
      hash_ = (hash_ ^ ((value >> (8 * byte)) & 0xff)) * 0x100000001b3ULL;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3& value) {
    for (const double part : value) add(part);
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char letter : text) add(static_cast<std::uint64_t>(letter));
  }
  void add(const std::optional<TouchPage>& page) {
    add(std::uint64_t{page.has_value()});
    if (!page) return;
    add(std::uint64_t{page->points.size()});
    for (const TouchPage::Point& point : page->points) {
      add(point.x_in_wall);
      add(point.tile);
    }
    add(std::uint64_t{page->done});
    add(page->held);
    add(page->remark);
    add(page->ring_m);
  }
  /// The model as the eye sees it.
  void add_view(const FrameState& state) {
    add(state.eye_in_wall);
    for (const double part : state.navigation.wall_from_scene.rotation.coeffs()) add(part);
    add(state.navigation.wall_from_scene.translation);
    add(state.navigation.scale);
    add(state.animation_time_s);
    add(static_cast<std::uint64_t>(state.clip));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t hash_of(const FrameState& state) {
  Fnv1a hash;
  hash.add(state.number);
  hash.add(static_cast<std::uint64_t>(state.photon_time.time_since_epoch().count()));
  hash.add(static_cast<std::uint64_t>(state.mode));
  hash.add_view(state);
  hash.add(std::uint64_t{state.overlays});
  hash.add(static_cast<std::uint64_t>(state.pattern));
  hash.add(std::uint64_t{state.blank});
  hash.add(state.touch_page);
  return hash.value();
}

std::uint64_t content_hash_of(const FrameState& state) {
  Fnv1a hash;
  hash.add(std::uint64_t{state.overlays});
  hash.add(std::uint64_t{state.blank});
  if (state.blank) return hash.value();
  hash.add(state.touch_page);
  if (!state.touch_page) hash.add(static_cast<std::uint64_t>(state.pattern));
  if (shows_model(state)) hash.add_view(state);
  if (!state.touch_page && state.pattern == Pattern::eye) hash.add(state.eye_in_wall);
  if (state.overlays != 0 || shows_number(state)) hash.add(state.number);
  return hash.value();
}

}  // namespace vindu
