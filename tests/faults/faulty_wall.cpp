#include "tests/faults/faulty_wall.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;

std::string wall_text(const FaultyWallOptions& options) {
  return fmt::format(
      "[wall]\ncolumns = {0}\nrows = {1}\nwidth_m = {2}\nheight_m = {3}\n"
      "tile_width_px = 1024\ntile_height_px = 768\nrate_hz = {4}\n"
      "[cluster]\nmaster = \"10.77.0.1\"\ninterface = \"e0\"\n",
      options.columns, options.rows, 5.185 / 7 * options.columns, 2.238 / 4 * options.rows,
      options.rate_hz);
}

}  // namespace

FaultyWall::FaultyWall(FaultyWallOptions options)
    : options_(std::move(options)),
      wall_file_(options_.folder + "/wall.toml"),
      whole_(static_cast<std::size_t>(options_.columns) * static_cast<std::size_t>(options_.rows)) {
  std::ofstream(wall_file_) << wall_text(options_);
  std::vector<std::string> names = {"master"};
  for (int y = 0; y < options_.rows; ++y)
    for (int x = 0; x < options_.columns; ++x) names.push_back(fmt::format("tile-{}-{}", x, y));
  std::vector<int> cards;
  for (const std::string& name : names) {
    const std::string disk = options_.folder + "/" + name;
    fs::create_directory(disk);
    members_.push_back(std::make_unique<Member>(name, static_cast<int>(members_.size()) + 1, disk));
    cards.push_back(members_.back()->host.card());
  }
  switch_ = std::make_unique<LossySwitch>(cards, options_.seed);
  for (std::size_t member = 0; member < members_.size(); ++member) start(member);
}

FaultyWall::~FaultyWall() {
  for (const auto& member : members_) member->process.reset();
  switch_.reset();
}

void FaultyWall::start(std::size_t index) {
  Member& member = *members_[index];
  const std::string& name = member.host.name();
  std::vector<std::string> words = {options_.program};
  if (index == kMaster) {
    words.insert(words.end(), {"master", "--mode", "loop", "--pattern", "counter", "--json",
                               "--session", std::to_string(getpid())});  // as launchers have it
    if (!options_.model.empty()) words.push_back(options_.model);
  } else {
    member.shown.emplace_back(
        fmt::format("{}/{}.csv", member.host.folder(), member.shown.size() + 1));
    member.counted.push_back(0);
    words.insert(words.end(), {"tile", "--headless", "--scale", fmt::to_string(options_.scale),
                               "--shown", member.shown.back().file()});
  }
  words.insert(words.end(), {"--wall", wall_file_});
  member.process.emplace(words, options_.folder + "/" + name + ".log", member.host.entrance());
}

void FaultyWall::plug(std::size_t member, bool in) {
  switch_->set(member, {.plugged = in});
  members_[member]->host.plug(in);
}

void FaultyWall::supervise(Time now) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = *members_[i];
    if (member.process->runs()) {
      member.ended = {};
    } else if (member.ended == Time{}) {
      member.ended = now;
    } else if (now - member.ended > std::chrono::milliseconds(200)) {
      start(i);
    }
  }
}

const std::vector<WholeFrame>& FaultyWall::whole_frames() {
  for (std::size_t tile = 1; tile < members_.size(); ++tile) {
    Member& member = *members_[tile];
    for (std::size_t i = 0; i < member.shown.size(); ++i) {
      const std::vector<Swap>& swaps = member.shown[i].read();
      for (; member.counted[i] < swaps.size(); ++member.counted[i])
        whole_.add(swaps[member.counted[i]]);
    }
  }
  return whole_.in_order();
}

std::vector<std::vector<Swap>> FaultyWall::swaps(std::size_t tile) {
  std::vector<std::vector<Swap>> all;
  for (SwapReader& shown : members_[tile]->shown) all.push_back(shown.read());
  return all;
}

std::string FaultyWall::master_log() const {
  std::ifstream stream(options_.folder + "/master.log");
  return {std::istreambuf_iterator(stream), {}};
}

FaultyWall::Holdings FaultyWall::holdings(std::size_t member) const {
  const std::string process = "/proc/" + std::to_string(members_[member]->process->id());
  Holdings holdings;
  std::ifstream status(process + "/status");
  for (std::string word; status >> word;)
    if (word == "RssAnon:" && status >> holdings.memory_mib) holdings.memory_mib /= 1024;
  std::error_code gone;
  for ([[maybe_unused]] const auto& file : fs::directory_iterator(process + "/fd", gone))
    ++holdings.files;
  return holdings;
}

std::vector<std::string> FaultyWall::stop() {
  std::vector<std::string> wrong;
  for (const auto& member : members_) {
    member->process->send(SIGTERM);
    if (const int code = member->process->end(); code != 0)
      wrong.push_back(fmt::format("{} ended with {}", member->host.name(), code));
  }
  return wrong;
}

std::size_t FaultyWall::left_over() const {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code gone;  // a process that ends meanwhile, or is no process
    const fs::path network = fs::read_symlink(entry.path() / "ns/net", gone);
    count += std::ranges::any_of(
        members_, [&](const auto& member) { return !gone && network == member->host.network(); });
  }
  return count;
}

}  // namespace vindu::testing
