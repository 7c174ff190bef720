// Pictures of a running wall: the master names one frame, each tile keeps its picture of it in a
// folder of the tile's own choice, and who asked finds them there (decision 12).
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "core/rigid3.h"
#include "core/site.h"
#include "renderer/image.h"

namespace vindu::app {

/// The frame whose pictures tiles keep.
struct CapturedFrame {
  std::uint64_t epoch = 0;
  std::uint64_t number = 0;
  Vec3 eye_in_wall = Vec3::Zero();
};

/// As the master answers: a line of five numbers.
std::string text_of(const CapturedFrame& frame);
std::optional<CapturedFrame> captured_frame_from(const std::string& text);

/// What the names of all pictures of a frame begin with, and a tile's whole name.
std::string capture_prefix(const CapturedFrame& frame);
std::string capture_file(const CapturedFrame& frame, const std::string& tile);

/// Writes pictures beside the frames that go on; the last few of a tile stay. A picture that cannot
/// be written is a warning. Waits at its end for what it still writes.
class CaptureWriter {
 public:
  void keep(const ClusterConfig& cluster, const CapturedFrame& frame, const std::string& tile,
            Image picture);

 private:
  std::vector<std::future<void>> writing_;
};

}  // namespace vindu::app
