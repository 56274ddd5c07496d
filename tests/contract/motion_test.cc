// Motions that are known: the parabola, the steady spin, the order in Δt.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "emmy/numerics/rotation.h"
#include "tests/contract/motions.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

class KnownMotionTest : public ::testing::TestWithParam<Formulation> {
 protected:
  RigidBodyDescription Box() const { return PaperBox(GetParam(), 1e12); }
};

// x̄ₙ = x̄₀ + v₀ t + ½ g t² for the trapezoidal rule too. All numbers here are
// short in binary, so that no operation rounds.
TEST_P(KnownMotionTest, CentreOfMassUnderGravityIsOnTheParabolaInEveryBit) {
  ModelDescription description = ModelOf(Box());
  description.gravity = {0.25, 0.0, -9.75};
  description.rigid_bodies[0].position = {1.0, -2.0, 3.5};
  description.rigid_bodies[0].velocity = {0.5, 4.0, 12.0};
  TestRun run(description, 0x1p-10);
  for (int64_t n = 1; n <= 2000; ++n) {
    ASSERT_TRUE(run.Advance(1));
    const double t = static_cast<double>(n) * 0x1p-10;
    const Vector3d expected = description.rigid_bodies[0].position +
                              t * description.rigid_bodies[0].velocity +
                              (0.5 * t * t) * description.gravity;
    ASSERT_EQ(run.Motion().position, expected) << "step " << n;
  }
}

// A step and numbers that round: v errs by u |g| t, x̄ by the like.
TEST_P(KnownMotionTest, CentreOfMassUnderGravityIsOnTheParabolaToRoundoff) {
  ModelDescription description = ModelOf(Box());
  description.gravity = {0.1, 0.0, -9.81};
  description.rigid_bodies[0].velocity = {0.3, 4.1, 12.7};
  TestRun run(description, 0.01);
  constexpr int64_t kNumSteps = 2000;
  ASSERT_TRUE(run.Advance(kNumSteps));
  const double t = 20.0;
  const double path = 13.5 * t + 0.5 * 9.82 * t * t;
  const Vector3d expected = t * description.rigid_bodies[0].velocity +
                            (0.5 * t * t) * description.gravity;
  EXPECT_LE((run.Motion().position - expected).norm(), RoundoffBound(8, path));
}

TEST_P(KnownMotionTest, EnergyIsKeptUnderGravity) {
  ModelDescription description = ModelOf(Box());
  description.gravity = {0.1, 0.0, -9.81};
  description.rigid_bodies[0].velocity = {0.3, 4.1, 12.7};
  TestRun run(description, 0.01);
  const EnergyRecord energy = run.Watch(2000).energy();
  // g·Δx̄ and v̄·Δv are rounded by 4 u each, of a kinetic energy that is
  // exchanged as a whole; the sum is linear at worst.
  EXPECT_LE(energy.max_error, RoundoffBound(8, 2.0 * energy.scale));
  EXPECT_TRUE(energy.conserved);
}

// An ANCF body spinning about a principal axis breathes with the strain
// M ω²/b, and its axis stays; a conventional body does not change at all.
TEST_P(KnownMotionTest, SpinAboutAPrincipalAxisStays) {
  for (int axis = 0; axis < 3; ++axis) {
    RigidBodyDescription body = Box();
    body.angular_velocity = 2.0 * Vector3d::Unit(axis);
    TestRun run(ModelOf(body), 0.01);
    ASSERT_TRUE(run.Advance(1000));
    const Vector3d omega = run.Motion().omega_locked;
    const double strain = GetParam() == Formulation::kAncf
                              ? 12150.0 * 4.0 / (kPaperBoxVolume * 1e12)
                              : 0.0;
    EXPECT_NEAR(omega(axis), 2.0, 8.0 * strain + RoundoffBound(32, 2.0));
    for (int other = 1; other < 3; ++other) {
      EXPECT_EQ(omega((axis + other) % 3), 0.0);
    }
  }
}

// Three step sizes, halved twice; the body is stiff and starts relaxed, so
// that its vibration (1e-8 in ω) stays far below the error of the step.
TEST_P(KnownMotionTest, ConvergesWithTheSecondOrder) {
  RigidBodyDescription body = Box();
  if (GetParam() == Formulation::kAncf) body.start = Start::kRelaxed;
  constexpr double kTime = 4.0;
  using Vector12d = Eigen::Matrix<double, 12, 1>;
  const auto end = [&body](int num_steps) {
    TestRun run(ModelOf(body), kTime / num_steps);
    EXPECT_TRUE(run.Advance(num_steps));
    Vector12d result;
    const Matrix3d attitude = QuaternionToMatrix(run.Motion().quaternion);
    result << Eigen::Map<const Vector9d>(attitude.data()),
        run.Motion().omega_locked;
    return result;
  };
  const Vector12d coarse = end(100);
  const Vector12d middle = end(200);
  const Vector12d fine = end(400);
  const double order =
      std::log2((coarse - middle).norm() / (middle - fine).norm());
  EXPECT_GE(order, 1.95);
  EXPECT_LE(order, 2.05);
  // The step lags by (|ω|Δt)²/12 of each angle: of that size, not smaller by
  // a wrong formula that happens to be of second order too.
  const double lag = 0.98 * kTime * std::pow(0.98 * kTime / 100, 2) / 12.0;
  EXPECT_LT((coarse - middle).norm(), 3.0 * lag);
  EXPECT_GT((coarse - middle).norm(), lag / 3.0);
}

// A forward Euler step of Euler's equations, as a method of first order, is
// rejected by the same rule.
TEST(KnownMotionOrderTest, AFirstOrderMethodIsNotOfTheSecond) {
  const auto end = [](int num_steps) {
    const Matrix3d j = PaperBoxInertia().tensor;
    Vector3d w = PaperBoxOmega();
    for (int i = 0; i < num_steps; ++i) {
      const Vector3d torque = (j * w).cross(w);
      w += (4.0 / num_steps) * torque.cwiseQuotient(j.diagonal());
    }
    return w;
  };
  const double order =
      std::log2((end(100) - end(200)).norm() / (end(200) - end(400)).norm());
  EXPECT_LT(order, 1.2);
}

INSTANTIATE_TEST_SUITE_P(Formulations, KnownMotionTest,
                         ::testing::Values(Formulation::kAncf,
                                           Formulation::kConventional),
                         [](const auto& formulation) {
                           return formulation.param == Formulation::kAncf
                                      ? "Ancf"
                                      : "Conventional";
                         });

}  // namespace
}  // namespace emmy
