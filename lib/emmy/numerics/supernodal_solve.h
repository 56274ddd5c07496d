// Repeated solution with a sparse factor L D Lᵀ, by dense panels.
//
// Neighbouring columns of L with nearly the same pattern (a supernode) are
// stored as one dense panel, so that a solve streams through memory instead of
// following an index for every number. With the columns' square block L₁₁ on
// the diagonal and the rows L₂₁ below it the panel is
//   P = [L₁₁⁻¹; L₂₁ L₁₁⁻¹]
// and a solve with L or Lᵀ is one product a panel:
//   [y₁; u] = P b₁, b₂ −= u      and      x₁ = Pᵀ [y₁; −x₂].
//
// Panels are kept in single precision where asked: half the memory to stream,
// and enough for a correction that the next residual corrects in turn; never
// for a result.
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

  // Numbers stored in panels, zeros of merged columns and padding included.
  size_t panel_size() const { return panels_.size(); }

 private:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  struct Supernode {
    int first = 0;         // Column of L.
    int columns = 0;       // How many.
    int rows = 0;          // Below the square block on the diagonal.
    int height = 0;        // columns + rows, padded.
    size_t first_run = 0;  // In runs_: which rows.
    size_t end_run = 0;
    size_t panel_start = 0;  // In panels_: height × columns.
  };
  struct Run {  // Rows one after the other.
    int first = 0;
    int count = 0;
  };

  void FindSupernodes(const SparseMatrix& lower);
  void UpdatePanel(const SparseMatrix& lower, const Supernode& node);
  const Scalar* Panel(size_t supernode) const {
    return panels_.data() + supernodes_[supernode].panel_start;
  }

  std::vector<Supernode> supernodes_;
  std::vector<Run> runs_;
  std::vector<Scalar> panels_;
  bool fetches_ahead_ = false;  // Panels do not stay in the cache.
  std::vector<int> place_;      // Of a row of L in the panel at hand.
  MatrixXd full_panel_;         // In double precision, before rounding.
  Vector inverse_diagonal_, work_, gathered_;
  Eigen::VectorXi order_;
};

extern template class SupernodalSolve<float>;
extern template class SupernodalSolve<double>;

}  // namespace emmy

#endif  // EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
