#include "emmy/diagnostics/angular_velocity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "emmy/numerics/rotation.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kTrials = 50;

// R̃ of (ATT-1) in 100 digits.
WideMatrix3 WidePolarRotation(const WideMatrix3& f) {
  WideMatrix3 x = f;
  for (int i = 0; i < 60; ++i) {
    const WideMatrix3 next = (x + x.inverse().transpose()) / 2;
    const double change = MaxAbs(next - x);
    x = next;
    if (change < 1e-60) break;
  }
  return x;
}

Matrix3d RandomDeformed(RandomSource& random, double strain) {
  return QuaternionToMatrix(random.UnitQuaternion()) *
         (Matrix3d::Identity() + random.Entries<Matrix3d>(strain));
}

// Inverting a 3×3 matrix of condition near 1: some 60 operations.
TEST(AngularVelocityTest, OfARotatingBodyAllThreeAreItsAngularVelocity) {
  RandomSource random(20250501);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d r = QuaternionToMatrix(random.UnitQuaternion());
    const Vector3d omega = random.Vector(3.0);
    const Matrix3d rates = Hat(omega) * r;
    const PolarDecomposition polar = DecomposePolar(r);
    const double bound = RoundoffBound(100, omega.norm());
    EXPECT_LE((PolarAngularVelocity(polar, rates) - omega).norm(), bound);
    EXPECT_LE((ExactPolarAngularVelocity(polar, rates) - omega).norm(), bound);
    // J has a condition of 2.6.
    EXPECT_LE(
        (LockedAngularVelocity(PaperBoxInertia().second_moment, r, rates) -
         omega)
            .norm(),
        3.0 * bound);
  }
}

// (ATT-3): axial(dR̃/dt R̃ᵀ) by a central difference in 100 digits, step
// 1e-30, truncation 1e-60.
Vector3d SpinOfPolarRotation(const Matrix3d& r, const Matrix3d& rates) {
  const Wide h("1e-30");
  const WideMatrix3 wide = r.cast<Wide>();
  const WideMatrix3 rate = rates.cast<Wide>();
  const WideMatrix3 difference = (WidePolarRotation(wide + rate * h) -
                                  WidePolarRotation(wide - rate * h)) /
                                 (2 * h);
  const WideMatrix3 spin = difference * WidePolarRotation(wide).transpose();
  return WideVector3((spin(2, 1) - spin(1, 2)) / 2,
                     (spin(0, 2) - spin(2, 0)) / 2,
                     (spin(1, 0) - spin(0, 1)) / 2)
      .cast<double>();
}

TEST(AngularVelocityTest, ExactPolarIsTheSpinOfTheAttitude) {
  RandomSource random(20250502);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d r = RandomDeformed(random, 0.3);
    const auto rates = random.Entries<Matrix3d>(2.0);
    const Vector3d omega = ExactPolarAngularVelocity(DecomposePolar(r), rates);
    // tr(U) 1 − U is at least 2 (1 − 0.9) for these strains.
    EXPECT_LE((omega - SpinOfPolarRotation(r, rates)).norm(),
              RoundoffBound(100, 10.0 * rates.norm()))
        << "trial " << trial;
  }
}

// What separates (ATT-2) from (ATT-3), and shows that the check above tells.
TEST(AngularVelocityTest, PolarOfADeformedBodyIsNotTheSpinOfTheAttitude) {
  RandomSource random(20250503);
  const Matrix3d r = RandomDeformed(random, 0.3);
  const auto rates = random.Entries<Matrix3d>(2.0);
  const Vector3d omega = PolarAngularVelocity(DecomposePolar(r), rates);
  EXPECT_GT((omega - SpinOfPolarRotation(r, rates)).norm(), 1e-3);
}

// A symmetric Ṙ R⁻¹ that commutes with U: a pure stretching has no spin.
TEST(AngularVelocityTest, PureStretchingHasNoPolarSpin) {
  RandomSource random(20250504);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d q = QuaternionToMatrix(random.UnitQuaternion());
    const Matrix3d r = q * Vector3d(1.1, 0.9, 1.3).asDiagonal() * q.transpose();
    const Matrix3d rates = q * random.Vector(2.0).asDiagonal() * q.transpose();
    const PolarDecomposition polar = DecomposePolar(r);
    EXPECT_LE(PolarAngularVelocity(polar, rates).norm(),
              RoundoffBound(100, 4.0));
    EXPECT_LE(ExactPolarAngularVelocity(polar, rates).norm(),
              RoundoffBound(100, 4.0));
  }
}

// (ATT-4): J(e) ω = Mⁱʲ eᵢ × ėⱼ, checked by the definition with a body of six
// particles at ± √(Mⁱⁱ / 2m) along the axes.
TEST(AngularVelocityTest, LockedOmegaTimesTheLockedInertiaIsTheMomentum) {
  RandomSource random(20250505);
  const Matrix3d moment = PaperBoxInertia().second_moment;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d e = RandomDeformed(random, 0.3);
    const auto rates = random.Entries<Matrix3d>(2.0);
    const Vector3d omega = LockedAngularVelocity(moment, e, rates);
    Vector3d momentum = Vector3d::Zero();
    Vector3d locked = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      momentum += moment(i, i) * e.col(i).cross(rates.col(i));
      locked += moment(i, i) * e.col(i).cross(omega.cross(e.col(i)));
    }
    EXPECT_LE((locked - momentum).norm(),
              RoundoffBound(100, 20.0 * moment.trace() * rates.norm()));
  }
}

// A vibration that carries no angular momentum does not show.
TEST(AngularVelocityTest, LockedDoesNotSeeAVibrationWithoutMomentum) {
  RandomSource random(20250506);
  const Matrix3d moment = PaperBoxInertia().second_moment;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d r = QuaternionToMatrix(random.UnitQuaternion());
    const Vector3d omega = random.Vector(2.0);
    // Mⁱʲ eᵢ × δėⱼ = 0 for δṘ M = R S with a symmetric S.
    const auto s = random.Entries<Matrix3d>(1000.0);
    const Matrix3d vibration = r * (s + s.transpose()) * moment.inverse();
    const Matrix3d rates = Hat(omega) * r + vibration;
    EXPECT_LE((LockedAngularVelocity(moment, r, rates) - omega).norm(),
              RoundoffBound(200, rates.norm()));
    EXPECT_GT((PolarAngularVelocity(DecomposePolar(r), rates) - omega).norm(),
              1e-4);
  }
}

}  // namespace
}  // namespace emmy
