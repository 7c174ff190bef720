// NV_swap_group: graphics cards with a sync board swap together by wire. A window's tile joins the
// group and binds it to the barrier; without the hardware nothing changes.
#pragma once

#include <functional>
#include <string>

namespace vindu {

/// The extension's functions (GLX_NV_swap_group, 2006) for one window, to be called on the thread
/// that swaps. Empty: the driver has none.
struct SwapGroupCalls {
  std::function<bool(unsigned& groups, unsigned& barriers)> query_max;
  std::function<bool(unsigned group)> join;  ///< 0: leaves
  std::function<bool(unsigned group, unsigned barrier)> bind;
};

struct SwapGroupState {
  bool joined = false;  ///< with the other windows of this machine's cards
  bool bound = false;   ///< and with those of the other machines
  std::string text;     ///< what is so, or what is missing and why
};

/// Joins group 1 and binds it to barrier 1, as far as there are any.
SwapGroupState join_swap_group(const SwapGroupCalls& calls);

}  // namespace vindu
