// The rank decision for constraints, once, at build time.

#ifndef EMMY_MODEL_CONSTRAINT_RANK_H_
#define EMMY_MODEL_CONSTRAINT_RANK_H_

#include <vector>

#include "emmy/model/model.h"

namespace emmy {

// Keeps a subset of the rows of G that spans the same space: Gaussian
// elimination row by row, threshold pivoting. A row that is a combination
// of those before it, to 1e-10 of its largest entry, is dropped; it holds
// whenever they do, because all of them hold at the start.
std::vector<ModelConstraint> IndependentConstraints(
    std::vector<ModelConstraint> constraints);

}  // namespace emmy

#endif  // EMMY_MODEL_CONSTRAINT_RANK_H_
