// What an OpenGEX file states of its axes and units, which Assimp 5.2 reads and forgets.
#pragma once

#include <string>

namespace vindu {

/// E. Lengyel, "Open Game Engine Exchange Specification", structure Metric: metres, and z is up,
/// where nothing else is stated.
struct OpenGexMetrics {
  double metres_per_unit = 1;
  int up_axis = 2;  ///< 0 to 2: x to z
};

/// Of a file's beginning, where its metrics stand; what is not sound there is as if it were not
/// there.
OpenGexMetrics opengex_metrics(const std::string& file);

}  // namespace vindu
