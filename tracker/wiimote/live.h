// A Wiimote that is used for days: a thread of its own finds it, reads it, and when it goes away
// waits for it and takes it back.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "tracker/observation_source.h"
#include "tracker/wiimote/reader.h"

namespace vindu {

/// Which device each camera has, so that no two read the same. Thread-safe.
class WiimoteClaims {
 public:
  /// True when nobody had it.
  bool claim(const std::string& path);
  void release(const std::string& path);

 private:
  std::mutex mutex_;
  std::set<std::string> paths_;
};

struct LiveWiimoteOptions {
  int camera = 0;       ///< index in the site's list
  std::string name;     ///< of the camera, for messages
  std::string address;  ///< of the device
  std::string path;     ///< of the device, where it has no address; neither: the first that is free
  WiimoteSettings settings;
  std::function<void(const WiimoteSample&)> on_sample;  ///< called on the reader's thread
  /// What a device is put into when it was opened: a recorder.
  std::function<std::unique_ptr<HidDevice>(std::unique_ptr<HidDevice>)> tap;
};

/// What the thread knows, for people to look at.
struct LiveWiimoteState {
  bool connected = false;
  HidInfo device;  ///< the last one
  WiimoteHealth health;
  std::uint64_t dropped = 0;  ///< observations that nobody took in time
  std::string trouble;        ///< why there is no device, or what is wrong with it
};

/// What is wrong now, and for how long there have been no dots: "it is connected, but silent: press
/// a button on it (12 s without reports)". Empty when nothing is.
std::string trouble_text(const LiveWiimoteState& state);
/// "camera started 1 time, 3 commands repeated": what there was of that, and of reports that were
/// refused or dropped.
std::string counts_text(const LiveWiimoteState& state);

/// The reader's thread is the only one that touches the device. next(), gone() and state() are
/// thread-safe; bus, clock and claims must outlive this.
class LiveWiimote final : public ObservationSource {
 public:
  LiveWiimote(HidBus& bus, Clock& clock, WiimoteClaims& claims, const LiveWiimoteOptions& options);

  /// What is there already; never waits.
  std::optional<Observation> next(Time until) override;
  /// Not connected now.
  bool gone() const override;
  LiveWiimoteState state() const;
  const std::string& name() const { return options_.name; }

  void rumble(bool on) { rumble_ = on; }

 private:
  enum class End { stopped, gone, refused, fruitless };

  void run(const std::stop_token& stop);
  std::string not_connected() const;
  std::unique_ptr<HidDevice> open_one(std::string& trouble);
  std::unique_ptr<HidDevice> find_device(std::string& trouble);
  bool knows_its_own() const { return !own_.address.empty() || !own_.path.empty(); }
  bool wanted(const HidInfo& found) const;
  void stay_with(const HidInfo& device);
  End read(std::unique_ptr<HidDevice> device, const std::stop_token& stop);
  End read_until_the_end(const std::stop_token& stop);
  void take(const WiimoteSample& sample);
  void wait(const std::stop_token& stop, Duration length);
  void hand_over(const Observation& observation);
  void publish(bool connected, const std::string& trouble);

  HidBus& bus_;
  Clock& clock_;
  WiimoteClaims& claims_;
  LiveWiimoteOptions options_;
  std::optional<WiimoteReader> reader_;  // of the thread
  HidInfo device_;                       // of the thread; the last that was opened
  HidInfo own_;                          // of the thread; address or path that it stays with
  bool proven_ = false;                  // of the thread; the device is known, or gave a sample
  std::set<std::string> fruitless_;      // of the thread; paths that gave nothing in this round
  std::atomic<bool> rumble_ = false;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable_any wake_;
  std::deque<Observation> queue_;
  LiveWiimoteState state_;
  std::jthread thread_;
};

}  // namespace vindu
