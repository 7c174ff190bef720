#include "tracker/joint/assignment.h"

#include <algorithm>
#include <optional>

namespace vindu {
namespace {

// Each row has, right of the real columns, one column of its own that means none.
class Augmenter {
 public:
  Augmenter(const CostMatrix& costs, double none)
      : costs_(costs),
        none_(none),
        rows_(static_cast<int>(costs.rows())),
        real_(static_cast<int>(costs.cols())),
        row_of_(static_cast<std::size_t>(real_ + rows_), -1),
        row_price_(static_cast<std::size_t>(rows_), 0),
        column_price_(row_of_.size(), 0) {}

  void add_row(int row) {
    std::vector<double> distance(row_of_.size(), kNoPair);
    std::vector<int> from(row_of_.size(), -1);  // the column before, on the path
    std::vector<bool> done(row_of_.size(), false);
    int column = -1, current = row;
    double length = 0;
    do {
      if (column >= 0) done[index(column)] = true;
      reach(current, column, length, done, distance, from);
      column = nearest(distance, done);
      length = distance[index(column)];
      current = row_of_[index(column)];
    } while (current >= 0);
    adjust_prices(row, length, done, distance);
    for (int end = column; end >= 0;) {
      const int before = from[index(end)];
      row_of_[index(end)] = before >= 0 ? row_of_[index(before)] : row;
      end = before;
    }
  }

  std::vector<int> columns() const {
    std::vector<int> columns(static_cast<std::size_t>(rows_), -1);
    for (int column = 0; column < real_; ++column)
      if (row_of_[index(column)] >= 0) columns[index(row_of_[index(column)])] = column;
    return columns;
  }

 private:
  static std::size_t index(int value) { return static_cast<std::size_t>(value); }

  double cost(int row, int column) const {
    if (column >= real_) return column == real_ + row ? none_ : kNoPair;
    const double cost = costs_(row, column);
    return cost < none_ ? cost : kNoPair;
  }

  void reach(int row, int through, double length, const std::vector<bool>& done,
             std::vector<double>& distance, std::vector<int>& from) const {
    for (int column = 0; column < static_cast<int>(row_of_.size()); ++column) {
      if (done[index(column)]) continue;
      const double there =
          length + cost(row, column) - row_price_[index(row)] - column_price_[index(column)];
      if (there < distance[index(column)]) {
        distance[index(column)] = there;
        from[index(column)] = through;
      }
    }
  }

  static int nearest(const std::vector<double>& distance, const std::vector<bool>& done) {
    int best = -1;
    for (std::size_t column = 0; column < distance.size(); ++column)
      if (!done[column] && (best < 0 || distance[column] < distance[index(best)]))
        best = static_cast<int>(column);
    return best;
  }

  void adjust_prices(int row, double length, const std::vector<bool>& done,
                     const std::vector<double>& distance) {
    row_price_[index(row)] += length;
    for (std::size_t column = 0; column < done.size(); ++column) {
      if (!done[column]) continue;
      row_price_[index(row_of_[column])] += length - distance[column];
      column_price_[column] -= length - distance[column];
    }
  }

  const CostMatrix& costs_;
  double none_;
  int rows_, real_;
  std::vector<int> row_of_;
  std::vector<double> row_price_, column_price_;
};

/// Each row's cheapest column; empty where two rows want the same one.
std::optional<std::vector<int>> undisputed(const CostMatrix& costs, double none) {
  std::vector<int> columns(static_cast<std::size_t>(costs.rows()), -1);
  for (Eigen::Index row = 0; row < costs.rows(); ++row) {
    Eigen::Index column = 0;
    if (costs.cols() == 0 || !(costs.row(row).minCoeff(&column) < none)) continue;
    if (std::ranges::find(columns, static_cast<int>(column)) != columns.end()) return std::nullopt;
    columns[static_cast<std::size_t>(row)] = static_cast<int>(column);
  }
  return columns;
}

}  // namespace

// Nothing is cheaper than each row's least cost, and mostly no two rows want the same column.
std::vector<int> assign(const CostMatrix& costs, double none) {
  if (auto columns = undisputed(costs, none)) return *std::move(columns);
  Augmenter augmenter(costs, none);
  for (int row = 0; row < costs.rows(); ++row) augmenter.add_row(row);
  return augmenter.columns();
}

}  // namespace vindu
