#include "verification/baselines/integrators.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "emmy/numerics/unit_roundoff.h"

namespace emmy::verification {
namespace {

// q̈ + Ω² q = 0.
ElasticSystem Oscillator(double frequency) {
  ElasticSystem system;
  system.mass = MatrixXd::Identity(1, 1);
  system.strains.push_back({.quadratic = MatrixXd::Zero(1, 1),
                            .linear = VectorXd::Ones(1),
                            .constant = 0.0,
                            .stiffness = frequency * frequency});
  return system;
}

Motion Start(const ElasticSystem& system, double q, double w) {
  return StartMotion(system, VectorXd::Constant(1, q),
                     VectorXd::Constant(1, w));
}

using Step = std::function<StepReport(const ElasticSystem&, double, Motion*)>;

Step Alpha(const GeneralizedAlpha& parameters) {
  return [parameters](const ElasticSystem& system, double dt, Motion* motion) {
    return StepGeneralizedAlpha(system, dt, parameters, motion);
  };
}

struct NamedStep {
  const char* name;
  Step step;
};

class IntegratorTest : public ::testing::TestWithParam<NamedStep> {};

TEST_P(IntegratorTest, IsOfOrderTwoOnAnOscillator) {
  const ElasticSystem system = Oscillator(1.0);
  const auto error = [&](double dt) {
    Motion motion = Start(system, 1.0, 0.5);
    const int64_t steps = std::lround(2.0 / dt);
    for (int64_t i = 0; i < steps; ++i) {
      EXPECT_TRUE(GetParam().step(system, dt, &motion).ok());
    }
    return std::abs(motion.position(0) - std::cos(2.0) - 0.5 * std::sin(2.0));
  };
  // The next terms are dt and dt² of the first: 1 % at 0.01.
  EXPECT_NEAR(error(0.01) / error(0.005), 4.0, 0.05);
}

TEST_P(IntegratorTest, LeavesTheMotionAloneIfItRunsAway) {
  const ElasticSystem system = Oscillator(1.0);
  Motion motion = Start(system, 1e308, 1e308);
  EXPECT_FALSE(GetParam().step(system, 1e3, &motion).ok());
  EXPECT_EQ(motion.position(0), 1e308);
}

INSTANTIATE_TEST_SUITE_P(
    All, IntegratorTest,
    ::testing::Values(
        NamedStep{"Newmark", Alpha(GeneralizedAlpha::AverageAcceleration())},
        NamedStep{"GeneralizedAlpha",
                  Alpha(GeneralizedAlpha::WithSpectralRadius(0.8))},
        NamedStep{"Midpoint", StepMidpoint}, NamedStep{"Verlet", StepVerlet}),
    [](const auto& step) { return std::string(step.param.name); });

// (1/2) w² + (1/2) Ω² q² is an invariant of the trapezoidal rule and of the
// midpoint rule where forces are linear: rounding, at worst u a step.
TEST(NewmarkTest, KeepsTheEnergyOfAnOscillator) {
  constexpr int kSteps = 1000;
  const ElasticSystem system = Oscillator(7.0);
  for (const Step& step :
       {Alpha(GeneralizedAlpha::AverageAcceleration()), Step(StepMidpoint)}) {
    Motion motion = Start(system, 1.0, 0.0);
    for (int i = 0; i < kSteps; ++i) {
      ASSERT_TRUE(step(system, 0.3, &motion).ok());
    }
    const double energy = 0.5 * motion.velocity.squaredNorm() +
                          PotentialEnergy(system, motion.position);
    EXPECT_NEAR(energy, 24.5, 24.5 * 8 * kSteps * kUnitRoundoff);
  }
}

// The largest eigenvalue of the map of (q, Δt w, Δt² a) over a step.
double SpectralRadius(const Step& step, double omega_dt) {
  const ElasticSystem system = Oscillator(omega_dt);
  Eigen::Matrix3d map;
  for (int k = 0; k < 3; ++k) {
    Vector3d unit = Vector3d::Unit(k);
    Motion motion{VectorXd::Constant(1, unit(0)),
                  VectorXd::Constant(1, unit(1)),
                  VectorXd::Constant(1, unit(2))};
    EXPECT_TRUE(step(system, 1.0, &motion).ok());
    map.col(k) = Vector3d(motion.position(0), motion.velocity(0),
                          motion.acceleration(0));
  }
  return Eigen::EigenSolver<Eigen::Matrix3d>(map)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

TEST(GeneralizedAlphaTest, DampsTheFastestVibrationsByTheSpectralRadius) {
  for (const double rho : {0.2, 0.5, 0.8, 1.0}) {
    const Step step = Alpha(GeneralizedAlpha::WithSpectralRadius(rho));
    // Three eigenvalues meet at -rho, and part as the cube root of what is
    // left: (Omega dt)^-2 = 1e-10 and rounding.
    EXPECT_NEAR(SpectralRadius(step, 1e5), rho, 2e-3) << rho;
  }
}

TEST(GeneralizedAlphaTest, NeverAmplifiesAVibration) {
  const Step step = Alpha(GeneralizedAlpha::WithSpectralRadius(0.8));
  double previous = 1.0;
  for (const double omega_dt : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    const double radius = SpectralRadius(step, omega_dt);
    EXPECT_LT(radius, previous) << omega_dt;
    previous = radius;
  }
}

TEST(VerletTest, IsStableBelowTwoOverOmegaAndUnstableAbove) {
  const auto largest = [](double omega_dt) {
    const ElasticSystem system = Oscillator(omega_dt);
    Motion motion = Start(system, 1.0, 0.0);
    double size = 0.0;
    for (int i = 0; i < 1000; ++i) {
      EXPECT_TRUE(StepVerlet(system, 1.0, &motion).ok());
      size = std::max(size, std::abs(motion.position(0)));
    }
    return size;
  };
  // q² (1 − ¼ Ω²Δt²) + w²/Ω² is kept: from rest q does not grow.
  EXPECT_LE(largest(1.999), 1.0 + 1e-9);
  // cosh μ = ½ Ω²Δt² − 1: a factor exp(0.063) a step.
  EXPECT_GT(largest(2.001), 1e20);
}

}  // namespace
}  // namespace emmy::verification
