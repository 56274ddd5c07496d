// Two equal moments: the elliptic closed form agrees with the elementary one.

#include "verification/exact/symmetric_top.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/exact/equation_residual.h"
#include "tests/exact/regimes.h"

namespace emmy::exact {
namespace {

SymmetricTop<Quad> MakeTop(double axial_moment) {
  return {.transverse_moment = 1,
          .axial_moment = axial_moment,
          .attitude = RotationFromQuaternion(Vector4<Quad>(3, -1, 2, 5)),
          .body_angular_velocity = Vector3<Quad>(0.25, -0.5, 1)};
}

FreeRigidBody<Quad> MakeBodyOf(const SymmetricTop<Quad>& top, int axis) {
  // The symmetry axis is e₃ for the top; here any of the three, by a cyclic
  // renaming of the body axes, column i of `names` being the top's axis.
  Matrix3<Quad> names = Matrix3<Quad>::Zero();
  for (int i = 0; i < 3; ++i) names((i + 3 - 2 + axis) % 3, i) = 1;
  const Vector3<Quad> moments(top.transverse_moment, top.transverse_moment,
                              top.axial_moment);
  FreeRigidBodyStart<Quad> start;
  start.inertia = names * moments.asDiagonal() * names.transpose();
  start.attitude = top.attitude * names.transpose();
  start.angular_velocity = names * top.body_angular_velocity;
  return FreeRigidBody<Quad>::Create(start).value();
}

class SymmetricTopTest : public ::testing::TestWithParam<double> {};

TEST_P(SymmetricTopTest, AgreesWithTheEllipticSolutionForEachAxis) {
  const SymmetricTop<Quad> top = MakeTop(GetParam());
  for (const int axis : {0, 1, 2}) {
    const FreeRigidBody<Quad> body = MakeBodyOf(top, axis);
    for (const double time : {0.0, 0.3, -2.0, 50.0, 1e5}) {
      const auto expected = SymmetricTopAt(top, Quad(time));
      const auto actual = body.At(Quad(time));
      const Quad bound = 8 * UnitRoundoff<Quad>() * (1 + 3 * std::abs(time));
      const Vector3<Quad> axis_error =
          actual.attitude.col(axis) - expected.attitude.col(2);
      EXPECT_LE(axis_error.cwiseAbs().maxCoeff(), bound) << axis << time;
      const Vector3<Quad> next_error =
          actual.attitude.col((axis + 1) % 3) - expected.attitude.col(0);
      EXPECT_LE(next_error.cwiseAbs().maxCoeff(), bound) << axis << time;
      const Vector3<Quad> omega_error =
          actual.angular_velocity - expected.angular_velocity;
      EXPECT_LE(omega_error.cwiseAbs().maxCoeff(), 2 * bound) << axis << time;
    }
  }
}

TEST_P(SymmetricTopTest, SatisfiesTheEquationsOfMotion) {
  const SymmetricTop<Quad> top = MakeTop(GetParam());
  const Vector3<Quad> moments(1, 1, top.axial_moment);
  const EquationResidual residual(moments.asDiagonal(), Quad(4));
  for (const double time : {0.0, 1.0, -7.0}) {
    EXPECT_LE(residual([&top](const Quad& t) { return SymmetricTopAt(top, t); },
                       Quad(time)),
              residual.Bound(Quad(time), 4));
  }
}

// Prolate, nearly a sphere from both sides, a sphere, oblate, nearly a disc.
INSTANTIATE_TEST_SUITE_P(AxialMoments, SymmetricTopTest,
                         ::testing::Values(0.01, 0.5, 1 - 0x1p-50, 1.0,
                                           1 + 0x1p-50, 1.5, 1.999));

TEST(SymmetricTopPeriodTest, BodyAngularVelocityTurnsAtTheClosedRate) {
  // s = ω₃ (I − J₃) / I = −½ rad/s.
  const SymmetricTop<Quad> top = MakeTop(1.5);
  const Quad turn = 4 * boost::math::constants::pi<Quad>();
  using std::abs;
  EXPECT_LE(abs(Quad(*MakeBodyOf(top, 2).Period() - turn)), 1e-31);
}

}  // namespace
}  // namespace emmy::exact
