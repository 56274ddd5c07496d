// LU factorisation of a sparse matrix of 3×3 blocks, not symmetric in its
// values, but in its pattern.
//
//   K = L D U, L and U with unit diagonal blocks, D of 3×3 blocks  (BLU-1)
// Symbolic once, with the block of least degree first, so that chains and trees
// fill in nothing; numeric renewed without allocation. No pivoting between
// blocks: for matrices near a quasi-definite one (joint systems), whose
// multipliers have no diagonal block of their own. They wait for all blocks
// that they act on: what these leave is definite, and so is every pivot in it.
// After one of these blocks alone a pivot may vanish, as that of the second
// joint on a rod, whose ends keep their distance.
//
// The solution need not be exact: it is used as a correction, and only the
// residual decides the result.

#ifndef EMMY_NUMERICS_BLOCK_LU_H_
#define EMMY_NUMERICS_BLOCK_LU_H_

#include <cstddef>
#include <utility>
#include <vector>

#include "emmy/base/types.h"

namespace emmy {

class BlockLu {
 public:
  // Without blocks.
  BlockLu() = default;

  // `pairs` are the (row, column) blocks off the diagonal that may be non-zero,
  // in any order and with repetitions; the mirror image of each may be, too.
  // A block with a list in `waits_for` (empty, or one list a block) comes after
  // all of that list, which do not wait themselves.
  BlockLu(int num_blocks, const std::vector<std::pair<int, int>>& pairs,
          const std::vector<std::vector<int>>& waits_for);

  int num_blocks() const { return static_cast<int>(pivots_.size()); }
  // All that are stored, with those that fill in.
  size_t num_stored() const { return blocks_.size(); }

  // Where block (row, column) is, which must be in the pattern.
  size_t Find(int row, int column) const;

  void SetZero();
  void Add(size_t place, const Matrix3d& block) { blocks_[place] += block; }

  // Overwrites the matrix. False if a pivot is singular to rounding, or not
  // finite.
  bool Factorize();

  // x = K⁻¹ b for the last factorised K.
  void Solve(const VectorXd& b, VectorXd* x) const;

 private:
  // The blocks that are not yet eliminated when this one is.
  struct Pivot {
    int block = 0;
    size_t diagonal = 0;  // Place in `blocks_`.
    size_t first = 0;     // In `neighbours_`, `lower_` and `upper_`.
    size_t count = 0;     // Of neighbours.
    size_t update = 0;    // In `updates_`, count² of them, by rows.
  };

  // The pattern with what fills in, one sorted row a block.
  std::vector<std::vector<int>> rows_;
  std::vector<size_t> row_starts_;
  std::vector<Pivot> pivots_;  // In order of elimination.
  std::vector<int> neighbours_;
  std::vector<size_t> lower_, upper_, updates_;  // Places in `blocks_`.
  std::vector<Matrix3d> blocks_;
  std::vector<Matrix3d> inverses_;  // Of D, by pivot.
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_BLOCK_LU_H_
