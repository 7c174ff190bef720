#include "app/replay_json.h"

#include <fmt/format.h>

#include <cmath>

#include "app/common.h"
#include "tracker/wiimote/report.h"

namespace vindu::app {
namespace {

template <class Slots>
std::string json_dots(const Slots& slots, std::size_t first_slot) {
  std::string text;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!slots[i]) continue;
    text += fmt::format(R"({}{{"slot":{},"x_px":{},"y_px":{},"size":{}}})", text.empty() ? "" : ",",
                        first_slot + i, slots[i]->x_px, slots[i]->y_px, slots[i]->size);
  }
  return ",\"dots\":[" + text + "]";
}

std::string fields_of(const StatusReport& status) {
  return fmt::format(
      R"(,"kind":"status","buttons":{},"battery":{},"battery_low":{},"extension":{},)"
      R"("camera_on":{},"leds":{})",
      status.buttons, status.battery, status.battery_low, status.extension, status.camera_on,
      status.leds);
}

std::string fields_of(const MemoryReport& memory) {
  return fmt::format(R"(,"kind":"memory","buttons":{},"address":{},"error":{},"size":{})",
                     memory.buttons, memory.address, memory.error, memory.size);
}

std::string fields_of(const Acknowledgement& answer) {
  return fmt::format(R"(,"kind":"acknowledgement","buttons":{},"command":"0x{:02x}","error":{})",
                     answer.buttons, answer.command, answer.error);
}

std::string fields_of(const DataReport& data) {
  std::string text = fmt::format(R"(,"kind":"data","buttons":{})", data.buttons);
  if (const auto& raw = data.acceleration_raw)
    text += fmt::format(R"(,"acceleration_raw":[{},{},{}])", (*raw)[0], (*raw)[1], (*raw)[2]);
  return data.slots ? text + json_dots(*data.slots, 0) : text;
}

std::string fields_of(const HalfReport& half) {
  return fmt::format(R"(,"kind":"half","half":{},"buttons":{})", half.second ? 2 : 1,
                     half.buttons) +
         json_dots(half.slots, half.second ? 2 : 0);
}

/// Root mean square over the axes of the position's standard deviation; null where not known.
std::string sigma_of(const PoseSample& pose) {
  const double variance_m2 = pose.covariance.topLeftCorner<3, 3>().trace() / 3;
  return variance_m2 > 0 ? fmt::format("{}", std::sqrt(variance_m2)) : "null";
}

}  // namespace

std::string json_of(const RecordedReport& report, const std::string& device) {
  const std::string line =
      fmt::format(R"({{"device":{},"t_ns":{},"report":"0x{:02x}")", json_text(device),
                  nanoseconds(report.arrival), report.bytes.front());
  const ParsedReport parsed = parse_report(report.bytes);
  if (!parsed.report) return line + fmt::format(R"(,"problem":"{}"}})", name_of(parsed.problem));
  return line + std::visit([](const auto& known) { return fields_of(known); }, *parsed.report) +
         "}";
}

std::string json_of(const PoseSample& pose, const Vec3& eye_in_wall, bool followed,
                    Duration shift) {
  const Quat& q = pose.room_from_head.rotation;
  return fmt::format(
      R"({{"t_ns":{},"object":{},"level":"{}","eye_in_wall_m":{},)"
      R"("room_from_head":{{"translation_m":{},"quaternion_xyzw":[{},{},{},{}]}},"sigma_m":{},)"
      R"("followed":{}}})",
      nanoseconds(pose.time + shift), pose.object, name_of(pose.level), json_vec(eye_in_wall),
      json_vec(pose.room_from_head.translation), q.x(), q.y(), q.z(), q.w(), sigma_of(pose),
      followed);
}

}  // namespace vindu::app
