// Rough poses from few dots, for the acquisition to complete: from points that two cameras see, and
// from three dots of one.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tracker/joint/acquisition.h"

namespace vindu {

/// Gives those that the next few dots allow, or none; empty when there are no more dots to try.
using RoughPoses = std::function<std::optional<std::vector<Rigid3>>()>;

/// Poses in which at least `least_leds` LEDs stand where rays of the two cameras meet, those with
/// most first; `kept` at most, and none that is turned by more than `steepest_rad` from upright and
/// facing the wall. Two LEDs leave one angle open: it is that of a head which faces the wall. The
/// LEDs must outlive it.
RoughPoses candidates_from_pair(std::span<const CameraModel> cameras, const CameraView& a,
                                const CameraView& b, std::span<const Vec3> leds_in_head,
                                std::size_t least_leds, std::size_t kept, double steepest_rad);

/// Poses of three LEDs in three dots, likewise. The LEDs must outlive it.
RoughPoses candidates_from_one(std::span<const CameraModel> cameras, const CameraView& view,
                               std::span<const Vec3> leds_in_head, double steepest_rad);

/// How often that gives something, for so many dots and LEDs.
std::size_t candidates_from_one(std::size_t dots, std::size_t leds);

}  // namespace vindu
