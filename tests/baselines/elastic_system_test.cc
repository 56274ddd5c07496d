#include "verification/baselines/elastic_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/random_source.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

BuiltModel Build(const ModelDescription& description) {
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  EXPECT_TRUE(built.ok()) << built.status();
  return *std::move(built);
}

// The box with its truss, strained and moving at random.
struct Sample {
  BuiltModel built = Build(PaperTrussAncf(1e8));
  ElasticSystem system = *SystemOfModel(built.model);
  VectorXd q = built.state.position.value;
  VectorXd w = built.state.velocity.value;

  Sample() {
    RandomSource random(7);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q(i) += random.Uniform(-0.1, 0.1);
      w(i) = random.Uniform(-1.0, 1.0);
    }
  }
};

TEST(ElasticSystemTest, HasTheMassOfTheModel) {
  Sample sample;
  sample.built.state.velocity.value = sample.w;
  const double energy =
      MeasureInvariants(sample.built.model, sample.built.state)
          .kinetic_energy.ToDouble();
  EXPECT_NEAR(0.5 * sample.w.dot(sample.system.mass * sample.w), energy,
              100 * kUnitRoundoff * energy);
}

TEST(ElasticSystemTest, HasTheForcesOfTheLibrarysElements) {
  const Sample sample;
  const AncfRigidBody& body = *sample.built.model.bodies()[0].ancf();
  const Matrix3d gradients = Eigen::Map<const Matrix3d>(sample.q.data() + 3);
  VectorXd force = VectorXd::Zero(15);
  Eigen::Map<Matrix3d>(force.data() + 3) =
      body.InternalForce(gradients, AncfRigidBody::Strain(gradients));
  const ModelLine& line = sample.built.model.lines()[0];
  Vector3d d = line.difference.ground;
  for (const WeightedVector& term : line.difference.terms) {
    d += term.weight * sample.q.segment<3>(3 * term.vector);
  }
  const double length = line.element.natural_length();
  const double strain = 0.5 * (d.squaredNorm() / (length * length) - 1.0);
  // With no increment, the tension factor is that of the instant.
  const double tension = line.element.Respond(strain, 0.0, 0.0).tension_factor;
  for (const WeightedVector& term : line.difference.terms) {
    force.segment<3>(3 * term.vector) += term.weight * tension * d;
  }
  EXPECT_NEAR(
      (InternalForce(sample.system, sample.q) - force).cwiseAbs().maxCoeff(),
      0.0, 100 * kUnitRoundoff * force.cwiseAbs().maxCoeff());
}

TEST(ElasticSystemTest, ForceIsTheSlopeOfTheEnergyAndStiffnessOfTheForce) {
  const Sample sample;
  const VectorXd force = InternalForce(sample.system, sample.q);
  const MatrixXd stiffness = Stiffness(sample.system, sample.q);
  // Differences of polynomials of degree four and three, extrapolated once,
  // are exact; what is left is rounding over h.
  constexpr double kH = 0.01;
  for (Eigen::Index i = 0; i < sample.q.size(); ++i) {
    const VectorXd unit = VectorXd::Unit(sample.q.size(), i);
    const auto slope = [&](double h) {
      return (PotentialEnergy(sample.system, sample.q + h * unit) -
              PotentialEnergy(sample.system, sample.q - h * unit)) /
             (2.0 * h);
    };
    const auto force_slope = [&](double h) -> VectorXd {
      return (InternalForce(sample.system, sample.q + h * unit) -
              InternalForce(sample.system, sample.q - h * unit)) /
             (2.0 * h);
    };
    const double scale = stiffness.cwiseAbs().maxCoeff();
    EXPECT_NEAR((4.0 * slope(kH) - slope(2.0 * kH)) / 3.0, force(i),
                100 * kUnitRoundoff * scale / kH);
    const VectorXd column =
        (4.0 * force_slope(kH) - force_slope(2.0 * kH)) / 3.0;
    EXPECT_NEAR((column - stiffness.col(i)).cwiseAbs().maxCoeff(), 0.0,
                100 * kUnitRoundoff * scale / kH);
  }
}

// Shear of the two shortest edges: Ω² = 12 α/ρ (1/a₂² + 1/a₃²).
TEST(ElasticSystemTest, HighestFrequencyOfTheBoxIsThatOfItsShear) {
  const BuiltModel built = Build(PaperBoxAncf(1e8));
  const ElasticSystem system = *SystemOfModel(built.model);
  EXPECT_NEAR(HighestFrequency(system, built.state.position.value),
              std::sqrt(12.0 * 1e8 / 2700.0 * 1.25), 1e-10);
}

TEST(ElasticSystemTest, SaysWhatItDoesNotCover) {
  EXPECT_EQ(SystemOfModel(Build(PaperBoxConventional()).model).status().code(),
            absl::StatusCode::kUnimplemented);
  ModelDescription falling = PaperBoxAncf(1e8);
  falling.gravity = {0.0, 0.0, -9.81};
  EXPECT_EQ(SystemOfModel(Build(falling).model).status().code(),
            absl::StatusCode::kUnimplemented);
}

}  // namespace
}  // namespace emmy::verification
