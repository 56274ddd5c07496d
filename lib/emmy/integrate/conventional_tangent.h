// The tangent of a structure of conventional bodies, and its factorisation.
//
// Of 3×3 blocks: v and W of each body, w of each node, the impulse of each
// joint. Without joints dense; with them sparse, so that a chain, a tree or a
// few loops cost as their length.

#ifndef EMMY_INTEGRATE_CONVENTIONAL_TANGENT_H_
#define EMMY_INTEGRATE_CONVENTIONAL_TANGENT_H_

#include <Eigen/LU>
#include <optional>
#include <utility>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/numerics/block_lu.h"

namespace emmy {

class ConventionalTangent {
 public:
  void MakeDense(int num_blocks);
  // See BlockLu.
  void MakeSparse(int num_blocks, const std::vector<std::pair<int, int>>& pairs,
                  const std::vector<std::vector<int>>& waits_for);

  void SetZero();
  // To block (row, column), which must be in the pattern.
  void Add(int row, int column, const Matrix3d& block);

  // False, and nothing to solve with, if a pivot of the sparse factor fails.
  bool Factorize();

  void Solve(const VectorXd& residual, VectorXd* correction) const;

 private:
  MatrixXd dense_;
  Eigen::PartialPivLU<MatrixXd> dense_factor_;
  std::optional<BlockLu> sparse_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_CONVENTIONAL_TANGENT_H_
