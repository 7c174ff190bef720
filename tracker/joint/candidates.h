// Rough poses from few dots, for the acquisition to complete: from points that two cameras see, and
// from three dots of one.
#pragma once

#include <span>
#include <vector>

#include "tracker/joint/acquisition.h"

namespace vindu {

/// Poses in which at least `least_leds` LEDs stand where rays of the two cameras meet, those with
/// most first. Two LEDs leave one angle open: it is that of a head which faces the wall.
std::vector<Rigid3> candidates_from_pair(std::span<const CameraModel> cameras, const CameraView& a,
                                         const CameraView& b, std::span<const Vec3> leds_in_head,
                                         std::size_t least_leds, std::size_t kept);

/// Poses of three LEDs in three dots (P3P; OpenCV's), upright ones alone.
std::vector<Rigid3> candidates_from_one(std::span<const CameraModel> cameras,
                                        const CameraView& view, std::span<const Vec3> leds_in_head);

}  // namespace vindu
