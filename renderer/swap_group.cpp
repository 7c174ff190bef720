#include "renderer/swap_group.h"

namespace vindu {

SwapGroupState join_swap_group(const SwapGroupCalls& calls) {
  if (!calls.query_max || !calls.join || !calls.bind)
    return {.text = "swap group: the driver has no GLX_NV_swap_group"};
  unsigned groups = 0, barriers = 0;
  if (!calls.query_max(groups, barriers) || groups == 0)
    return {.text = "swap group: the graphics card offers none"};
  if (!calls.join(1)) return {.text = "swap group: the driver refuses this window"};
  if (barriers == 0)
    return {.joined = true,
            .text = "swap group: joined on this machine alone, as no sync board offers a barrier"};
  if (!calls.bind(1, 1))
    return {.joined = true,
            .text = "swap group: joined on this machine alone, as the driver refuses the barrier"};
  return {.joined = true, .bound = true, .text = "swap group: joined, bound to the barrier"};
}

}  // namespace vindu
