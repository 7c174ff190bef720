// The one function of the module vindu_video.so. Private to this folder.
#pragma once

#include <string>

#include "tracker/ir_camera/video_input.h"

/// Null, and `problem` reads "what is wrong; remedy", when the input cannot be opened. Errors cross
/// as text, since exceptions should not cross modules. The caller owns what it gets.
extern "C" vindu::VideoInput* vindu_open_video(const vindu::VideoConfig& config,
                                               std::string& problem) noexcept;
