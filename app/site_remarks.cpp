#include "app/site_remarks.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "tracker/calibration/layout.h"
#include "tracker/tracker.h"

namespace vindu::app {
namespace {

/// Of the LEDs that are needed, by [tracking] of the wall file and by how many cameras there are:
/// one knows no distance of its own; three LEDs do in several ways, four in one.
std::size_t least_leds(const Site& site) {
  const std::string& mode = site.tracking.mode;
  if (site.cameras.size() == 1) return mode == "six-dof" || mode == "hybrid" ? 4 : 3;
  return mode == "six-dof" ? 3 : mode == "position" ? 1 : 2;
}

/// Why this head cannot be tracked, or how little is known of it; "" where all is well.
std::string leds_remark(const Site& site, const HeadConfig& head) {
  const bool alone = site.cameras.size() == 1;
  const std::size_t least = least_leds(site), leds = head.leds_in_head.size();
  if (leds < least)
    return fmt::format(
        "mode = \"{}\" of [tracking] needs {} LEDs or more{}, and leds_m of {} has {}: nothing "
        "will "
        "be found. {}.",
        site.tracking.mode, least, alone ? " with one camera" : "", head.name, leds,
        alone ? "Add a camera, or LEDs" : "Write mode = \"position\", or add LEDs");
  if (!alone || leds > 3 || site.tracking.mode == "position") return "";
  return fmt::format(
      "one camera sees the 3 LEDs of {} in several poses: the one that faces the wall is taken, "
      "and its distance is not vouched for. Add an LED, or a camera.",
      head.name);
}

/// Why nothing can be tracked; "" where it can.
std::string start_remark(const Site& site) {
  if (site.cameras.empty()) return "";
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
  const bool few = std::min(one.leds_in_head.size(), other.leds_in_head.size()) < 3;
  return fmt::format("the LEDs of {} fit those of {} to {:.1f} mm: who is who cannot be told. {}.",
                     one.name, other.name, apart_mm,
                     few ? "Give each three LEDs or more, in other places on the one than on the "
                           "other"
                         : "Move one LED by a few centimetres");
}

/// Root mean square of the LEDs' distances from the line that lies best among them.
double off_line_mm(const std::vector<Vec3>& leds_in_head) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& led : leds_in_head) middle += led / static_cast<double>(leds_in_head.size());
  Mat3 scatter_m2 = Mat3::Zero();
  for (const Vec3& led : leds_in_head) scatter_m2 += (led - middle) * (led - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(scatter_m2, Eigen::EigenvaluesOnly);
  const double across_m2 = std::max(0.0, axes.eigenvalues().head<2>().sum());
  return 1e3 * std::sqrt(across_m2 / static_cast<double>(leds_in_head.size()));
}

/// The remedy for LEDs of one helmet that are too alike, or in line.
const char* better_leds(const HeadConfig& head) {
  return head.leds_in_head.size() == 2 ? "Add a third LED, a few centimetres off their line"
                                       : "Move one LED by a few centimetres";
}

/// Of LEDs in one line; "" where they are not, or the rotation is not asked for.
std::string line_remark(const Site& site, const HeadConfig& head) {
  constexpr double kInLine_mm = 5;  // of two cameras at 3.3 m, that is 2 degrees of a nod
  if (site.tracking.mode == "position" || head.leds_in_head.size() < 2) return "";
  const double off_mm = off_line_mm(head.leds_in_head);
  if (off_mm >= kInLine_mm) return "";
  return fmt::format(
      "the {} LEDs of {} lie in one line, to {:.1f} mm: how the head turns about it is hardly "
      "seen. "
      "There are no nods where it runs from ear to ear, and the picture is that of hybrid. {}{}.",
      head.leds_in_head.size(), head.name, off_mm, better_leds(head),
      head.leds_in_head.size() == 2 ? "" : " off the line");
}

}  // namespace

std::string layout_remark(const HeadConfig& head) {
  if (head.leds_in_head.size() == 1) return "";
  const LayoutAmbiguity ambiguity = layout_ambiguity(head.leds_in_head);
  if (ambiguity.rigid_mm >= kAmbiguous_mm) return "";
  return fmt::format(
      "a wrong labelling of the {} LEDs of {} fits to {:.1f} mm; only that heads are upright tells "
      "them apart. {}.",
      head.leds_in_head.size(), head.name, ambiguity.rigid_mm, better_leds(head));
}

std::vector<std::string> remarks_on(const Site& site) {
  std::vector<std::string> remarks = {start_remark(site)};
  const bool starts = remarks.front().empty();
  for (const HeadConfig& head : site.heads) {
    remarks.push_back(layout_remark(head));
    remarks.push_back(line_remark(site, head));
    if (starts) remarks.push_back(leds_remark(site, head));
  }
  for (std::size_t a = 0; a < site.heads.size(); ++a)
    for (std::size_t b = a + 1; b < site.heads.size(); ++b)
      remarks.push_back(likeness_remark(site.heads[a], site.heads[b]));
  std::erase(remarks, "");
  return remarks;
}

}  // namespace vindu::app
