#include "emmy/model/constraint_rank.h"

#include <utility>

#include "emmy/model/row_space.h"

namespace emmy {

std::vector<ModelConstraint> IndependentConstraints(
    std::vector<ModelConstraint> constraints) {
  constexpr double kRankTolerance = 1e-10;
  std::vector<ModelConstraint> kept;
  RowSpace space;
  for (const ModelConstraint& constraint : constraints) {
    for (const WeightedVector& term : constraint.terms) {
      space.CountUse(term.vector);
    }
  }
  for (ModelConstraint& constraint : constraints) {
    SparseRow row;
    for (const WeightedVector& term : constraint.terms) {
      row[term.vector] += term.weight;
    }
    const double threshold = kRankTolerance * LargestEntry(row);
    SparseRow reduced = space.Reduce(std::move(row));
    if (!(LargestEntry(reduced) > threshold)) continue;
    space.Add(std::move(reduced));
    kept.push_back(std::move(constraint));
  }
  return kept;
}

}  // namespace emmy
