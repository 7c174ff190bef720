#include "tracker/wiimote/drought.h"

#include <fmt/format.h>

#include "tracker/wiimote/commands.h"

namespace vindu {
namespace {

constexpr std::uint8_t kFirstDataReport = 0x30;

}  // namespace

void Drought::take(std::span<const std::uint8_t> bytes, const ParsedReport& parsed) {
  heard_ = true;
  if (bytes.empty() || bytes[0] < kFirstDataReport) return;
  if (parsed.problem == ReportProblem::too_short) {
    ++too_short_;
  } else if (parsed.report && std::holds_alternative<HalfReport>(*parsed.report)) {
    ++halves_;
  } else {
    ++others_;
    other_id_ = bytes[0];
  }
}

std::string Drought::instead() const {
  if (too_short_ > others_ + halves_) return "its reports are too short";
  if (halves_ > others_) return "of 0x3e and 0x3f one is missing";
  if (others_ > 0) return fmt::format("it sends 0x{:02x}", other_id_);
  return "it sends no data";
}

void Drought::restart(IrFormat format) {
  diagnosis_.clear();
  if (++restarts_ > 1 && heard_)
    diagnosis_ = fmt::format(
        "it is connected, but sends no 0x{:02x} ({}); end other programs that use it, or take its "
        "batteries out for a moment",
        data_report_id(format), instead());
  heard_ = false;
  too_short_ = halves_ = others_ = 0;
}

void Drought::end() { *this = {}; }

}  // namespace vindu
