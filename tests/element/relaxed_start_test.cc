#include "emmy/element/relaxed_start.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>

#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

AncfRigidBody TiltedBody() {
  Matrix3d tensor;
  tensor << 3.0, 0.2, -0.1,  //
      0.2, 4.0, 0.3,         //
      -0.1, 0.3, 5.0;
  Vector6d penalty;
  penalty << 1e6, 2e6, 3e6, 4e6, 5e6, 6e6;
  return *AncfRigidBody::Create(
      *RigidBodyInertia::FromTensor(10.0, tensor, 0.5), penalty);
}

// Mⁱʲ aⱼ + fᵢ of the undeformed body with the relaxed strain, in body axes,
// where aⱼ is the acceleration of a rigid body: zero but for rounding.
Matrix3d Imbalance(const AncfRigidBody& body, const Vector3d& omega) {
  const Matrix3d& j = body.inertia().tensor;
  const Vector3d rate = -(j.inverse() * omega.cross(j * omega));
  Matrix3d acceleration;
  for (int k = 0; k < 3; ++k) {
    const Vector3d e = Vector3d::Unit(k);
    acceleration.col(k) = omega.cross(omega.cross(e)) + rate.cross(e);
  }
  return acceleration * body.second_moment() +
         body.InternalForce(Matrix3d::Identity(), RelaxedStrain(body, omega));
}

// The inverse of a well-conditioned 3×3 J costs some 40 operations.
double ImbalanceBound(const AncfRigidBody& body, const Vector3d& omega) {
  return RoundoffBound(80, body.inertia().tensor.trace() * omega.squaredNorm());
}

TEST(RelaxedStrainTest, ForceBalancesTheRigidBodyAcceleration) {
  RandomSource random(20250331);
  for (const AncfRigidBody& body : {PaperBoxElement(), TiltedBody()}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vector3d omega = random.Vector(2.0);
      EXPECT_LE(Imbalance(body, omega).cwiseAbs().maxCoeff(),
                ImbalanceBound(body, omega))
          << "trial " << trial;
    }
  }
}

// The check sees a body without strain, as it starts undeformed.
TEST(RelaxedStrainTest, WithoutStrainTheAccelerationIsNotBalanced) {
  const AncfRigidBody body = TiltedBody();
  const Vector3d omega(0.3, 0.5, 0.8);
  const Matrix3d force =
      body.InternalForce(Matrix3d::Identity(), RelaxedStrain(body, omega));
  const double gap = (Imbalance(body, omega) - force).cwiseAbs().maxCoeff();
  EXPECT_GT(gap, 1e10 * ImbalanceBound(body, omega));
}

TEST(RelaxedStrainTest, IsZeroAtRest) {
  EXPECT_EQ(RelaxedStrain(PaperBoxElement(), Vector3d::Zero()),
            Vector6d(Vector6d::Zero()));
}

TEST(RelaxedStrainTest, SpinAboutAPrincipalAxisStretchesAcrossIt) {
  const AncfRigidBody box = PaperBoxElement(1e8);
  const Vector6d strain = RelaxedStrain(box, {0.0, 0.0, 2.0});
  Vector6d expected = Vector6d::Zero();
  // εᵢ = Mⁱⁱ ω² / bᵢ for the two axes that turn.
  expected(0) = 12150.0 * 4.0 / 6e8;
  expected(1) = 5400.0 * 4.0 / 6e8;
  EXPECT_LE((strain - expected).cwiseAbs().maxCoeff(),
            RoundoffBound(8, expected(0)));
}

class StretchOfStrainTest : public ::testing::TestWithParam<double> {};

// (ANCF-9) sums some 12 extended operations of up to 7 u².
TEST_P(StretchOfStrainTest, StretchHasThatStrainToThirtyDigits) {
  RandomSource random(20250332);
  const double bound = 100.0 * kUnitRoundoff * kUnitRoundoff;
  for (int trial = 0; trial < 20; ++trial) {
    const auto strain = random.Entries<Vector6d>(GetParam());
    const auto stretch = StretchOfStrain(strain);
    ASSERT_TRUE(stretch.ok()) << stretch.status();
    const WideMatrix3 u = ToWide(*stretch);
    for (int i = 0; i < 3; ++i) {
      const Wide normal = (Wide(u.col(i).dot(u.col(i))) - 1) / 2;
      const Wide shear = u.col(i).dot(u.col((i + 1) % 3));
      EXPECT_LE(MaxAbs(WideVector3(normal - strain(i), shear - strain(3 + i),
                                   Wide(0))),
                bound);
    }
    EXPECT_LE(MaxAbs(u - u.transpose()), bound);
    EXPECT_GT(ToDouble(Wide(u.determinant())), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, StretchOfStrainTest,
                         ::testing::Values(0.0, 1e-12, 1e-6, 1e-2, 0.19));

TEST(StretchOfStrainRangeTest, AcceptsTheLargestUniaxialStrains) {
  Vector6d strain = Vector6d::Zero();
  for (const double value : {0.399, -0.399}) {
    strain(1) = value;
    EXPECT_TRUE(StretchOfStrain(strain).ok()) << value;
  }
}

TEST(StretchOfStrainRangeTest, RejectsStrainsBeyondTheFixedPointAndShowsThem) {
  Vector6d strain = Vector6d::Zero();
  strain(0) = 0.5;
  const auto stretch = StretchOfStrain(strain);
  ASSERT_FALSE(stretch.ok());
  EXPECT_EQ(stretch.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(stretch.status().message(),
            "a relaxed start needs strains below 0.4, got up to 0.5");
}

}  // namespace
}  // namespace emmy
