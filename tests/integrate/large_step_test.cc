// Steps far beyond what accuracy allows: conserved or refused, never wrong.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/paper_box.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

struct Regime {
  std::string name;
  double penalty;
  double time_step;
  int num_steps;
  double bound;  // Of the relative error of energy.
  friend void PrintTo(const Regime& r, std::ostream* os) { *os << r.name; }
};

std::vector<Regime> Regimes(
    const std::vector<std::array<double, 3>>& steps_and_bounds,
    const std::vector<int>& exponents = {6, 8, 10, 12, 14}) {
  std::vector<Regime> regimes;
  for (const auto& [time_step, num_steps, bound] : steps_and_bounds) {
    for (const int exponent : exponents) {
      regimes.push_back(
          {.name = "Milliseconds" +
                   std::to_string(static_cast<int>(1000.0 * time_step)) +
                   "Penalty1e" + (exponent < 0 ? "Minus" : "") +
                   std::to_string(std::abs(exponent)),
           .penalty = std::pow(10.0, exponent),
           .time_step = time_step,
           .num_steps = static_cast<int>(num_steps),
           .bound = bound});
    }
  }
  return regimes;
}

std::string Name(const ::testing::TestParamInfo<Regime>& regime) {
  return regime.param.name;
}

class LargeStepTest : public ::testing::TestWithParam<Regime> {};

// Rounding of one step is a few u |ω|Δt of the energy, and grows like √n.
TEST_P(LargeStepTest, ConvergesAndConserves) {
  TestRun run(ModelOf(PaperBox(Formulation::kAncf, GetParam().penalty)),
              GetParam().time_step);
  const InvariantMonitor monitor = run.Watch(GetParam().num_steps);
  EXPECT_EQ(run.state().step, GetParam().num_steps);
  EXPECT_LE(monitor.energy().max_relative_error(), GetParam().bound);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), GetParam().bound);
}

INSTANTIATE_TEST_SUITE_P(Regimes, LargeStepTest,
                         ::testing::ValuesIn(Regimes({{0.01, 20000, 2e-15},
                                                      {0.1, 10000, 1e-13},
                                                      {0.5, 2000, 1e-12}})),
                         Name);

class HugeStepTest : public ::testing::TestWithParam<Regime> {};

// |ω|Δt from 1 to 20: beyond any guarantee of a solution that is found.
TEST_P(HugeStepTest, ConvergesToAConservingStepOrLeavesTheStateAndSaysWhere) {
  TestRun run(ModelOf(PaperBox(Formulation::kAncf, GetParam().penalty)),
              GetParam().time_step);
  InvariantMonitor monitor(run.model(), run.state());
  for (int i = 0; i < GetParam().num_steps; ++i) {
    const State before = run.state();
    const StepReport report = run.Step();
    if (report.ok()) {
      EXPECT_TRUE(report.message.empty());
      monitor.Observe(run.state());
      continue;
    }
    EXPECT_TRUE(SameState(run.state(), before));
    EXPECT_NE(report.message.find("step " + std::to_string(i + 1) + " at t = "),
              std::string::npos)
        << report.message;
    EXPECT_NE(report.message.find("\"box\""), std::string::npos)
        << report.message;
    break;
  }
  EXPECT_LE(monitor.energy().max_relative_error(), GetParam().bound);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), GetParam().bound);
}

INSTANTIATE_TEST_SUITE_P(Regimes, HugeStepTest,
                         ::testing::ValuesIn(Regimes({{1.0, 50, 1e-13},
                                                      {2.0, 50, 1e-13},
                                                      {5.0, 50, 1e-13},
                                                      {20.0, 50, 1e-13}},
                                                     {-3, 0, 2, 4, 6, 8, 10, 12,
                                                      14})),
                         Name);

struct SoftRegime {
  std::string name;
  double penalty;        // [Pa]
  double young_modulus;  // [Pa]
  double time_step;      // [s]
  int num_steps;
  friend void PrintTo(const SoftRegime& r, std::ostream* os) { *os << r.name; }
};

