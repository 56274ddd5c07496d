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
//
// The supernodes of a large factor form a tree, whose lower branches depend on
// one another only through what they add to its top. They are dealt out to a
// fixed number of parts, so that threads can share them and the sums do not
// depend on how many threads there are.

#ifndef EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
#define EMMY_NUMERICS_SUPERNODAL_SOLVE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"

namespace emmy {

template <typename Scalar>
class SupernodalSolve {
 public:
  using SparseMatrix = Eigen::SparseMatrix<double>;
  using Permutation =
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  // Bytes of panels beyond which a factor counts as large: more than stays in
  // the cache of one processor.
  static constexpr size_t kLargeFactor = size_t{8} << 20;

  // `lower` is L below its unit diagonal, compressed columns with ascending
  // rows; `order` takes the unknowns to the rows of L.
  void Analyze(const SparseMatrix& lower, const Permutation& order,
               size_t large_factor = kLargeFactor);

  // Takes the numbers of L and D; the pattern must be that of Analyze.
  void Update(const SparseMatrix& lower, const VectorXd& diagonal);

  // x = A⁻¹ b to the precision of Scalar. Threads of `team` share the parts;
  // null: the caller's thread alone.
  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* team = nullptr);

  // Numbers stored in panels, zeros of merged columns and padding included.
  size_t panel_size() const { return panels_.size(); }

  // Branches that may be solved at the same time; 0 where that does not pay.
  size_t num_parts() const { return parts_.size(); }

 private:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  struct Supernode {
    int first = 0;         // Column of L.
    int columns = 0;       // How many.
    int rows = 0;          // Below the square block on the diagonal.
    int height = 0;        // columns + rows, padded.
    int place = 0;         // In work_.
    size_t first_run = 0;  // In runs_: which rows.
    size_t end_run = 0;
    size_t panel_start = 0;  // In panels_: height × columns.
  };
  struct Run {      // Rows one after the other.
    int first = 0;  // Place in work_.
    int count = 0;
  };
  // Supernodes and unknowns [first, end): those of a part, or the top.
  struct Part {
    size_t first = 0;
    size_t end = 0;
    int first_unknown = 0;
    int end_unknown = 0;
    Vector top;       // What the part adds to the top's unknowns.
    Vector gathered;  // At one panel.
  };

  void FindSupernodes(const SparseMatrix& lower);
  void PlacePanels(const SparseMatrix& lower);
  void DealOutParts(const SparseMatrix& lower);
  void PlaceUnknowns(const Permutation& order);
  void UpdatePanel(const SparseMatrix& lower, const Supernode& node);
  static size_t PanelSize(const Supernode& node) {
    return static_cast<size_t>(node.height) * static_cast<size_t>(node.columns);
  }
  const Scalar* Panel(size_t supernode) const {
    return panels_.data() + supernodes_[supernode].panel_start;
  }
  void Forward(const VectorXd& b, double to_unit, Part* part);
  void Backward(double scale, Part* part, VectorXd* x);

  std::vector<Supernode> supernodes_;  // Of the parts, then of the top.
  std::vector<Part> parts_;
  Part top_;
  std::vector<Run> runs_;
  std::vector<Scalar> panels_;
  bool fetches_ahead_ = false;  // Panels do not stay in the cache.
  std::vector<int> place_;      // Of a column of L in work_.
  std::vector<int> row_in_panel_;
  MatrixXd full_panel_;  // In double precision, before rounding.
  Vector inverse_diagonal_, work_;
  std::vector<int> unknown_;  // Of b and x, by place.
};

extern template class SupernodalSolve<float>;
extern template class SupernodalSolve<double>;

}  // namespace emmy

#endif  // EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
