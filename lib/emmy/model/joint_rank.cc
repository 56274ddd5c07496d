#include "emmy/model/joint_rank.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <utility>

#include "emmy/base/disjoint_sets.h"
#include "emmy/model/row_space.h"
#include "emmy/numerics/rotation.h"

namespace emmy {
namespace {

// Far above the agreement asked of shared points, by which two of them may
// miss a common axis; its square is far above the rounding of a Gram matrix.
constexpr double kRankTolerance = 1e-7;

using JointRows = std::array<SparseRow, 3>;

// (CONJ-2) with the velocities scaled by the roots of masses and moments.
JointRows RowsOf(const std::vector<ModelBody>& bodies,
                 const std::vector<Matrix3d>& rotations,
                 const ModelJoint& joint) {
  JointRows rows;
  for (size_t side = 0; side < 2; ++side) {
    const Point& point = joint.points[side];
    if (!point.conventional_body.has_value()) continue;
    const size_t index = *point.conventional_body;
    const ConventionalRigidBody& body = *bodies[index].conventional();
    const double sign = side == 0 ? 1.0 : -1.0;
    const double by_mass = sign / std::sqrt(body.mass());
    const double by_moment = sign / std::sqrt(body.tensor().trace() / 3.0);
    const Matrix3d turn = -by_moment * Hat(rotations[index] * point.xi);
    const int first = 6 * static_cast<int>(index);
    for (int r = 0; r < 3; ++r) {
      SparseRow& row = rows[static_cast<size_t>(r)];
      row[first + r] += by_mass;
      for (int c = 0; c < 3; ++c) {
        if (turn(r, c) != 0.0) row[first + 3 + c] += turn(r, c);
      }
    }
  }
  return rows;
}

double Dot(const SparseRow& a, const SparseRow& b) {
  double sum = 0.0;
  for (const auto& [column, value] : a) {
    const auto other = b.find(column);
    if (other != b.end()) sum += value * other->second;
  }
  return sum;
}

Matrix3d GramMatrix(const JointRows& rows) {
  Matrix3d gram;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      gram(static_cast<int>(i), static_cast<int>(j)) = Dot(rows[i], rows[j]);
    }
  }
  return gram;
}

SparseRow Combine(const JointRows& rows, const Vector3d& weights) {
  SparseRow sum;
  for (size_t i = 0; i < 3; ++i) {
    for (const auto& [column, value] : rows[i]) {
      sum[column] += weights(static_cast<int>(i)) * value;
    }
  }
  return sum;
}

// Which parts of the model have joints that close a loop, over the ground or
// not. In the others each joint ties a part that could move freely to
// something else, and holds all directions.
class Loops {
 public:
  Loops(size_t num_bodies, const std::vector<ModelJoint>& joints)
      : parts_(num_bodies + 1), closed_(num_bodies + 1, false) {
    for (const ModelJoint& joint : joints) {
      const size_t first = parts_.Find(Number(joint.points[0]));
      const size_t second = parts_.Find(Number(joint.points[1]));
      closed_[first] = closed_[first] || closed_[second] || first == second;
      parts_.Join(first, second);
    }
  }

  bool IsClosed(const ModelJoint& joint) const {
    return closed_[parts_.Find(Number(joint.points[0]))];
  }

 private:
  // Of the body, or the last for the ground.
  size_t Number(const Point& point) const {
    return point.conventional_body.value_or(parts_.size() - 1);
  }

  DisjointSets parts_;
  std::vector<bool> closed_;  // Of those that stand for their part.
};

}  // namespace

std::vector<ModelJoint> IndependentJoints(
    const std::vector<ModelBody>& bodies,
    const std::vector<Matrix3d>& rotations, std::vector<ModelJoint> joints) {
  std::vector<ModelJoint> kept;
  RowSpace space;
  const Loops loops(bodies.size(), joints);
  for (const ModelJoint& joint : joints) {
    if (!loops.IsClosed(joint)) continue;
    for (const SparseRow& row : RowsOf(bodies, rotations, joint)) {
      for (const auto& [column, value] : row) space.CountUse(column);
    }
  }
  for (ModelJoint& joint : joints) {
    if (!loops.IsClosed(joint)) {
      kept.push_back(std::move(joint));
      continue;
    }
    JointRows rows = RowsOf(bodies, rotations, joint);
    const double size = std::sqrt(GramMatrix(rows).trace() / 3.0);
    for (SparseRow& row : rows) row = space.Reduce(std::move(row));
    const Eigen::SelfAdjointEigenSolver<Matrix3d> directions(GramMatrix(rows));
    Matrix3d held = Matrix3d::Zero();
    joint.num_held = 0;
    for (int i = 0; i < 3; ++i) {
      const double left = directions.eigenvalues()(i);
      if (!(left > kRankTolerance * kRankTolerance * size * size)) continue;
      const Vector3d n = directions.eigenvectors().col(i);
      space.Add(space.Reduce(Combine(rows, n)));
      held += n * n.transpose();
      ++joint.num_held;
    }
    if (joint.num_held == 0) continue;
    const Matrix3d& turn = rotations[*joint.points[0].conventional_body];
    joint.held = joint.num_held == 3 ? Matrix3d(Matrix3d::Identity())
                                     : Matrix3d(turn.transpose() * held * turn);
    kept.push_back(std::move(joint));
  }
  return kept;
}

}  // namespace emmy
