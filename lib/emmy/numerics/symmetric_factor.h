// Factorisation of a symmetric block matrix: symbolic once, numeric renewed.
//
// The matrix is positive definite, or quasi-definite (a joint system whose
// second diagonal block is negative definite): both have a factorisation
// L D Lᵀ for any order of elimination (Vanderbei, SIAM J. Optim. 5 (1995)).
// Small systems are dense, of fixed capacity and without allocation; others
// sparse with an approximate minimum degree order.
//
// The solution need not be exact: it is used as a correction, and only the
// residual decides the result.

#ifndef EMMY_NUMERICS_SYMMETRIC_FACTOR_H_
#define EMMY_NUMERICS_SYMMETRIC_FACTOR_H_

#include <memory>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"
#include "emmy/numerics/symmetric_block_matrix.h"

namespace emmy {

class SymmetricFactor {
 public:
  // How A is factorised.
  enum class Method {
    kAutomatic,   // kDense up to kDenseLimit unknowns, else kPanels.
    kDense,       // LDLᵀ without regard to zeros.
    kPanels,      // Our own LDLᵀ (supernodal_solve.h).
    kSimplicial,  // Eigen's LDLᵀ.
    kSupernodal,  // CHOLMOD's LLᵀ; positive definite only.
  };
  // Up to how many unknowns kAutomatic takes A for dense.
  static constexpr int kDenseLimit = 48;

  // Analyses the pattern of `matrix`, which later matrices must share.
  SymmetricFactor(const SymmetricBlockMatrix& matrix, bool positive_definite,
                  Method method = Method::kAutomatic);
  ~SymmetricFactor();
  // Moves the factors; the one moved from may only be assigned to or destroyed.
  SymmetricFactor(SymmetricFactor&&) noexcept;
  // The same.
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  // False if a pivot vanishes (or, for kSupernodal, is not positive).
  bool Factorize(const SymmetricBlockMatrix& matrix);

  // x = A⁻¹ b for the last factorised A. Threads of `team` share what can be
  // shared, the bits do not depend on it; null: the caller's thread alone.
  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* team = nullptr);

  // The one in use: never kAutomatic.
  Method method() const { return method_; }

 private:
  struct Backend;
  struct Dense;
  template <typename Scalar>
  struct Panels;
  struct Simplicial;
  struct Supernodal;

  Method method_;
  std::unique_ptr<Backend> backend_;
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_SYMMETRIC_FACTOR_H_
