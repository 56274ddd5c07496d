#include "emmy/model/row_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace emmy {

double LargestEntry(const SparseRow& row) {
  double largest = 0.0;
  for (const auto& [column, value] : row) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

// Among the columns with an entry of at least `least`, the one in the fewest
// rows, then the first.
int RowSpace::SparsestColumn(const SparseRow& row, double least) const {
  int best = -1;
  int best_uses = std::numeric_limits<int>::max();
  for (const auto& [column, value] : row) {
    const int column_uses = uses_.at(column);
    if (std::abs(value) >= least && column_uses < best_uses) {
      best = column;
      best_uses = column_uses;
    }
  }
  return best;
}

SparseRow RowSpace::Reduce(SparseRow row) const {
  // A pivot row has no entry in the pivot columns of earlier rows, so that
  // eliminating in the order of the rows brings none back.
  std::map<size_t, int> to_eliminate;
  for (const auto& [column, value] : row) {
    const auto pivot = row_of_pivot_.find(column);
    if (pivot != row_of_pivot_.end()) to_eliminate[pivot->second] = column;
  }
  while (!to_eliminate.empty()) {
    const size_t index = to_eliminate.begin()->first;
    const int pivot_column = to_eliminate.begin()->second;
    to_eliminate.erase(to_eliminate.begin());
    const auto entry = row.find(pivot_column);
    if (entry == row.end()) continue;
    const double factor = entry->second;
    for (const auto& [column, value] : pivot_rows_[index]) {
      row[column] -= factor * value;
      const auto pivot = row_of_pivot_.find(column);
      if (pivot != row_of_pivot_.end() && pivot->second > index) {
        to_eliminate[pivot->second] = column;
      }
    }
    row.erase(pivot_column);
  }
  return row;
}

void RowSpace::Add(SparseRow reduced) {
  const int pivot_column = SparsestColumn(reduced, 0.1 * LargestEntry(reduced));
  const double pivot = reduced[pivot_column];
  for (auto& [column, value] : reduced) value /= pivot;
  row_of_pivot_[pivot_column] = pivot_rows_.size();
  pivot_rows_.push_back(std::move(reduced));
}

}  // namespace emmy
