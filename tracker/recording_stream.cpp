#include "tracker/recording_stream.h"

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "core/error.h"

namespace vindu {
namespace {

constexpr std::size_t kBlock = 256 << 10;

}  // namespace

RecordingStream::RecordingStream(const std::string& file) : file_(file, std::ios::binary) {
  if (!file_ || std::filesystem::is_directory(file))
    throw Error({"cannot be read", file, "give the path of a recording"});
}

std::span<const std::uint8_t> RecordingStream::peek(std::size_t size) {
  while (window_.size() - begin_ < size && file_) {
    window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    const std::size_t kept = window_.size(), wanted = std::max(kBlock, size - kept);
    window_.resize(kept + wanted);
    file_.read(reinterpret_cast<char*>(window_.data() + kept),
               static_cast<std::streamsize>(wanted));
    window_.resize(kept + static_cast<std::size_t>(file_.gcount()));
  }
  return std::span(window_).subspan(begin_, std::min(size, window_.size() - begin_));
}

void RecordingStream::skip(std::size_t size) {
  assert(size <= window_.size() - begin_);
  begin_ += size;
  offset_ += size;
}

}  // namespace vindu
