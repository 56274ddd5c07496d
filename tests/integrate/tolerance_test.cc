// What a loose tolerance costs, to the last digit.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/support/paper_box.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kNumSteps = 500;

// Work r·w̄ of the residual that a step from `before` to `after` has left,
// with (EM-2) in 100 digits.
Wide ResidualWork(const AncfRigidBody& body, const State& before,
                  const State& after, double time_step) {
  const WideMatrix3 e0 = ToWideColumns(before.position, 3);
  const WideMatrix3 w0 = ToWideColumns(before.velocity, 3);
  const WideMatrix3 w1 = ToWideColumns(after.velocity, 3);
  const WideMatrix3 mean = (e0 + ToWideColumns(after.position, 3)) / 2;
  const WideVector6 strain =
      (ToWide<6>(before.strain, 0) + ToWide<6>(after.strain, 0)) / 2;
  WideMatrix3 residual = (w1 - w0) * body.second_moment().cast<Wide>();
  for (int i = 0; i < 3; ++i) {
    const int n = (i + 1) % 3;
    const Wide normal = Wide(body.penalty_stiffness()(i)) * strain(i);
    const Wide shear = Wide(body.penalty_stiffness()(3 + i)) * strain(3 + i);
    residual.col(i) +=
        Wide(time_step) * (normal * mean.col(i) + shear * mean.col(n));
    residual.col(n) += Wide(time_step) * shear * mean.col(i);
  }
  return residual.cwiseProduct((w0 + w1) / 2).sum();
}

struct Drift {
  double energy;         // E_N − E_0 [J]
  double residual_work;  // Σ r·w̄
};

Drift RunWithTolerance(std::optional<double> tolerance) {
  constexpr double kTimeStep = 0.01;
  TestRun run(
      ModelOf(PaperBox(Formulation::kAncf, 1e8)),
      IntegratorOptions{.time_step = kTimeStep, .tolerance = tolerance});
  const DoubleDouble start =
      MeasureInvariants(run.model(), run.state()).TotalEnergy();
  Wide work = 0;
  for (int i = 0; i < kNumSteps; ++i) {
    const State before = run.state();
    if (!run.Advance(1)) break;
    work += ResidualWork(*run.model().bodies()[0].ancf(), before, run.state(),
                         kTimeStep);
  }
  const DoubleDouble end =
      MeasureInvariants(run.model(), run.state()).TotalEnergy();
  return {(end - start).ToDouble(), ToDouble(work)};
}

class ToleranceTest : public ::testing::TestWithParam<double> {};

// (EM-7), as sharp at a loose tolerance as at a tight one: what remains is
// the rounding of Δe and Δε, 8 u of the energy that passes through a step.
TEST_P(ToleranceTest, EnergyDriftIsTheWorkOfTheResidual) {
  const Drift drift = RunWithTolerance(GetParam());
  EXPECT_NEAR(
      drift.energy, drift.residual_work,
      RandomWalkBound(kNumSteps, RoundoffBound(8, 0.01 * kPaperBoxEnergy)));
}

INSTANTIATE_TEST_SUITE_P(Tolerances, ToleranceTest,
                         ::testing::Values(1e-2, 1e-4, 1e-6, 1e-9));

TEST(ToleranceDriftTest, ALooseToleranceLosesEnergyAndTheDefaultDoesNot) {
  const double roundoff =
      RandomWalkBound(kNumSteps, RoundoffBound(8, 0.01 * kPaperBoxEnergy));
  EXPECT_GT(std::abs(RunWithTolerance(1e-2).energy), 1e6 * roundoff);
  EXPECT_LE(std::abs(RunWithTolerance(std::nullopt).energy), roundoff);
}

TEST(ToleranceIterationsTest, ALooseToleranceNeedsFewerIterations) {
  const auto iterations = [](std::optional<double> tolerance) {
    TestRun run(ModelOf(PaperBox()),
                IntegratorOptions{.time_step = 1e-3, .tolerance = tolerance});
    EXPECT_TRUE(run.Advance(10));
    return run.Step().iterations;
  };
  EXPECT_LT(iterations(1e-6), iterations(std::nullopt));
}

}  // namespace
}  // namespace emmy
