#include "bench/frame_lock/sheet.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace vindu {

FrameMarks Sheet::frame(std::uint64_t number) {
  const std::uint64_t place = number % kMostFrames;
  FrameMarks frame{.locked = std::atomic_ref(locked[place]).load(), .tiles = {}};
  for (int tile = 0; tile < plan.tiles; ++tile) {
    TileMark& mark = marks[tile][place];
    frame.tiles.push_back(
        {std::atomic_ref(mark.ready_ns).load(), std::atomic_ref(mark.swapped_ns).load()});
  }
  return frame;
}

SharedSheet::SharedSheet(const LockPlan& plan) : file_(memfd_create("frame_lock_sheet", 0)) {
  if (file_ < 0 || ftruncate(file_, sizeof(Sheet)) != 0)
    throw Error({"no memory to share with the tiles", std::strerror(errno), "free some memory"});
  map();
  sheet_->plan = plan;
}

SharedSheet::SharedSheet(int file) : file_(file) { map(); }

SharedSheet::~SharedSheet() {
  munmap(sheet_, sizeof(Sheet));
  close(file_);
}

void SharedSheet::map() {
  void* const memory = mmap(nullptr, sizeof(Sheet), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED)
    throw Error({"no memory to share with the master", std::strerror(errno), "free some memory"});
  sheet_ = static_cast<Sheet*>(memory);
}

}  // namespace vindu
