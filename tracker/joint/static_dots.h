// Lamps, windows and reflections stand still in a camera's picture while heads move: a dot that no
// head explains and that stays where it is becomes a mask.
#pragma once

#include <vector>

#include "core/clock.h"
#include "core/rigid3.h"

namespace vindu {

struct StaticDotsOptions {
  double still_px = 2.5;  ///< a dot that stays within this of where it was first seen stands still
  Duration masked_after = std::chrono::seconds(5);
  Duration missing = std::chrono::seconds(1);     ///< unseen for longer, it is another dot
  Duration forgotten = std::chrono::minutes(10);  ///< a mask that hid nothing for so long
  double mask_px = 8;                             ///< radius
};

/// Of one camera. Bound to one thread.
class StaticDots {
 public:
  /// `background_px`: known from an earlier look; these masks stay.
  explicit StaticDots(const StaticDotsOptions& options = {},
                      const std::vector<Vec2>& background_px = {});

  /// A dot that belongs to no head.
  void watch(const Vec2& raw_px, Time time);
  /// A dot that does: whatever stands there is none of ours to mask.
  void release(const Vec2& raw_px, Time time);

  bool masked(const Vec2& raw_px) const;
  /// Where masks are, raw.
  std::vector<Vec2> masks_px() const;

 private:
  struct Spot {
    Vec2 raw_px = Vec2::Zero();
    Time since{};
    Time last{};
    bool masked = false;
    bool permanent = false;
  };

  StaticDotsOptions options_;
  std::vector<Spot> spots_;
};

}  // namespace vindu
