// What a tile's pixels showed: a line for each swap, with how many tiles were in the lock and how
// bright the picture was. A disk
// that is full loses lines, never the tile, and no line is torn.
#pragma once

#include <fstream>
#include <string>

#include "cluster/messages.h"
#include "renderer/image.h"

namespace vindu::app {

class ShownFile {
 public:
  /// Without a path nothing is wanted. In a folder (one that is there, or a path that ends in "/")
  /// it is a new file for each start: TILE-1.csv, TILE-2.csv. Throws Error when it cannot be
  /// written.
  ShownFile(const std::string& path, const std::string& tile);

  bool wanted() const { return stream_.is_open(); }
  void add(Time time, const FrameMessage& frame, const std::string& tile, const Image& picture);

 private:
  void write(const std::string& tile, const std::string& line);

  std::string file_;
  std::ofstream stream_;
  std::uintmax_t size_ = 0;  // of its whole lines
  std::uint64_t lost_ = 0;   // lines, since the last that could be written
};

}  // namespace vindu::app
