#include "tests/kernel/played_wiimote.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

Bytes asset(const std::string& name) {
  std::ifstream file(VINDU_SOURCE_DIR "/assets/wiimote/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::string find_input_node(const std::string& name) {
  for (const auto& entry : fs::directory_iterator("/sys/class/input")) {
    const std::string node = entry.path().filename();
    if (node.starts_with("event") && first_line(entry.path() / "device/name") == name)
      return "/dev/input/" + node;
  }
  return {};
}

}  // namespace

SensorView four_spots(Time time) {
  const auto step = time.time_since_epoch() / 10ms;
  SensorView view;
  for (const int row_px : kDotRows_px)
    view.spots.push_back({100.0 + static_cast<double>(step % 800), 1.0 * row_px, 0.2});
  return view;
}

PlayedWiimote::PlayedWiimote(std::uint16_t product_id)
    : thread_([this, product_id](const std::stop_token& stop) { run(stop, product_id); }) {}

EmulatorOptions PlayedWiimote::options(std::uint16_t product_id) {
  return {.eeprom = asset("eeprom.bin"),
          .motion_plus = product_id == 0x0330,
          .start = MonotonicClock().now()};
}

void PlayedWiimote::run(const std::stop_token& stop, std::uint16_t product_id) {
  const bool tr = product_id == 0x0330;
  const MonotonicClock clock;
  WiimoteEmulator wiimote(options(product_id), four_spots);
  const HidInfo identity{
      {}, 0x057e, product_id, tr ? "Nintendo RVL-CNT-01-TR" : "Nintendo RVL-CNT-01", kAddress};
  UhidDevice device(identity, asset("rdesc.bin"));
  const auto tap = [this](std::span<const std::uint8_t> report) {
    const std::lock_guard lock(mutex_);
    outputs_.emplace_back(report.begin(), report.end());
  };
  while (!stop.stop_requested()) {
    serve(wiimote, device, clock.now() + 5ms, tap);
    std::unique_lock lock(mutex_);
    const auto wishes = std::exchange(wishes_, {});
    lock.unlock();
    for (const auto& wish : wishes) wish(wiimote);
  }
}

std::vector<Bytes> PlayedWiimote::take_outputs() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outputs_, {});
}

void PlayedWiimote::plug_extension(bool plugged) {
  const std::lock_guard lock(mutex_);
  wishes_.emplace_back([plugged](WiimoteEmulator& wiimote) {
    wiimote.plug_extension(plugged, MonotonicClock().now());
  });
}

std::string hex(Bytes report) {
  if (report.at(0) == 0x16) report.resize(std::min<std::size_t>(report.size(), 6u + report.at(5)));
  return fmt::format("{:02x}", fmt::join(report, " "));
}

bool is_motion_plus_poll(const std::string& report) {
  return report == "17 04 a4 00 fa 00 06" || report == "16 04 a6 00 f0 01 55" ||
         report == "17 04 a6 00 fa 00 06";
}

std::vector<std::string> written_to(PlayedWiimote& wiimote) {
  std::vector<std::string> reports;
  for (int quiet = 0; quiet < 5; ++quiet) {
    std::this_thread::sleep_for(100ms);
    for (const Bytes& report : wiimote.take_outputs()) {
      if (is_motion_plus_poll(hex(report))) continue;
      reports.push_back(hex(report));
      quiet = 0;
    }
  }
  return reports;
}

std::string input_node(const std::string& name) {
  for (int tries = 0; tries < 100; ++tries) {
    std::string node = find_input_node(name);
    if (!node.empty()) return node;
    std::this_thread::sleep_for(100ms);
  }
  return {};
}

int battery_percent() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/sys/class/power_supply", error)) {
    if (!entry.path().filename().string().starts_with("wiimote_battery_")) continue;
    std::ifstream capacity(entry.path() / "capacity");
    int percent = -1;
    if (capacity >> percent) return percent;
  }
  return -1;
}

OpenFile::OpenFile(const std::string& name, int flags)
    : file_(::open(name.c_str(), flags | O_CLOEXEC)) {}

OpenFile::~OpenFile() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace vindu::testing
