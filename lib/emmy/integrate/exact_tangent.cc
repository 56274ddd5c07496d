#include "emmy/integrate/exact_tangent.h"

#include <Eigen/SparseLU>
#include <vector>

#include "emmy/element/ancf_rigid_body.h"

namespace emmy {
namespace {

// Collects 3×3 blocks as entries of a sparse matrix.
class BlockEntries {
 public:
  void Add(int row, int column, const Matrix3d& block) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        if (block(r, c) != 0.0) {
          entries_.emplace_back(3 * row + r, 3 * column + c, block(r, c));
        }
      }
    }
  }
  const std::vector<Eigen::Triplet<double>>& entries() const {
    return entries_;
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
};

void AddBody(const Structure::Body& body, double quarter,
             const ExactTangentPoint& point, BlockEntries* entries) {
  const Vector6d& stiffness = body.body->ancf()->penalty_stiffness();
  const Vector6d c = quarter * stiffness;
  const Vector6d stress =
      c.cwiseProduct(point.mean_strain.segment<6>(body.first_strain));
  const auto mean = [&](int k) { return point.mean.col(body.first + 1 + k); };
  const auto end = [&](int k) { return point.end.col(body.first + 1 + k); };
  const auto at = [&](int k) { return body.first + 1 + k; };
  for (int k = 0; k < 3; ++k) {
    entries->Add(
        at(k), at(k),
        c(k) * mean(k) * end(k).transpose() + stress(k) * Matrix3d::Identity());
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(k)];
    const double shear = c(3 + k);
    const Matrix3d shear_stress = stress(3 + k) * Matrix3d::Identity();
    entries->Add(at(m), at(m), shear * mean(n) * end(n).transpose());
    entries->Add(at(m), at(n),
                 shear * mean(n) * end(m).transpose() + shear_stress);
    entries->Add(at(n), at(m),
                 shear * mean(m) * end(n).transpose() + shear_stress);
    entries->Add(at(n), at(n), shear * mean(m) * end(m).transpose());
  }
}

}  // namespace

bool SolveExactTangent(const Structure& structure, double time_step,
                       const ExactTangentPoint& point,
                       const Matrix3Xd& residual,
                       const Matrix3Xd& constraint_residual,
                       Matrix3Xd* correction,
                       Matrix3Xd* multiplier_correction) {
  const double quarter = 0.25 * time_step * time_step;
  BlockEntries entries;
  for (const Structure::Mass& mass : structure.masses) {
    const Matrix3d block = mass.mass * Matrix3d::Identity();
    entries.Add(mass.row, mass.column, block);
    if (mass.row != mass.column) entries.Add(mass.column, mass.row, block);
  }
  for (const Structure::Body& body : structure.bodies) {
    AddBody(body, quarter, point, &entries);
  }
  for (size_t i = 0; i < structure.lines.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Matrix3d stiffness =
        quarter * (point.line_tension(k) * Matrix3d::Identity() +
                   2.0 * point.line_derivative(k) * point.line_mean.col(k) *
                       point.line_end.col(k).transpose());
    for (const WeightedVector& a : structure.lines[i].terms) {
      for (const WeightedVector& b : structure.lines[i].terms) {
        entries.Add(a.vector, b.vector, a.weight * b.weight * stiffness);
      }
    }
  }
  const int vectors = structure.num_vectors();
  for (int c = 0; c < structure.num_constraints(); ++c) {
    for (const WeightedVector& term :
         structure.constraints[static_cast<size_t>(c)].terms) {
      const Matrix3d block = term.weight * Matrix3d::Identity();
      entries.Add(vectors + c, term.vector, block);
      entries.Add(term.vector, vectors + c, block);
    }
  }
  const int blocks = vectors + structure.num_constraints();
  Eigen::SparseMatrix<double> matrix(3 * blocks, 3 * blocks);
  matrix.setFromTriplets(entries.entries().begin(), entries.entries().end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  VectorXd right(3 * blocks);
  right.head(3 * vectors) =
      Eigen::Map<const VectorXd>(residual.data(), residual.size());
  right.tail(3 * structure.num_constraints()) = Eigen::Map<const VectorXd>(
      constraint_residual.data(), constraint_residual.size());
  const VectorXd solution = factor.solve(right);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::Map<const Matrix3Xd> columns(solution.data(), 3, blocks);
  *correction = columns.leftCols(vectors);
  *multiplier_correction = columns.rightCols(structure.num_constraints());
  return true;
}

}  // namespace emmy
