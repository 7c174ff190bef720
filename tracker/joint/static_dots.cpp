#include "tracker/joint/static_dots.h"

#include <algorithm>

namespace vindu {

StaticDots::StaticDots(const StaticDotsOptions& options, const std::vector<Vec2>& background_px)
    : options_(options) {
  for (const Vec2& raw_px : background_px)
    spots_.push_back({.raw_px = raw_px, .masked = true, .permanent = true});
}

void StaticDots::watch(const Vec2& raw_px, Time time) {
  std::erase_if(spots_, [&](const Spot& spot) {
    return !spot.permanent &&
           time - spot.last > (spot.masked ? options_.forgotten : options_.missing);
  });
  const auto same = [&](const Spot& spot) {
    return (spot.raw_px - raw_px).norm() < (spot.masked ? options_.mask_px : options_.still_px);
  };
  const auto spot = std::ranges::find_if(spots_, same);
  if (spot == spots_.end()) {
    spots_.push_back({.raw_px = raw_px, .since = time, .last = time});
    return;
  }
  spot->last = std::max(spot->last, time);
  if (time - spot->since > options_.masked_after) spot->masked = true;
}

void StaticDots::release(const Vec2& raw_px, Time time) {
  for (Spot& spot : spots_)
    if (!spot.masked && (spot.raw_px - raw_px).norm() < options_.mask_px) spot.since = time;
}

bool StaticDots::masked(const Vec2& raw_px) const {
  return std::ranges::any_of(spots_, [&](const Spot& spot) {
    return spot.masked && (spot.raw_px - raw_px).norm() < options_.mask_px;
  });
}

std::vector<Vec2> StaticDots::masks_px() const {
  std::vector<Vec2> masks;
  for (const Spot& spot : spots_)
    if (spot.masked) masks.push_back(spot.raw_px);
  return masks;
}

}  // namespace vindu
