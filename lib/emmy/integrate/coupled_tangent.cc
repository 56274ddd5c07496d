#include "emmy/integrate/coupled_tangent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "emmy/element/ancf_rigid_body.h"

namespace emmy {
namespace {

// The blocks (i, j), i ≥ j, of a body's gradient vectors.
constexpr std::array<std::pair<int, int>, 6> kGradientBlocks = {
    {{0, 0}, {1, 0}, {1, 1}, {2, 0}, {2, 1}, {2, 2}}};

// Takes a body's columns of `from` to those of `to`: its centre by `centre`,
// its gradient vectors by `gradients`.
template <typename From, typename To>
void TurnBody(int first, const Matrix3d& centre, const Matrix3d& gradients,
              const From& from, To* to) {
  to->col(first) = centre * from.col(first);
  for (int a = 1; a < 4; ++a) {
    to->col(first + a) = gradients * from.col(first + a);
  }
}

}  // namespace

SymmetricBlockMatrix CoupledTangent::MakeMatrix(const Structure& structure) {
  std::vector<std::pair<int, int>> pairs;
  for (const Structure::Mass& mass : structure.masses) {
    pairs.emplace_back(mass.row, mass.column);
  }
  for (const Structure::Body& body : structure.bodies) {
    for (const auto& [i, j] : kGradientBlocks) {
      pairs.emplace_back(body.first + 1 + i, body.first + 1 + j);
    }
  }
  for (const Structure::Line& line : structure.lines) {
    for (const WeightedVector& a : line.terms) {
      for (const WeightedVector& b : line.terms) {
        pairs.emplace_back(a.vector, b.vector);
      }
    }
  }
  for (int c = 0; c < structure.num_constraints(); ++c) {
    const int row = structure.num_vectors() + c;
    pairs.emplace_back(row, row);
    for (const WeightedVector& term :
         structure.constraints[static_cast<size_t>(c)].terms) {
      pairs.emplace_back(row, term.vector);
    }
  }
  return SymmetricBlockMatrix(
      structure.num_vectors() + structure.num_constraints(), pairs);
}

CoupledTangent::CoupledTangent(const Structure& structure, double time_step,
                               SymmetricFactor::Method method)
    : structure_(&structure),
      time_step_(time_step),
      matrix_(MakeMatrix(structure)),
      factor_(matrix_, structure.constraints.empty(), method) {
  FindSlots();
  frames_.resize(structure.bodies.size());
  body_of_.assign(static_cast<size_t>(structure.num_vectors()), -1);
  for (size_t i = 0; i < structure.bodies.size(); ++i) {
    for (int a = 0; a < 4; ++a) {
      body_of_[static_cast<size_t>(structure.bodies[i].first + a)] =
          static_cast<int>(i);
    }
  }
  const Eigen::Index size = 3 * matrix_.num_blocks();
  right_side_.setZero(size);
  solution_.setZero(size);
  for (const Structure::Mass& mass : structure.masses) {
    if (mass.row != mass.column) continue;
    own_masses_.push_back(
        {mass.row, mass.mass,
         static_cast<bool>(
             structure.translates[static_cast<size_t>(mass.row)])});
  }
  // Small against G K⁻¹ Gᵀ ~ 1/mass, large against its rounding.
  double largest_mass = 0.0;
  for (const Structure::Mass& mass : structure.masses) {
    largest_mass = std::max(largest_mass, mass.mass);
  }
  constexpr double kShift = 1e-8;
  shift_ = largest_mass > 0.0 ? kShift / largest_mass : 0.0;
}

void CoupledTangent::FindSlots() {
  for (const Structure::Mass& mass : structure_->masses) {
    mass_slots_.push_back(matrix_.Find(mass.row, mass.column));
  }
  for (const Structure::Body& body : structure_->bodies) {
    std::array<SymmetricBlockMatrix::Slot, 6>& slots =
        body_slots_.emplace_back();
    for (size_t k = 0; k < kGradientBlocks.size(); ++k) {
      slots[k] = matrix_.Find(body.first + 1 + kGradientBlocks[k].first,
                              body.first + 1 + kGradientBlocks[k].second);
    }
  }
  for (const Structure::Line& line : structure_->lines) {
    for (const WeightedVector& a : line.terms) {
      for (const WeightedVector& b : line.terms) {
        if (a.vector >= b.vector) {
          line_slots_.push_back(matrix_.Find(a.vector, b.vector));
        }
      }
    }
  }
  for (int c = 0; c < structure_->num_constraints(); ++c) {
    const int row = structure_->num_vectors() + c;
    constraint_slots_.push_back(matrix_.Find(row, row));
    for (const WeightedVector& term :
         structure_->constraints[static_cast<size_t>(c)].terms) {
      constraint_slots_.push_back(matrix_.Find(row, term.vector));
    }
  }
}

// (EM-6): along ēⱼ the penalty terms do not depend on the attitude.
void CoupledTangent::AddBodies() {
  const double quarter = 0.25 * time_step_ * time_step_;
  for (size_t i = 0; i < structure_->bodies.size(); ++i) {
    const Vector6d c =
        quarter * structure_->bodies[i].body->ancf()->penalty_stiffness();
    std::array<Matrix3d, 6> blocks;
    for (Matrix3d& block : blocks) block.setZero();
    // Of kGradientBlocks: where (row, column) is.
    const auto at = [&blocks](int row, int column) -> Matrix3d& {
      return blocks[static_cast<size_t>(row * (row + 1) / 2 + column)];
    };
    for (int k = 0; k < 3; ++k) {
      at(k, k)(k, k) += c(k);
      const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(k)];
      at(m, m)(n, n) += c(3 + k);
      at(n, n)(m, m) += c(3 + k);
      const int high = std::max(m, n);
      const int low = std::min(m, n);
      at(high, low)(low, high) += c(3 + k);
    }
    for (size_t k = 0; k < 6; ++k) {
      matrix_.Add(body_slots_[i][k], blocks[k]);
    }
  }
}

