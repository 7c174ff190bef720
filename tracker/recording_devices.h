// Recordings at the HID seam: a device whose every report is recorded on its way to the driver, and
// one that plays a recording to the driver as if the device were there.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracker/recording_reader.h"
#include "tracker/recording_writer.h"
#include "tracker/wiimote/hid_device.h"

namespace vindu {

/// Bound to its reader's thread. The writer must outlive it.
class RecordingHidDevice final : public HidDevice {
 public:
  /// `index` is the one of the writer's info.devices.
  RecordingHidDevice(std::unique_ptr<HidDevice> device, RecordingWriter& writer, int index)
      : device_(std::move(device)), writer_(writer), index_(index) {}

  /// What did not fit into the buffer is not recorded either.
  HidRead read(std::span<std::uint8_t> buffer, Time until) override;
  bool write(std::span<const std::uint8_t> report) override { return device_->write(report); }

 private:
  std::unique_ptr<HidDevice> device_;
  RecordingWriter& writer_;
  int index_;
};

struct ReplayOptions {
  Duration shift{};  ///< what the arrival times are moved by; first arrival to now: real speed
  DamagePolicy damage = DamagePolicy::refuse;
};

/// One device of a recording. Reports come at their recorded arrival times plus the shift: in real
/// time with a MonotonicClock, at once with a ManualClock. After the last one the device is gone.
/// Bound to one thread.
class ReplayHidDevice final : public HidDevice {
 public:
  /// The clock must outlive it. Throws Error as RecordingReader does, and so does read().
  ReplayHidDevice(const std::string& file, int device, Clock& clock,
                  const ReplayOptions& options = {});

  /// An arrival before the one that came last is given as that: time does not go back.
  HidRead read(std::span<std::uint8_t> buffer, Time until) override;
  /// Takes everything and answers nothing; what the device answered then is in the recording.
  bool write(std::span<const std::uint8_t>) override { return true; }

 private:
  void fetch();

  RecordingReader reader_;
  int device_;
  Clock& clock_;
  Duration shift_;
  std::optional<RecordedReport> next_;
  Time last_arrival_ = Time::min();
};

}  // namespace vindu
