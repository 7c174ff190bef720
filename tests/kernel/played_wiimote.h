// An emulated Wiimote that is a real device of the machine it runs on, and what Linux' hid-wiimote
// makes of it: battery, input nodes. For tests that run as root where /dev/uhid is.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tracker/wiimote/uhid_device.h"

namespace vindu::testing {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kAddress = "00:1f:c5:00:00:01";
constexpr int kDotRows_px[] = {100, 250, 400, 550};

/// Four spots below each other, that wander to the right by 1 px each 10 ms and come back.
SensorView four_spots(Time time);

/// On a thread of its own from its making to its end; then it is unplugged.
class PlayedWiimote {
 public:
  explicit PlayedWiimote(std::uint16_t product_id = 0x0306);

  /// What was written to it since the last call, by whomever.
  std::vector<Bytes> take_outputs();
  void plug_extension(bool plugged);

  static EmulatorOptions options(std::uint16_t product_id);

 private:
  void run(const std::stop_token& stop, std::uint16_t product_id);

  std::mutex mutex_;  // guards what follows
  std::vector<Bytes> outputs_;
  std::vector<std::function<void(WiimoteEmulator&)>> wishes_;
  std::jthread thread_;
};

/// "16 04 b0 00 30 01 01": hex, without the zeros that fill up a write to memory.
std::string hex(Bytes report);

/// hid-wiimote looks for a Motion Plus every 4 s, at any time.
bool is_motion_plus_poll(const std::string& report);

/// What was written to it until nothing came for half a second, but for those polls.
std::vector<std::string> written_to(PlayedWiimote& wiimote);

/// The node in /dev/input of this name, once it is there; empty after 10 s.
std::string input_node(const std::string& name);

/// As hid-wiimote answers it, in percent; -1 where it does not.
int battery_percent();

/// An open file; opening and closing an input node is what disturbs.
class OpenFile {
 public:
  OpenFile(const std::string& name, int flags);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int number() const { return file_; }

 private:
  int file_;
};

}  // namespace vindu::testing
