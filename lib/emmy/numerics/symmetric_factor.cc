#include "emmy/numerics/symmetric_factor.h"

#include <Eigen/CholmodSupport>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "emmy/numerics/supernodal_solve.h"

namespace emmy {

struct SymmetricFactor::Backend {
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;
  virtual bool Factorize(const SymmetricBlockMatrix& matrix) = 0;
  virtual void Solve(const VectorXd& b, VectorXd* x, WorkTeam* team) = 0;
};

struct SymmetricFactor::Dense final : SymmetricFactor::Backend {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                               kDenseLimit, kDenseLimit>;

  bool Factorize(const SymmetricBlockMatrix& matrix) override {
    const Eigen::Index n = 3 * matrix.num_blocks();
    Matrix full = Matrix::Zero(n, n);
    const Eigen::SparseMatrix<double>& lower = matrix.lower();
    for (Eigen::Index column = 0; column < n; ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(lower, column); it;
           ++it) {
        if (it.row() < column) continue;
        full(it.row(), column) = it.value();
        full(column, it.row()) = it.value();
      }
    }
    lu.compute(full);
    // A vanishing pivot makes the inverse of the determinant meaningless.
    return lu.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0 &&
           lu.matrixLU().allFinite();
  }

  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* /*team*/) override {
    *x = lu.solve(b);
  }

  Eigen::PartialPivLU<Matrix> lu;
};

template <typename Scalar>
struct SymmetricFactor::Panels final : SymmetricFactor::Backend {
  explicit Panels(const SymmetricBlockMatrix& matrix) {
    panels.Analyze(matrix.lower());
  }
  bool Factorize(const SymmetricBlockMatrix& matrix) override {
    return panels.Factorize(matrix.lower());
  }
  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* team) override {
    panels.Solve(b, x, team);
  }

  SupernodalSolve<Scalar> panels;
};

struct SymmetricFactor::Simplicial final : SymmetricFactor::Backend {
  explicit Simplicial(const SymmetricBlockMatrix& matrix) {
    ldlt.analyzePattern(matrix.lower());
  }
  bool Factorize(const SymmetricBlockMatrix& matrix) override {
    ldlt.factorize(matrix.lower());
    return ldlt.info() == Eigen::Success;
  }
  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* /*team*/) override {
    *x = ldlt.solve(b);
  }

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt;
};

struct SymmetricFactor::Supernodal final : SymmetricFactor::Backend {
  explicit Supernodal(const SymmetricBlockMatrix& matrix) {
    // A failure is a result here, not a message on standard output.
    llt.cholmod().print = 0;
    llt.analyzePattern(matrix.lower());
  }
  bool Factorize(const SymmetricBlockMatrix& matrix) override {
    llt.factorize(matrix.lower());
    return llt.info() == Eigen::Success;
  }
  void Solve(const VectorXd& b, VectorXd* x, WorkTeam* /*team*/) override {
    *x = llt.solve(b);
  }

  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt;
};

SymmetricFactor::SymmetricFactor(const SymmetricBlockMatrix& matrix,
                                 bool positive_definite, Method method)
    : method_(method) {
  if (method_ == Method::kAutomatic) {
    method_ = 3 * matrix.num_blocks() <= kDenseLimit ? Method::kDense
                                                     : Method::kPanels;
  }
  switch (method_) {
    case Method::kDense:
      backend_ = std::make_unique<Dense>();
      break;
    case Method::kSupernodal:
      backend_ = std::make_unique<Supernodal>(matrix);
      break;
    case Method::kSimplicial:
      backend_ = std::make_unique<Simplicial>(matrix);
      break;
    case Method::kAutomatic:
    case Method::kPanels:
      // A quasi-definite factor may grow by 1/κ: that needs every digit.
      if (positive_definite) {
        backend_ = std::make_unique<Panels<float>>(matrix);
      } else {
        backend_ = std::make_unique<Panels<double>>(matrix);
      }
      break;
  }
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept =
    default;

bool SymmetricFactor::Factorize(const SymmetricBlockMatrix& matrix) {
  return backend_->Factorize(matrix);
}

void SymmetricFactor::Solve(const VectorXd& b, VectorXd* x, WorkTeam* team) {
  backend_->Solve(b, x, team);
}

}  // namespace emmy
