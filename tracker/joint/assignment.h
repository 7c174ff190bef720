// The best one-to-one pairing of dots and LEDs: exact, whatever their numbers.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace vindu {

constexpr double kNoPair = std::numeric_limits<double>::infinity();

/// Row: a dot; column: an LED. Anything as large as the price of none, kNoPair too, is no pair.
using CostMatrix = Eigen::MatrixXd;

/// For every row its column, or -1; the sum of the costs, where each row without a column costs
/// `none`, is the least there is. Shortest augmenting paths (Jonker & Volgenant 1987), n^2 (m + n).
std::vector<int> assign(const CostMatrix& costs, double none);

}  // namespace vindu
