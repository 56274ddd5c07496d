// A symmetric sparse matrix of 3×3 blocks with a fixed pattern.
//
// The pattern is made once; afterwards blocks are added by slot, without
// search or allocation. Stored as the lower triangle, compressed by columns,
// which Eigen and CHOLMOD read directly.

#ifndef EMMY_NUMERICS_SYMMETRIC_BLOCK_MATRIX_H_
#define EMMY_NUMERICS_SYMMETRIC_BLOCK_MATRIX_H_

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "emmy/base/types.h"

namespace emmy {

class SymmetricBlockMatrix {
 public:
  // Where a block's values are.
  struct Slot {
    int block_column = 0;
    int position = 0;  // Among the blocks of its column.
  };

  // `pairs` are the (row, column) blocks that may be non-zero, in any order
  // and with repetitions; a pair and its mirror image are the same.
  SymmetricBlockMatrix(int num_blocks,
                       const std::vector<std::pair<int, int>>& pairs);

  int num_blocks() const { return num_blocks_; }

  // The slot of block (row, column), row ≥ column; must be in the pattern.
  Slot Find(int row, int column) const;

  void SetZero();

  // Adds to block (row, column); for a block on the diagonal only its lower
  // triangle counts.
  void Add(const Slot& slot, const Matrix3d& block);

  // All stored entries in their order, to keep a matrix and have it again;
  // there must be `values().size()` of them.
  Eigen::Map<const VectorXd> values() const {
    return {matrix_.valuePtr(), matrix_.nonZeros()};
  }
  void SetValues(const VectorXd& values);

  // Lower triangle; entries above the diagonal, in blocks on it, are ignored
  // by everything that reads the matrix as symmetric.
  const Eigen::SparseMatrix<double>& lower() const { return matrix_; }

 private:
  int num_blocks_;
  std::vector<std::vector<int>> rows_;  // Of each block column, ascending.
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_SYMMETRIC_BLOCK_MATRIX_H_