void CoupledTangent::AddLines(const TangentPoint& point) {
  const double quarter = 0.25 * time_step_ * time_step_;
  size_t slot = 0;
  for (size_t i = 0; i < structure_->lines.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Vector3d d = point.line_mean.col(column);
    const double tension = std::max(0.0, point.line_tension(column));
    const Matrix3d stiffness =
        quarter * (tension * Matrix3d::Identity() +
                   2.0 * point.line_derivative(column) * d * d.transpose());
    const std::vector<WeightedVector>& terms = structure_->lines[i].terms;
    for (const WeightedVector& a : terms) {
      const Matrix3d& left = Rotation(a.vector);
      for (const WeightedVector& b : terms) {
        if (a.vector < b.vector) continue;
        const Matrix3d& right = Rotation(b.vector);
        matrix_.Add(line_slots_[slot++],
                    a.weight * b.weight * left.transpose() * stiffness * right);
      }
    }
  }
}

void CoupledTangent::Assemble(const TangentPoint& point) {
  matrix_.SetZero();
  for (size_t i = 0; i < structure_->masses.size(); ++i) {
    const Structure::Mass& mass = structure_->masses[i];
    matrix_.Add(mass_slots_[i], mass.mass * Rotation(mass.row).transpose() *
                                    Rotation(mass.column));
  }
  AddBodies();
  AddLines(point);
  size_t slot = 0;
  for (const Structure::Constraint& constraint : structure_->constraints) {
    matrix_.Add(constraint_slots_[slot++], -shift_ * Matrix3d::Identity());
    for (const WeightedVector& term : constraint.terms) {
      matrix_.Add(constraint_slots_[slot++],
                  term.weight * Rotation(term.vector));
    }
  }
}

bool CoupledTangent::Factorize(const TangentPoint& point) {
  turn_.setIdentity();
  Assemble(point);
  ++num_factorizations_;
  positions_ = point.mean_positions;
  return factor_.Factorize(matrix_);
}

KeptTangent CoupledTangent::Keep() const {
  return {.matrix = matrix_.values(), .positions = positions_, .turn = turn_};
}

bool CoupledTangent::Restore(const KeptTangent& kept) {
  if (kept.matrix.size() != matrix_.values().size() ||
      kept.positions.cols() != structure_->num_vectors()) {
    return false;
  }
  matrix_.SetValues(kept.matrix);
  positions_ = kept.positions;
  turn_ = kept.turn;
  return factor_.Factorize(matrix_);
}

