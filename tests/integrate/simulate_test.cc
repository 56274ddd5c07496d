#include "emmy/integrate/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

class SimulateTest : public ::testing::Test {
 protected:
  EnergyMomentumIntegrator Integrator(const IntegratorOptions& options) {
    return EnergyMomentumIntegrator::Create(built_.model, options).value();
  }
  EnergyMomentumIntegrator Integrator() {
    return Integrator({.time_step = 0.125});
  }

  BuiltModel built_ = *BuildModel(ModelOf(PaperBox()));
};

TEST_F(SimulateTest, ObserverSeesEveryStepAfterItIsDone) {
  EnergyMomentumIntegrator integrator = Integrator();
  std::vector<int64_t> steps;
  const SimulationReport report = Simulate(
      integrator, built_.state, 4,
      [&](const State& state, const StepReport& step) {
        EXPECT_EQ(&state, &built_.state);
        EXPECT_TRUE(step.ok());
        EXPECT_EQ(state.time.value, 0.125 * static_cast<double>(state.step));
        steps.push_back(state.step);
        return true;
      });
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(steps, (std::vector<int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(report.steps, 4);
  EXPECT_FALSE(report.stopped_by_observer);
}

TEST_F(SimulateTest, ObserverThatReturnsFalseEndsTheRunAfterThatStep) {
  EnergyMomentumIntegrator integrator = Integrator();
  const SimulationReport report = Simulate(
      integrator, built_.state, 100,
      [](const State& state, const StepReport&) { return state.step < 3; });
  EXPECT_TRUE(report.ok());
  EXPECT_TRUE(report.stopped_by_observer);
  EXPECT_EQ(report.steps, 3);
  EXPECT_EQ(built_.state.step, 3);
}

TEST_F(SimulateTest, RunsWithoutAnObserver) {
  EnergyMomentumIntegrator integrator = Integrator();
  EXPECT_EQ(Simulate(integrator, built_.state, 5, nullptr).steps, 5);
}

TEST_F(SimulateTest, ZeroStepsLeaveTheState) {
  EnergyMomentumIntegrator integrator = Integrator();
  const State before = built_.state;
  const SimulationReport report =
      Simulate(integrator, built_.state, 0, nullptr);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.mean_iterations(), 0.0);
  EXPECT_TRUE(SameState(built_.state, before));
}

TEST_F(SimulateTest, CountsIterations) {
  EnergyMomentumIntegrator integrator = Integrator();
  int64_t total = 0;
  int most = 0;
  const SimulationReport report = Simulate(
      integrator, built_.state, 10, [&](const State&, const StepReport& step) {
        total += step.iterations;
        most = std::max(most, step.iterations);
        return true;
      });
  EXPECT_EQ(report.total_iterations, total);
  EXPECT_EQ(report.max_iterations, most);
  EXPECT_EQ(report.mean_iterations(), static_cast<double>(total) / 10.0);
}

TEST_F(SimulateTest, AFailedStepEndsTheRunWithItsMessageAndIsNotObserved) {
  EnergyMomentumIntegrator integrator =
      Integrator({.time_step = 0.125, .max_iterations = 1});
  const State before = built_.state;
  int observed = 0;
  const SimulationReport report = Simulate(
      integrator, built_.state, 10, [&](const State&, const StepReport&) {
        ++observed;
        return true;
      });
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.termination, Termination::kMaxIterations);
  EXPECT_EQ(report.steps, 0);
  EXPECT_EQ(observed, 0);
  EXPECT_NE(report.message.find("step 1 at t = 0 s"), std::string::npos)
      << report.message;
  EXPECT_TRUE(SameState(built_.state, before));
}

// A run cut in two is the run, bit for bit: a state holds all that matters.
TEST_F(SimulateTest, ARunInTwoPartsIsTheWholeRun) {
  BuiltModel whole = built_;
  EnergyMomentumIntegrator one =
      EnergyMomentumIntegrator::Create(whole.model, {.time_step = 0.125})
          .value();
  ASSERT_TRUE(Simulate(one, whole.state, 50, nullptr).ok());
  EnergyMomentumIntegrator first = Integrator();
  ASSERT_TRUE(Simulate(first, built_.state, 20, nullptr).ok());
  EnergyMomentumIntegrator second = Integrator();
  ASSERT_TRUE(Simulate(second, built_.state, 30, nullptr).ok());
  EXPECT_TRUE(SameState(built_.state, whole.state));
}

}  // namespace
}  // namespace emmy
