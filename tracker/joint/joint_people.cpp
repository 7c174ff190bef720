// How the joint method keeps several people apart whose helmets are not that unlike: dots of one
// fit another one's layout as well.
#include <algorithm>

#include "tracker/joint/joint_method.h"

namespace vindu {
namespace {

/// What speaks against a head, but for LEDs that are not seen: another one may have fewer.
double cost_of_dots(const FoundHead& found, std::size_t leds) {
  const auto all = static_cast<double>(leds * found.led_of_dot.size());
  return found.cost -
         AcquisitionOptions{}.missing_led_cost * (all - static_cast<double>(found.dots()));
}

}  // namespace

/// Whether its dots are rather another's, which nobody tracks; or nearly as well, where something
/// is allowed for what cameras contradict each other.
bool JointMethod::may_be_another(const Look& look, std::size_t head, const FoundHead& found) const {
  const double own = cost_of_dots(found, leds_of_heads_[head].size());
  for (std::size_t other = 0; other < searches_.size(); ++other) {
    if (other == head || newest_heads()[other].state) continue;
    const std::vector<Vec3>& leds = leds_of_heads_[other];
    AcquisitionOptions options = acquisition_options(other, {}, look.slack_px);
    const double by = look.slack_px > 0 ? options.least_margin : 0;
    options.least_margin = 0;
    options.from_one = false;  // these are not needed, and cost a fifth of the longest frames
    const auto rival = find_head(cameras_, look.search.views(), leds, options);
    if (rival && cost_of_dots(*rival, leds.size()) < own + by) return true;
  }
  return false;
}

/// Of this camera's dots alone, taken for a head's; where they do not fit it, for nobody's.
double JointMethod::cost_alone(const CameraView& view, std::size_t head) const {
  AcquisitionOptions options = acquisition_options(head, {}, 0);
  options.least_margin = 0;
  const std::vector<Vec3>& leds = leds_of_heads_[head];
  const auto found = find_head(cameras_, std::span(&view, 1), leds, options);
  return found ? cost_of_dots(*found, leds.size())
               : options.false_dot_cost * static_cast<double>(view.dots_px.size());
}

/// Whether the dots of one of the cameras that see it are by themselves another's, which nobody
/// tracks, and not this one's, by that much of the cost.
bool JointMethod::pictures_another(const Look& look, std::size_t head, const FoundHead& found,
                                   double by) const {
  for (std::size_t v = 0; v < look.search.views().size(); ++v) {
    CameraView view = look.search.views()[v];
    if (!found.seen_in(v)) continue;
    view.sigma_px = options_.dot_sigma_px;
    const double own = cost_alone(view, head);
    for (std::size_t other = 0; other < searches_.size(); ++other)
      if (other != head && !newest_heads()[other].state && cost_alone(view, other) + by < own)
        return true;
  }
  return false;
}

/// Whether its dots are another's who is about. Where cameras seem to contradict each other, each
/// may see somebody else; what one camera sees is compared more closely than pictures that are
/// apart in time.
bool JointMethod::is_another(const Look& look, std::size_t head, const FoundHead& found) const {
  constexpr double kRatherBy = 4;  // two standard deviations of what two free numbers cost
  if (searches_.size() == 1) return false;
  if (found.cameras() == 1) return pictures_another(look, head, found, kRatherBy);
  if (look.slack_px == 0) return may_be_another(look, head, found);
  return (!look.tracked && may_be_another(look, head, found)) ||
         pictures_another(look, head, found, AcquisitionOptions{}.least_margin);
}

}  // namespace vindu
