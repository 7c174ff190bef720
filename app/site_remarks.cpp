#include "app/site_remarks.h"

#include <fmt/format.h>

#include "core/error.h"
#include "tracker/calibration/layout.h"
#include "tracker/tracker.h"

namespace vindu::app {
namespace {

/// Of the LEDs that are needed, by [tracking] of the wall file and by how many cameras there are:
/// one knows no distance of its own, three LEDs do.
std::size_t least_leds(const Site& site) {
  if (site.tracking.mode == "six-dof" || site.cameras.size() == 1) return 3;
  return site.tracking.mode == "position" ? 1 : 2;
}

/// Why this head cannot be tracked; "" where it can.
std::string leds_remark(const Site& site, const HeadConfig& head) {
  const bool alone = site.cameras.size() == 1;
  const std::size_t least = least_leds(site), leds = head.leds_in_head.size();
  if (leds >= least) return "";
  const char* remedy = !alone                            ? "Write mode = \"position\", or add LEDs"
                       : site.tracking.mode == "six-dof" ? "Add LEDs"
                                                         : "Add a camera, or LEDs";
  return fmt::format(
      "mode = \"{}\" of [tracking] needs {} LEDs or more{}, and leds_m of {} has {}: nothing will "
      "be found. {}.",
      site.tracking.mode, least, alone ? " with one camera" : "", head.name, leds, remedy);
}

/// Why nothing can be tracked; "" where it can.
std::string start_remark(const Site& site) {
  if (site.cameras.empty()) return "";
  if (site.tracking.mode == "position" && site.cameras.size() == 1)
    return "mode = \"position\" of [tracking] needs two cameras, and there is one: nothing will be "
           "found. Write mode = \"auto\", or add a camera.";
  try {
    const Tracker starts(site.cameras, site.heads, site.wall.room_from_wall, site.tracking);
  } catch (const Error& error) {
    return fmt::format("tracking will not start: {}", error.what());
  }
  return "";
}

std::string likeness_remark(const HeadConfig& one, const HeadConfig& other) {
  const double apart_mm = layouts_apart_mm(one.leds_in_head, other.leds_in_head);
  if (apart_mm >= kAmbiguous_mm) return "";
  return fmt::format(
      "the LEDs of {} fit those of {} to {:.1f} mm: who is who cannot be told. Move one LED by a "
      "few centimetres.",
      one.name, other.name, apart_mm);
}

}  // namespace

std::string layout_remark(const HeadConfig& head) {
  if (head.leds_in_head.size() == 1) return "";
  const LayoutAmbiguity ambiguity = layout_ambiguity(head.leds_in_head);
  if (ambiguity.rigid_mm >= kAmbiguous_mm) return "";
  return fmt::format(
      "a wrong labelling of the {} LEDs of {} fits to {:.1f} mm; only that heads are upright tells "
      "them apart. Move one LED by a few centimetres.",
      head.leds_in_head.size(), head.name, ambiguity.rigid_mm);
}

std::vector<std::string> remarks_on(const Site& site) {
  std::vector<std::string> remarks = {start_remark(site)};
  const bool starts = remarks.front().empty();
  for (const HeadConfig& head : site.heads) {
    remarks.push_back(layout_remark(head));
    if (starts) remarks.push_back(leds_remark(site, head));
  }
  for (std::size_t a = 0; a < site.heads.size(); ++a)
    for (std::size_t b = a + 1; b < site.heads.size(); ++b)
      remarks.push_back(likeness_remark(site.heads[a], site.heads[b]));
  std::erase(remarks, "");
  return remarks;
}

}  // namespace vindu::app
