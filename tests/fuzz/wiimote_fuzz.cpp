// Any bytes as what a Wiimote sends: nothing crashes, every dot is on the sensor, and the driver
// never waits for a time that has passed. For libFuzzer; tests/fuzz/run.sh builds and runs it.
#include <cstdlib>
#include <span>

#include "tracker/wiimote/session.h"

namespace {

using namespace vindu;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_parser(std::span<const std::uint8_t> bytes) {
  const ParsedReport parsed = parse_report(bytes);
  require(parsed.report.has_value() == (parsed.problem == ReportProblem::none));
  const auto* data = parsed.report ? std::get_if<DataReport>(&*parsed.report) : nullptr;
  if (!data || !data->slots) return;
  for (const Dot& dot : dots_of(*data->slots))
    require(dot.x_px >= 0 && dot.x_px <= 1023 && dot.y_px >= 0 && dot.y_px <= 767 &&
            dot.size >= 0 && dot.size <= 15);
}

/// The first byte chooses the format of the dots. Then one of milliseconds, one of length, and so
/// many of report; again and again.
void check_session(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  WiimoteSession session({.format = static_cast<IrFormat>(bytes[0] % 3)});
  bytes = bytes.subspan(1);
  Time now{};
  while (bytes.size() >= 2) {
    now += std::chrono::milliseconds(bytes[0]);
    const std::size_t length = std::min<std::size_t>(bytes[1] % 65, bytes.size() - 2);
    if (const auto sample = session.take(bytes.subspan(2, length), now))
      require(sample->arrival == now);
    bytes = bytes.subspan(2 + length);
    int written = 0;
    while (session.next_output(now)) require(++written < 20);
    require(session.deadline() > now);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  check_parser(bytes);
  check_session(bytes);
  return 0;
}
