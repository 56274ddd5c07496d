#include "emmy/element/ancf_rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "emmy/numerics/rotation.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kTrials = 100;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

AncfRigidBody MakeBody() {
  Vector6d penalty;
  penalty << 1e4, 3e5, 2e6, 7e4, 5e5, 1e7;
  return *AncfRigidBody::Create(PaperBoxInertia(), penalty);
}

// (ANCF-5) of the vectors, independently of the code under test.
Wide Energy(const Vector6d& b, const WideMatrix3& e) {
  Wide energy = 0;
  const int n[3] = {1, 2, 0};
  for (int i = 0; i < 3; ++i) {
    const Wide normal = (Wide(e.col(i).dot(e.col(i))) - 1) / 2;
    const Wide shear = e.col(i).dot(e.col(n[i]));
    energy += Wide(b(i)) * normal * normal / 2;
    energy += Wide(b(3 + i)) * shear * shear / 2;
  }
  return energy;
}

TEST(AncfRigidBodyTest, StiffnessIsVolumeTimesPenalty) {
  EXPECT_EQ(PaperBoxElement(1e10).penalty_stiffness(),
            Vector6d::Constant(6e10));
}

TEST(AncfRigidBodyTest, ARotationHasNoStrain) {
  RandomSource random(20250311);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d r = QuaternionToMatrix(random.UnitQuaternion());
    EXPECT_LE(AncfRigidBody::Strain(r).cwiseAbs().maxCoeff(),
              RoundoffBound(24, 1.0));
  }
}

TEST(AncfRigidBodyTest, StrainsAreStretchAndShearInTheOrderOfThePaper) {
  Matrix3d e;
  e.col(0) << 2, 0, 0;
  e.col(1) << 0.5, 1, 0;
  e.col(2) << 0.25, 0.125, 1;
  Vector6d expected;
  // ε₁, ε₂, ε₃; e₁·e₂, e₂·e₃, e₃·e₁.
  expected << 1.5, 0.125, 0.0390625, 1.0, 0.25, 0.5;
  EXPECT_EQ(AncfRigidBody::Strain(e), expected);
}

TEST(AncfRigidBodyTest, EnergyIsHalfStiffnessTimesSquaredStrain) {
  const AncfRigidBody body = MakeBody();
  RandomSource random(20250312);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto e = random.Entries<Matrix3d>(2.0);
    const WideMatrix3 wide = e.cast<Wide>();
    const double energy = body.PenaltyEnergy(AncfRigidBody::Strain(e));
    // Strains of size up to 12 rounded by 5 u, squared, times b.
    EXPECT_NEAR(energy, ToDouble(Energy(body.penalty_stiffness(), wide)),
                RoundoffBound(18, 144.0 * body.penalty_stiffness().sum()));
  }
}

// Central differences in 100 digits: step 1e-30, truncation 1e-60.
TEST(AncfRigidBodyTest, ForceIsTheGradientOfTheEnergy) {
  const AncfRigidBody body = MakeBody();
  RandomSource random(20250313);
  const Wide h("1e-30");
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto e = random.Entries<Matrix3d>(2.0);
    const Matrix3d force = body.InternalForce(e, AncfRigidBody::Strain(e));
    for (int k = 0; k < 9; ++k) {
      WideMatrix3 plus = e.cast<Wide>();
      WideMatrix3 minus = plus;
      plus(k) += h;
      minus(k) -= h;
      const Wide gradient = (Energy(body.penalty_stiffness(), plus) -
                             Energy(body.penalty_stiffness(), minus)) /
                            (2 * h);
      // Three terms b ε e, ε ≤ 12 in size and rounded by 5 u, e ≤ 2.
      EXPECT_NEAR(force(k), ToDouble(gradient),
                  RoundoffBound(9, 24.0 * body.penalty_stiffness().sum()))
          << "entry " << k << ", trial " << trial;
    }
  }
}

// The check above sees two shear stresses exchanged.
TEST(AncfRigidBodyTest, ExchangedShearStressesWouldNotBeTheGradient) {
  const AncfRigidBody body = MakeBody();
  RandomSource random(20250314);
  const auto e = random.Entries<Matrix3d>(2.0);
  const Vector6d strain = AncfRigidBody::Strain(e);
  Vector6d wrong = strain;
  std::swap(wrong(3), wrong(4));
  EXPECT_GT((body.InternalForce(e, wrong) - body.InternalForce(e, strain))
                .cwiseAbs()
                .maxCoeff(),
            1e6 * RoundoffBound(9, 24.0 * body.penalty_stiffness().sum()));
}

TEST(AncfRigidBodyTest, InertiaAndMassArePassedOn) {
  const AncfRigidBody body = MakeBody();
  EXPECT_EQ(body.mass(), kPaperBoxMass);
  EXPECT_EQ(body.second_moment(), PaperBoxInertia().second_moment);
}

TEST(AncfRigidBodyCreateTest, RejectsAPenaltyThatIsNotPositiveAndNamesIt) {
  for (const auto& [value, text] :
       {std::pair(0.0, "0"), std::pair(-2.5, "-2.5"), std::pair(kNan, "nan"),
        std::pair(kInfinity, "inf")}) {
    for (int k = 0; k < 6; ++k) {
      Vector6d penalty = Vector6d::Constant(1e10);
      penalty(k) = value;
      const auto body = AncfRigidBody::Create(PaperBoxInertia(), penalty);
      ASSERT_FALSE(body.ok());
      EXPECT_EQ(body.status().code(), absl::StatusCode::kInvalidArgument);
      EXPECT_EQ(body.status().message(),
                "penalty/" + std::to_string(k) +
                    ": must be a finite number > 0 [Pa], got " + text);
    }
  }
}

}  // namespace
}  // namespace emmy