class SoftStructureTest : public ::testing::TestWithParam<SoftRegime> {};

// A body softer than what is tied to it: the tangents that do without the exact
// Jacobian gain a twentieth an iteration, or nothing, and what they left of
// moment and work, with one sign, was taken for rounding: energy drifted by
// 1e-10 in some hundred steps. The bound is the one that is promised of a run.
TEST_P(SoftStructureTest, IsNotTakenForRoundingWhereItConvergesSlowly) {
  const SoftRegime& regime = GetParam();
  ModelDescription model = BoxWithTruss(Formulation::kAncf, regime.penalty);
  model.trusses[0].young_modulus = regime.young_modulus;
  TestRun run(model, regime.time_step);
  const InvariantMonitor monitor = run.Watch(regime.num_steps);
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-14);
  EXPECT_LE(monitor.momentum().max_relative_error(), 1e-14);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(
    Regimes, SoftStructureTest,
    ::testing::Values(SoftRegime{"BothSoft", 1e-3, 6.5, 0.08, 300},
                      SoftRegime{"BothSofter", 2.8e-3, 0.0196, 0.14, 200},
                      SoftRegime{"TrussTenThousandTimesStiffer", 1.0, 1e4, 0.03,
                                 150},
                      SoftRegime{"StiffTruss", 1e3, 7e10, 0.03, 300}),
    [](const auto& regime) { return regime.param.name; });

// Where the rounding of one step is more than 1e-8 of the motion, there is no
// step to accept: the laws would be broken by all digits.
TEST(RoundingTest, APenaltyThatDoublesDoNotResolveIsRefused) {
  for (const double penalty : {1e26, 1e36, 1e40, 1e60}) {
    TestRun run(ModelOf(PaperBox(Formulation::kAncf, penalty)), 1e-3);
    const State before = run.state();
    EXPECT_FALSE(run.Step().ok()) << penalty;
    EXPECT_TRUE(SameState(run.state(), before));
  }
}

TEST(RoundingTest, AStepOfMoreTurnsThanDoublesResolveIsRefused) {
  for (const double time_step : {1e9, 1e10, 1e14}) {
    TestRun run(ModelOf(PaperBox(Formulation::kConventional)), time_step);
    const State before = run.state();
    EXPECT_FALSE(run.Step().ok()) << time_step;
    EXPECT_TRUE(SameState(run.state(), before));
  }
}

// A failure on demand: one iteration is never enough.
TEST(FailedStepTest, LeavesEveryBitOfTheStateAndNamesTimeStepAndBody) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    TestRun run(ModelOf(PaperBox(formulation)), 0.1);
    ASSERT_TRUE(run.Advance(10));
    run.SetOptions({.time_step = 0.1, .max_iterations = 1});
    const State before = run.state();
    const StepReport report = run.Step();
    EXPECT_EQ(report.termination, Termination::kMaxIterations);
    EXPECT_TRUE(SameState(run.state(), before));
    for (const char* part :
         {"step 11 at t = 1 s: the iteration does not converge", "\"box\"",
          "time step 0.1 s", "the state is that of the last good step"}) {
      EXPECT_NE(report.message.find(part), std::string::npos) << report.message;
    }
  }
}

TEST(FailedStepTest, OfOneBodyMovesNoOther) {
  RigidBodyDescription fast = PaperBox();
  fast.name = "too fast";
  fast.angular_velocity = {1e200, 1e200, 0.0};
  ModelDescription description = ModelOf(PaperBox());
  description.rigid_bodies.push_back(fast);
  TestRun run(description, 1e-3);
  const State before = run.state();
  const StepReport report = run.Step();
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.message.find("\"too fast\""), std::string::npos)
      << report.message;
  EXPECT_TRUE(SameState(run.state(), before));
}

}  // namespace
}  // namespace emmy
