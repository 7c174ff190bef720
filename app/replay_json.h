// Reports and poses as lines of JSON, as docs/recording.md describes them.
#pragma once

#include <string>

#include "core/pose.h"
#include "tracker/recording.h"

namespace vindu::app {

/// One report of a Wiimote; bytes that are none come with what is wrong with them.
std::string json_of(const RecordedReport& report, const std::string& device);

/// One pose, and whether it is that of the head that the wall follows; its time is moved by
/// `shift`, in `t_ns`.
std::string json_of(const PoseSample& pose, const Vec3& eye_in_wall, bool followed, Duration shift);

}  // namespace vindu::app
