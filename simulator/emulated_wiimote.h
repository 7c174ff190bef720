// A Wiimote that is not there: it watches the simulated person and answers as the device would, in
// report bytes and arrival times. What it knows of the truth stays inside.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "simulator/helmet.h"
#include "simulator/person.h"
#include "core/random.h"
#include "tracker/camera_model.h"
#include "tracker/wiimote/emulator.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

struct EmulatedWiimoteOptions {
  std::uint64_t seed = 1;
  double noise_px = 0.3;  ///< sigma of each coordinate, before rounding to whole units
  Duration period = std::chrono::milliseconds(10);
  Duration transport_delay = std::chrono::milliseconds(6);     ///< sample to arrival, at least
  Duration transport_jitter = std::chrono::microseconds(500);  ///< at most on top, uniform
};

/// The camera and the logic behind it: the four brightest dots, each in a slot that it keeps while
/// it is seen. Bound to one thread.
class EmulatedSensor {
 public:
  EmulatedSensor(const CameraConfig& config, const HeadConfig& head, double noise_px,
                 std::uint64_t seed);

  /// What the sensor reports of a head there.
  SensorState look(const Rigid3& room_from_head);

 private:
  struct Spot {
    std::size_t led = 0;
    Vec2 raw_px = Vec2::Zero();
    double brightness = 0;
  };

  std::vector<Spot> four_brightest(const Rigid3& room_from_head) const;
  void assign_slots(const std::vector<Spot>& spots);

  CameraModel camera_;
  Helmet helmet_;
  double noise_px_;
  Random random_;
  std::array<std::optional<std::size_t>, 4> led_of_slot_;
};

/// Silent until it is asked for a stream of report 0x33 (output report 0x12), as the real one is;
/// of the output reports it obeys that one. Clock and person must outlive it.
class EmulatedWiimote final : public HidDevice {
 public:
  EmulatedWiimote(const CameraConfig& config, const HeadConfig& head, const Person& person,
                  Clock& clock, const EmulatedWiimoteOptions& options);

  HidRead read(std::span<std::uint8_t> buffer, Time until) override;
  bool write(std::span<const std::uint8_t> report) override;

 private:
  void plan_next_sample();

  const Person& person_;
  Clock& clock_;
  EmulatedWiimoteOptions options_;
  EmulatedSensor sensor_;
  Random timing_;
  bool streaming_ = false;
  Time sample_{};   // of the report that comes next
  Time arrival_{};  // of the same
};

}  // namespace vindu
