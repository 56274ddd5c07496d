// A sparse factor L D Lᵀ by dense panels, and repeated solution with it.
//
// Neighbouring columns of L with nearly the same pattern (a supernode) are
// treated as one dense panel, so that a factorisation multiplies matrices and a
// solve streams through memory, instead of following an index for every
// number. A panel is formed of the matrix's columns less what the panels
// before it give to them, which is
//   L₂ D L₂ᵀ  of the rows L₂ they have in common with it (left-looking).
// With the columns' square block L₁₁ on the diagonal and the rows L₂₁ below it
// what a solve reads is
//   P = [L₁₁⁻¹; L₂₁ L₁₁⁻¹]
// and a solve with L or Lᵀ is one product a panel:
//   [y₁; u] = P b₁, b₂ −= u      and      x₁ = Pᵀ [y₁; −x₂].
//
// P is kept in single precision where asked: half the memory to stream, and
// enough for a correction that the next residual corrects in turn; never for a
// result. The factorisation is in double precision.
//
// The pattern is analysed once, with an approximate minimum degree order.
//
// The supernodes of a large factor form a tree, whose lower branches depend on
// one another only through what they add to its top. They are dealt out to a
// fixed number of parts, so that threads can share them and the sums do not
// depend on how many threads there are.

#ifndef EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
#define EMMY_NUMERICS_SUPERNODAL_SOLVE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"
#include "emmy/numerics/factor_pattern.h"

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

  // Of `a` the lower triangle is read.
  void Analyze(const SparseMatrix& a, size_t large_factor = kLargeFactor);

  // `a` must have the pattern of Analyze. False if a pivot vanishes or is not
  // finite; Solve must not be called then.
  bool Factorize(const SparseMatrix& a);

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
    size_t first_row = 0;  // In rows_: columns of L.
    size_t first_run = 0;  // In runs_: the same, by places.
    size_t end_run = 0;
    size_t panel_start = 0;  // In panels_ and factor_: height × columns.
    // While factorising: the next of those that wait for the same panel, and
    // the first of the rows that they have in common with it.
    size_t next_waiting = 0;
    int first_common = 0;
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

  void FindSupernodes(const FactorPattern& lower);
  void PlacePanels();
  void DealOutParts();
  void PlaceUnknowns();
  void FormPanel(const SparseMatrix& permuted, const Supernode& node);
  std::ptrdiff_t Multiply(const Supernode& node, int inner, int first_row,
                          int num_rows, int num_columns);
  void Subtract(Supernode* from, const Supernode& node);
  bool FactorizePanel(const Supernode& node);
  void InvertPanel(const Supernode& node);
  void Wait(size_t supernode);
  static size_t PanelSize(const Supernode& node) {
    return static_cast<size_t>(node.height) * static_cast<size_t>(node.columns);
  }
  const Scalar* Panel(size_t supernode) const {
    return panels_.data() + supernodes_[supernode].panel_start;
  }
  double* FactorPanel(const Supernode& node) {
    return factor_.data() + node.panel_start;
  }
  const int* Rows(const Supernode& node) const {
    return rows_.data() + node.first_row;
  }
  void Forward(const VectorXd& b, double to_unit, Part* part);
  void Backward(double scale, Part* part, VectorXd* x);

  Permutation order_;                  // Takes the unknowns to the rows of L.
  std::vector<Supernode> supernodes_;  // Of the parts, then of the top.
  std::vector<size_t> supernode_of_;   // Of a column of L.
  std::vector<int> rows_;
  std::vector<Part> parts_;
  Part top_;
  std::vector<Run> runs_;
  std::vector<Scalar> panels_;
  bool fetches_ahead_ = false;  // Panels do not stay in the cache.
  std::vector<int> place_;      // Of a column of L in work_.
  std::vector<int> row_in_panel_;
  std::vector<double> factor_;            // L, with D on its diagonal.
  std::vector<double> scaled_, product_;  // D L₂ᵀ and L₂ D L₂ᵀ.
  std::vector<size_t> first_waiting_;     // For each supernode.
  Vector inverse_diagonal_, work_;
  std::vector<int> unknown_;  // Of b and x, by place.
};

extern template class SupernodalSolve<float>;
extern template class SupernodalSolve<double>;

}  // namespace emmy

#endif  // EMMY_NUMERICS_SUPERNODAL_SOLVE_H_
