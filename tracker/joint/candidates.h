// Rough poses from few dots, for the acquisition to complete: from points that two cameras see, and
// from three dots of one.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "tracker/joint/acquisition.h"

namespace vindu {

/// Gives one after the other; empty when there are no more.
using RoughPoses = std::function<std::optional<Rigid3>()>;

/// Upright poses in which at least `least_leds` LEDs stand where rays of the two cameras meet,
/// those with most first; `kept` at most. Two LEDs leave one angle open: it is that of a head which
/// faces the wall. The LEDs must outlive it.
RoughPoses candidates_from_pair(std::span<const CameraModel> cameras, const CameraView& a,
                                const CameraView& b, std::span<const Vec3> leds_in_head,
                                std::size_t least_leds, std::size_t kept);

/// Poses of three LEDs in three dots (P3P; OpenCV's), upright ones alone.
RoughPoses candidates_from_one(std::span<const CameraModel> cameras, const CameraView& view,
                               std::span<const Vec3> leds_in_head);

}  // namespace vindu
