#include "emmy/integrate/conventional_tangent.h"

namespace emmy {

void ConventionalTangent::MakeDense(int num_blocks) {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(num_blocks);
  dense_.setZero(size, size);
  dense_factor_ = Eigen::PartialPivLU<MatrixXd>(size);
}

void ConventionalTangent::MakeSparse(
    int num_blocks, const std::vector<std::pair<int, int>>& pairs,
    const std::vector<std::vector<int>>& waits_for) {
  sparse_.emplace(num_blocks, pairs, waits_for);
}

void ConventionalTangent::SetZero() {
  if (sparse_.has_value()) {
    sparse_->SetZero();
  } else {
    dense_.setZero();
  }
}

void ConventionalTangent::Add(int row, int column, const Matrix3d& block) {
  if (sparse_.has_value()) {
    sparse_->Add(sparse_->Find(row, column), block);
  } else {
    dense_.block<3, 3>(3 * static_cast<Eigen::Index>(row),
                       3 * static_cast<Eigen::Index>(column)) += block;
  }
}

bool ConventionalTangent::Factorize() {
  if (sparse_.has_value()) return sparse_->Factorize();
  dense_factor_.compute(dense_);
  return true;
}

void ConventionalTangent::Solve(const VectorXd& residual,
                                VectorXd* correction) const {
  if (sparse_.has_value()) {
    sparse_->Solve(residual, correction);
  } else {
    *correction = dense_factor_.solve(residual);
  }
}

}  // namespace emmy
