#include "emmy/model/constraint_rank.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

namespace emmy {
namespace {

using SparseRow = std::map<int, double>;

double LargestEntry(const SparseRow& row) {
  double largest = 0.0;
  for (const auto& [column, value] : row) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

// Among the columns with an entry of at least `least`, the one in the fewest
// constraints, then the first: a chain then fills in nothing.
int SparsestColumn(const SparseRow& row, double least,
                   const std::unordered_map<int, int>& uses) {
  int best = -1;
  int best_uses = std::numeric_limits<int>::max();
  for (const auto& [column, value] : row) {
    const int column_uses = uses.at(column);
    if (std::abs(value) >= least && column_uses < best_uses) {
      best = column;
      best_uses = column_uses;
    }
  }
  return best;
}

}  // namespace

std::vector<ModelConstraint> IndependentConstraints(
    std::vector<ModelConstraint> constraints) {
  constexpr double kRankTolerance = 1e-10;
  std::vector<ModelConstraint> kept;
  std::vector<SparseRow> pivot_rows;             // Scaled to pivot 1.
  std::unordered_map<int, size_t> row_of_pivot;  // By column.
  std::unordered_map<int, int> uses;             // Constraints by column.
  for (const ModelConstraint& constraint : constraints) {
    for (const WeightedVector& term : constraint.terms) ++uses[term.vector];
  }
  for (ModelConstraint& constraint : constraints) {
    SparseRow row;
    for (const WeightedVector& term : constraint.terms) {
      row[term.vector] += term.weight;
    }
    const double threshold = kRankTolerance * LargestEntry(row);
    // A pivot row has no entry in the pivot columns of earlier rows, so that
    // eliminating in the order of the rows brings none back.
    std::map<size_t, int> to_eliminate;
    for (const auto& [column, value] : row) {
      const auto pivot = row_of_pivot.find(column);
      if (pivot != row_of_pivot.end()) to_eliminate[pivot->second] = column;
    }
    while (!to_eliminate.empty()) {
      const size_t index = to_eliminate.begin()->first;
      const int pivot_column = to_eliminate.begin()->second;
      to_eliminate.erase(to_eliminate.begin());
      const auto entry = row.find(pivot_column);
      if (entry == row.end()) continue;
      const double factor = entry->second;
      for (const auto& [column, value] : pivot_rows[index]) {
        row[column] -= factor * value;
        const auto pivot = row_of_pivot.find(column);
        if (pivot != row_of_pivot.end() && pivot->second > index) {
          to_eliminate[pivot->second] = column;
        }
      }
      row.erase(pivot_column);
    }
    const double largest = LargestEntry(row);
    if (!(largest > threshold)) continue;
    const int pivot_column = SparsestColumn(row, 0.1 * largest, uses);
    const double pivot = row[pivot_column];
    for (auto& [column, value] : row) value /= pivot;
    row_of_pivot[pivot_column] = pivot_rows.size();
    pivot_rows.push_back(std::move(row));
    kept.push_back(std::move(constraint));
  }
  return kept;
}

}  // namespace emmy
