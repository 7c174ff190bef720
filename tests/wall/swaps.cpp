#include "tests/wall/swaps.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace vindu::testing {
namespace {

std::optional<Swap> parse(const std::string& line) {
  std::istringstream words(line);
  Swap swap;
  std::string time, frame;
  std::getline(words, time, ',');
  std::getline(words, swap.epoch, ',');
  std::getline(words, frame, ',');
  std::getline(words, swap.tile, ',');
  std::getline(words, swap.pixels, ',');
  std::getline(words, swap.eye_x_m, ',');
  if (char comma = 0; !(words >> swap.locked >> comma >> swap.mean_level)) return std::nullopt;
  if (time.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;  // header
  swap.time_ns = std::stoll(time);
  swap.frame = std::stoull(frame);
  return swap;
}

}  // namespace

std::vector<Swap> swaps_in(const std::string& file) { return SwapReader(file).read(); }

const std::vector<Swap>& SwapReader::read() {
  std::ifstream stream(file_);
  stream.seekg(read_);
  std::string line;
  while (std::getline(stream, line) && !stream.eof()) {
    read_ += static_cast<std::streamoff>(line.size()) + 1;
    if (auto swap = parse(line)) swaps_.push_back(std::move(*swap));
  }
  return swaps_;
}

std::vector<std::string> wrong_swaps(const std::vector<std::vector<Swap>>& files) {
  std::vector<std::string> wrong;
  std::map<std::pair<std::string, std::uint64_t>, std::string> eye_of;
  for (const std::vector<Swap>& file : files) {
    std::map<std::pair<std::string, std::string>, std::uint64_t> last;  // by tile and epoch
    for (const Swap& swap : file) {
      if (swap.pixels != std::to_string(swap.frame))
        wrong.push_back(
            fmt::format("{} shows \"{}\" in frame {}", swap.tile, swap.pixels, swap.frame));
      std::uint64_t& before = last[{swap.tile, swap.epoch}];
      if (swap.frame <= before)
        wrong.push_back(fmt::format("{} shows frame {} after {}", swap.tile, swap.frame, before));
      before = swap.frame;
      const auto [eye, added] = eye_of.try_emplace({swap.epoch, swap.frame}, swap.eye_x_m);
      if (eye->second != swap.eye_x_m)
        wrong.push_back(fmt::format("{} has another eye in frame {}", swap.tile, swap.frame));
    }
  }
  return wrong;
}

}  // namespace vindu::testing
