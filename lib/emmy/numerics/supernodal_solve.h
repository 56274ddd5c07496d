// Repeated solution with a sparse factor L D Lᵀ, by dense panels.
//
// Neighbouring columns of L with the same pattern (a supernode) are stored as
// one dense panel, so that a solve streams through memory in long rows instead
// of following an index for every number. Panels are kept in single precision
// where asked: half the memory to stream, and enough for a correction that the
// next residual corrects in turn; never for a result.
//
// The pattern is analysed once; Update takes the numbers of a new factor.

#ifndef EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
#define EMMY_NUMERICS_SUPERNODAL_SOLVE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "emmy/base/types.h"

namespace emmy {

template <typename Scalar>
class SupernodalSolve {
 public:
  using SparseMatrix = Eigen::SparseMatrix<double>;
  using Permutation =
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  // `lower` is L below its unit diagonal, compressed columns with ascending
  // rows; `order` takes the unknowns to the rows of L.
  void Analyze(const SparseMatrix& lower, const Permutation& order);

  // Takes the numbers of L and D; the pattern must be that of Analyze.
  void Update(const SparseMatrix& lower, const VectorXd& diagonal);

  // x = A⁻¹ b to the precision of Scalar.
  void Solve(const VectorXd& b, VectorXd* x);

 private:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  struct Supernode {
    int first = 0;           // Column of L.
    int columns = 0;         // How many.
    int rows = 0;            // Below the square block on the diagonal.
    size_t row_start = 0;    // In rows_.
    size_t panel_start = 0;  // In panels_: (columns + rows) × columns.
  };

  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;
  std::vector<Scalar> panels_;
  Vector inverse_diagonal_, work_, gathered_;
  Eigen::VectorXi order_;
};

extern template class SupernodalSolve<float>;
extern template class SupernodalSolve<double>;

}  // namespace emmy

#endif  // EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