// The mass-weighted rotation that best takes the positions of the
// factorisation to those of now (Kabsch, Acta Cryst. A32 (1976)). Only frames
// depend on it: masses between vectors are left out.
void CoupledTangent::FollowStructure(const Matrix3Xd& mean_positions) {
  double mass = 0.0;
  Vector3d centre = Vector3d::Zero();
  Vector3d old_centre = Vector3d::Zero();
  Matrix3d moment = Matrix3d::Zero();
  for (const auto& [vector, weight, translates] : own_masses_) {
    const Vector3d now = mean_positions.col(vector);
    const Vector3d old = positions_.col(vector);
    moment += weight * now * old.transpose();
    if (!translates) continue;
    mass += weight;
    centre += weight * now;
    old_centre += weight * old;
  }
  // A single point, or several in one place, have no attitude.
  double spread = moment.norm();
  if (mass > 0.0) {
    const Matrix3d common = centre * old_centre.transpose() / mass;
    moment -= common;
    spread += common.norm();
  }
  const Eigen::JacobiSVD<Matrix3d> svd(
      moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()(0) > 1e-10 * spread)) return;
  Vector3d signs = Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) {
    signs(2) = -1.0;
  }
  turn_ = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

void CoupledTangent::FollowBodies(const Matrix3Xd& mean_positions,
                                  const Matrix3Xd& end_positions) {
  for (size_t i = 0; i < frames_.size(); ++i) {
    const int first = structure_->bodies[i].first;
    const Matrix3d mean = mean_positions.middleCols<3>(first + 1);
    const Matrix3d end = end_positions.middleCols<3>(first + 1);
    BodyFrame& frame = frames_[i];
    // Orthonormal by Gram and Schmidt.
    frame.rotation.col(0) = mean.col(0).normalized();
    frame.rotation.col(2) = mean.col(0).cross(mean.col(1)).normalized();
    frame.rotation.col(1) = frame.rotation.col(2).cross(frame.rotation.col(0));
    frame.left = mean.inverse();
    frame.right = end.inverse().transpose();
  }
}

void CoupledTangent::Solve(const Matrix3Xd& residual,
                           const Matrix3Xd& constraint_residual,
                           Matrix3Xd* correction,
                           Matrix3Xd* multiplier_correction, WorkTeam* team) {
  const Eigen::Index vectors = structure_->num_vectors();
  const Eigen::Index constraints = structure_->num_constraints();
  Eigen::Map<Matrix3Xd> right_side(right_side_.data(), 3,
                                   vectors + constraints);
  // All as nodes first, then those of bodies again.
  const Matrix3d back = turn_.transpose();
  const auto for_vectors = [vectors, team](const auto& work) {
    const auto range = [&work](size_t /*member*/, size_t first, size_t end) {
      for (size_t v = first; v < end; ++v) work(static_cast<Eigen::Index>(v));
    };
    if (team == nullptr) {
      range(0, 0, static_cast<size_t>(vectors));
    } else {
      team->Run(static_cast<size_t>(vectors), range);
    }
  };
  for_vectors(
      [&](Eigen::Index v) { right_side.col(v) = back * residual.col(v); });
  for (size_t i = 0; i < frames_.size(); ++i) {
    TurnBody(structure_->bodies[i].first, frames_[i].rotation.transpose(),
             frames_[i].left, residual, &right_side);
  }
  right_side.rightCols(constraints) = constraint_residual;
  factor_.Solve(right_side_, &solution_, team);
  const Eigen::Map<const Matrix3Xd> solution(solution_.data(), 3,
                                             vectors + constraints);
  const Matrix3d turn = turn_;
  for_vectors(
      [&](Eigen::Index v) { correction->col(v) = turn * solution.col(v); });
  for (size_t i = 0; i < frames_.size(); ++i) {
    TurnBody(structure_->bodies[i].first, frames_[i].rotation, frames_[i].right,
             solution, correction);
  }
  *multiplier_correction = solution.rightCols(constraints);
}

}  // namespace emmy
