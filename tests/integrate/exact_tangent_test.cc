// The exact Jacobian against difference quotients of the equations.

#include "emmy/integrate/exact_tangent.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "emmy/integrate/structure_lines.h"
#include "emmy/model/model_builder.h"
#include "tests/support/random_source.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 0.02;

// (EM-9) of a structure without loads, at a random state of start and
// increment: M Δw + Δt f̄, and what its Jacobian depends on.
class Equations {
 public:
  Equations(const Structure& structure, uint64_t seed)
      : structure_(structure), lines_(structure) {
    RandomSource random(seed);
    const Eigen::Index vectors = structure.num_vectors();
    q0_.resize(3, vectors);
    w0_.resize(3, vectors);
    for (Eigen::Index v = 0; v < vectors; ++v) {
      q0_.col(v) = random.Vector(1.0);
      w0_.col(v) = random.Vector(2.0);
    }
    none_.setZero(3, vectors);
    const auto strains =
        static_cast<Eigen::Index>(structure.strain_offsets.size());
    strain0_.resize(strains);
    for (Eigen::Index s = 0; s < strains; ++s) {
      strain0_(s) = random.Uniform(0.05, 0.1);  // Taut, whatever the step.
    }
    no_strain_.setZero(strains);
    increment_.setZero(strains);
    lines_.Load(q0_, none_);
  }

  Matrix3Xd Residual(const Matrix3Xd& dw) {
    dq_ = kTimeStep * (w0_ + 0.5 * dw);
    mean_ = q0_ + 0.5 * dq_;
    Matrix3Xd residual = none_;
    for (const Structure::Mass& mass : structure_.masses) {
      residual.col(mass.row) += mass.mass * dw.col(mass.column);
      if (mass.row != mass.column) {
        residual.col(mass.column) += mass.mass * dw.col(mass.row);
      }
    }
    for (const Structure::Body& body : structure_.bodies) {
      const Matrix3d mean = mean_.middleCols<3>(body.first + 1);
      const Vector6d increment = AncfRigidBody::StrainIncrement(
          mean, dq_.middleCols<3>(body.first + 1));
      increment_.segment<6>(body.first_strain) = increment;
      const Vector6d strain =
          strain0_.segment<6>(body.first_strain) + 0.5 * increment;
      residual.middleCols<3>(body.first + 1) +=
          kTimeStep * body.body->ancf()->InternalForce(mean, strain);
    }
    VectorXd magnitude = VectorXd::Zero(structure_.num_vectors());
    lines_.AddImpulses(kTimeStep, dq_, strain0_, no_strain_, &team_, &residual,
                       &magnitude);
    lines_.AdvanceStrains(dq_, strain0_, no_strain_, &team_, &increment_);
    lines_.Respond(dq_, strain0_, no_strain_);
    return residual;
  }

  // J⁻¹ r at the last Residual.
  Matrix3Xd Solve(const Matrix3Xd& r) const {
    const VectorXd strain = strain0_ + 0.5 * increment_;
    const Matrix3Xd end = q0_ + dq_;
    const Matrix3Xd line_end = lines_.End(dq_);
    Matrix3Xd correction = none_;
    Matrix3Xd multipliers(3, 0);
    EXPECT_TRUE(SolveExactTangent(structure_, kTimeStep,
                                  {mean_, end, strain, lines_.mean(), line_end,
                                   lines_.tension(), lines_.derivative()},
                                  r, Matrix3Xd(3, 0), &correction,
                                  &multipliers));
    return correction;
  }

 private:
  const Structure& structure_;
  StructureLines lines_;
  WorkTeam team_{1};
  Matrix3Xd q0_, w0_, none_, dq_, mean_;
  VectorXd strain0_, no_strain_, increment_;
};

// Two bodies, nodes and lines, without a joint; penalties that let stress,
// mass and stiffness count alike.
ModelDescription Loose() {
  ModelDescription model = Tangle();
  model.shared_points.clear();
  for (RigidBodyDescription& body : model.rigid_bodies) body.penalty = 1e8;
  model.springs.push_back(
      {"tie",
       {BodyPoint{"box", {1.5, 0, 0}}, BodyPoint{"right", {-1.4, 0, 0}}},
       1e6,
       4.0});
  // Long, so that no random state takes one end through the other.
  for (SpringDescription& spring : model.springs) spring.length = 4.0;
  return model;
}

TEST(ExactTangentTest, IsTheDerivativeOfTheEquations) {
  absl::StatusOr<BuiltModel> built = BuildModel(Loose());
  ASSERT_TRUE(built.ok()) << built.status();
  const std::vector<Structure> structures = SplitIntoStructures(built->model);
  ASSERT_EQ(structures.size(), 1U);
  RandomSource random(5);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Equations equations(structures[0], seed);
    Matrix3Xd dw(3, structures[0].num_vectors());
    Matrix3Xd direction(3, structures[0].num_vectors());
    for (Eigen::Index v = 0; v < dw.cols(); ++v) {
      dw.col(v) = random.Vector(1.0);
      direction.col(v) = random.Vector(1.0);
    }
    // Central difference: truncation h² and rounding u / h, both near 1e-10
    // of the residual's derivative at h = 1e-5; a hundred for the condition.
    constexpr double kDifference = 1e-5;
    const Matrix3Xd slope = (equations.Residual(dw + kDifference * direction) -
                             equations.Residual(dw - kDifference * direction)) /
                            (2.0 * kDifference);
    static_cast<void>(equations.Residual(dw));
    EXPECT_LE((equations.Solve(slope) - direction).norm(),
              1e-8 * direction.norm())
        << seed;
  }
}

// Without mass and tension, lines resist along themselves only.
TEST(ExactTangentTest, RefusesASingularJacobian) {
  absl::StatusOr<BuiltModel> built = BuildModel(Loose());
  ASSERT_TRUE(built.ok()) << built.status();
  std::vector<Structure> structures = SplitIntoStructures(built->model);
  Structure& structure = structures[0];
  structure.masses.clear();
  const Matrix3Xd positions = Matrix3Xd::Random(3, structure.num_vectors());
  const auto lines = static_cast<Eigen::Index>(structure.lines.size());
  const Matrix3Xd along = Matrix3Xd::Random(3, lines);
  const VectorXd strain = VectorXd::Zero(
      static_cast<Eigen::Index>(structure.strain_offsets.size()));
  Matrix3Xd correction = positions;
  Matrix3Xd multipliers(3, 0);
  EXPECT_FALSE(SolveExactTangent(structure, kTimeStep,
                                 {positions, positions, strain, along, along,
                                  VectorXd::Zero(lines), VectorXd::Ones(lines)},
                                 positions, Matrix3Xd(3, 0), &correction,
                                 &multipliers));
}

}  // namespace
}  // namespace emmy
