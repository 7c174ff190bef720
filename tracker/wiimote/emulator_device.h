// An emulated Wiimote that is connected to this machine: firmware, radio link and, if wanted, the
// kernel's own driver, run in one order of time; and what may go wrong with it. Programs see it
// through the handles of EmulatedHidBus; tests and demonstrations break it here.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/random.h"
#include "tracker/wiimote/emulator.h"
#include "tracker/wiimote/emulator_kernel.h"
#include "tracker/wiimote/emulator_link.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

struct EmulatedDeviceOptions {
  HidInfo info;  ///< the bus gives the path
  EmulatorOptions firmware;
  LinkOptions link;
  std::optional<KernelOptions> kernel;  ///< hid-wiimote at work beside us
  bool permitted = true;                ///< may be opened
  bool slot = false;      ///< of a DolphinBar: stays where it is, and refuses writes while empty
  std::size_t ring = 64;  ///< reports that hidraw keeps for a reader, then it drops; 0: all
  std::uint64_t seed = 1;
};

struct EmulatedDeviceCounts {
  std::uint64_t arrived = 0;  ///< reports that reached this machine
  std::uint64_t lost = 0;     ///< on the way: link, silence, acknowledgements
  std::uint64_t dropped = 0;  ///< by a full ring
};

/// Thread-safe, as far as its clock is. Whatever is asked for happens now, by the clock.
class EmulatedDevice {
 public:
  /// `look` is called under this device's lock, in the order of time.
  EmulatedDevice(EmulatedDeviceOptions options, WiimoteEmulator::Look look, Clock& clock);

  void stay_silent(bool silent);
  /// This share of the reports 0x22 never arrives; 1 swallows all.
  void lose_acknowledgements(double share);
  void send_status();
  /// Reports of random bytes and lengths, 1 to 22.
  void send_garbage(int reports);
  void plug_extension(bool plugged);
  void set_battery(std::uint8_t level);  ///< 0: dies, and the connection with it
  /// Open handles are gone for good; what returns is switched on anew, at another path. A slot is
  /// left empty instead, and keeps its handles and its path.
  void unplug();
  void plug_in();
  void unplug_at(Time time);
  void plug_in_at(Time time);

  /// Through the kernel; without it nothing happens.
  void read_battery();
  void open_camera_node();
  void close_camera_node();

  bool connected();
  std::uint8_t leds();  ///< bit 0: the first
  bool rumbling();
  EmulatedDeviceCounts counts();
  const EmulatedDeviceOptions& options() const { return options_; }
  int connections();  ///< how often it has come back

 private:
  friend class EmulatedHandle;

  struct Arrival {
    Time at{};
    std::vector<std::uint8_t> bytes;
  };
  struct Listener {
    std::deque<Arrival> queue;
    bool gone = false;
  };
  struct Plug {
    Time at{};
    bool in = false;
  };

  /// Does this with the lock held, after all that has happened up to now.
  template <typename Action>
  auto at_present(Action action) {
    const std::scoped_lock lock(mutex_);
    const Time now = clock_.now();
    advance(now);
    return action(now);
  }

  // All of these with the lock held.
  void advance(Time until);
  Time next_event() const;
  void step(Time at);
  void connect(Time at);
  void disconnect();
  void leave(const EmulatedReport& report);
  void arrive(Arrival arrival);
  void schedule(Plug plug);

  EmulatedDeviceOptions options_;
  WiimoteEmulator::Look look_;
  Clock& clock_;
  std::mutex mutex_;
  Random random_;
  std::optional<WiimoteEmulator> firmware_;  // while connected
  std::optional<HidWiimoteKernel> kernel_;
  EmulatedLink link_;
  std::deque<KernelWrite> to_device_;
  std::deque<Arrival> on_the_way_;
  std::deque<Plug> plugs_;
  std::vector<Listener*> listeners_;  // those of open handles, which take themselves off
  bool silent_ = false;
  double acknowledgement_loss_ = 0;
  int connections_ = 0;
  EmulatedDeviceCounts counts_;
};

}  // namespace vindu
