// Our reading of the dots against that of cwiid, wiiuse and Dolphin, on 20,000 random reports of
// every format: the same, but for faults of theirs that are known by name. Prints how many reports
// each fault spoils; any other difference fails.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/tracker/other_parsers.h"
#include "tracker/wiimote/report.h"

namespace vindu::testing {
namespace {

constexpr int kReports = 20'000;

struct Layout {
  std::uint8_t id;
  std::size_t dots_at, dots_size, size;
};
constexpr Layout kBasic = {0x36, 3, 10, 22}, kBasicMoving = {0x37, 6, 10, 22},
                 kExtended = {0x33, 6, 12, 18}, kFirst = {0x3e, 4, 18, 22},
                 kSecond = {0x3f, 4, 18, 22};

/// Random bytes; in three of four, a run of 0xff or 0x00 among the dots, as long as may be: that
/// makes empty slots, low bytes of 0xff, and cameras that are off.
std::vector<std::uint8_t> random_report(const Layout& layout, std::mt19937& engine) {
  const auto up_to = [&](std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(0, most)(engine);
  };
  std::vector<std::uint8_t> report(layout.size);
  for (auto& byte : report) byte = static_cast<std::uint8_t>(up_to(255));
  report[0] = layout.id;
  if (up_to(3) == 0) return report;
  const std::size_t from = up_to(3) == 0 ? 0 : up_to(layout.dots_size - 1);
  const std::size_t count =
      up_to(3) == 0 ? layout.dots_size - from : up_to(layout.dots_size - from);
  std::fill_n(report.begin() + static_cast<std::ptrdiff_t>(layout.dots_at + from), count,
              up_to(2) == 0 ? 0x00 : 0xff);
  return report;
}

struct OurReading {
  OthersSlots slots;
  bool camera_silent = false;
};

std::optional<OthersDot> as_theirs(const std::optional<IrDot>& dot) {
  if (!dot) return std::nullopt;
  OthersDot same{dot->x_px, dot->y_px, dot->size};
  if (const auto& blob = dot->blob)
    same.blob = {blob->x_min, blob->y_min, blob->x_max, blob->y_max, blob->intensity};
  return same;
}

OurReading read_ours(ReportBytes bytes) {
  const Report report = parse_report(bytes).report.value();
  OurReading ours;
  if (const auto* half = std::get_if<HalfReport>(&report)) {
    std::ranges::transform(half->slots, ours.slots.begin(), as_theirs);
    ours.camera_silent = half->camera_silent;
  } else {
    const auto& data = std::get<DataReport>(report);
    std::ranges::transform(data.slots.value(), ours.slots.begin(), as_theirs);
    ours.camera_silent = data.camera_silent;
  }
  return ours;
}

constexpr const char* kLowByte = "takes dots at x = 255, 511, 767 and 1023 for empty slots";
constexpr const char* kRows = "takes empty slots for dots in rows that the camera does not have";
constexpr const char* kOff = "takes a camera that is off for dots at (0, 0)";

/// The fault of theirs that explains a slot; empty when the slots are equal.
std::optional<std::string> difference(const std::optional<OthersDot>& ours, bool camera_silent,
                                      const std::optional<OthersDot>& theirs) {
  if (ours == theirs) return std::nullopt;
  if (ours && !theirs && ours->x_px % 256 == 255) return kLowByte;
  if (!ours && theirs && theirs->y_px >= 768) return kRows;
  if (!ours && camera_silent && theirs && theirs->x_px == 0 && theirs->y_px == 0) return kOff;
  return "unknown";
}

using Reader = std::function<OthersSlots(ReportBytes)>;
using Faults = std::map<std::string, int>;  // and how many reports have them

Faults compare(const std::string& name, const Reader& read, const std::vector<Layout>& layouts) {
  std::mt19937 engine(20'000);
  Faults faults;
  int different = 0;
  for (int i = 0; i < kReports; ++i) {
    const auto report =
        random_report(layouts[static_cast<std::size_t>(i) % layouts.size()], engine);
    const OurReading ours = read_ours(report);
    const OthersSlots theirs = read(report);
    std::set<std::string> found;
    for (std::size_t slot = 0; slot < theirs.size(); ++slot)
      if (const auto fault = difference(ours.slots[slot], ours.camera_silent, theirs[slot]))
        found.insert(*fault == "unknown"
                         ? fmt::format("slot {} of {:02x}", slot, fmt::join(report, " "))
                         : *fault);
    for (const std::string& fault : found) ++faults[fault];
    different += !found.empty();
  }
  fmt::print("{}: {} of {} reports read alike\n", name, kReports - different, kReports);
  for (const auto& [fault, reports] : faults) fmt::print("  {:6} {}\n", reports, fault);
  return faults;
}

std::vector<std::string> names_of(const Faults& faults) {
  std::vector<std::string> names;
  for (const auto& [name, reports] : faults) names.push_back(name);
  return names;
}

TEST(OtherParsers, CwiidReadsTheSameDotsButForThreeFaults) {
  Cwiid cwiid;

  const Faults faults = compare("cwiid", [&](ReportBytes report) { return cwiid.read(report); },
                                {kBasic, kBasicMoving, kExtended});

  EXPECT_THAT(names_of(faults), ::testing::UnorderedElementsAre(kLowByte, kRows, kOff));
}

TEST(OtherParsers, WiiuseReadsTheSameDotsButForTwoFaults) {
  const Faults faults = compare("wiiuse", read_as_wiiuse, {kBasic, kBasicMoving, kExtended});

  EXPECT_THAT(names_of(faults), ::testing::UnorderedElementsAre(kRows, kOff));
}

TEST(OtherParsers, DolphinReadsTheSameDotsAndBlobsButForOneFault) {
  const Faults faults =
      compare("dolphin", read_as_dolphin, {kBasic, kBasicMoving, kExtended, kFirst, kSecond});

  EXPECT_THAT(names_of(faults), ::testing::UnorderedElementsAre(kOff));
}

}  // namespace
}  // namespace vindu::testing
