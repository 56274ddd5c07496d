#include "emmy/diagnostics/watched_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

using ::testing::HasSubstr;

constexpr double kTimeStep = 1.0;

// At 1 Pa the box turns inside out within some steps of a second.
class WatchedRunTest : public ::testing::Test {
 protected:
  SimulationReport Run(int64_t num_steps, const Observer& observer) {
    return WatchedRun(integrator_, built_.model, built_.state, num_steps,
                      monitor_, observer);
  }

  BuiltModel built_ =
      BuildModel(ModelOf(PaperBox(Formulation::kAncf, 1.0))).value();
  EnergyMomentumIntegrator integrator_ =
      EnergyMomentumIntegrator::Create(built_.model, {.time_step = kTimeStep})
          .value();
  InvariantMonitor monitor_{built_.model, built_.state};
};

TEST_F(WatchedRunTest, MakesTheStepsOfSimulate) {
  int64_t seen = 0;
  const SimulationReport report = Run(10, [&](const State& state, const auto&) {
    EXPECT_EQ(state.step, ++seen);
    return true;
  });
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.steps, 10);
  EXPECT_EQ(seen, 10);
  TestRun same(ModelOf(PaperBox(Formulation::kAncf, 1.0)), kTimeStep);
  ASSERT_TRUE(same.Advance(10));
  EXPECT_TRUE(SameState(same.state(), built_.state));
  EXPECT_GT(monitor_.energy().max_error, 0.0);
}

TEST_F(WatchedRunTest, AnObserverMayEndIt) {
  const SimulationReport report =
      Run(10, [](const State& state, const auto&) { return state.step < 3; });
  EXPECT_TRUE(report.ok());
  EXPECT_TRUE(report.stopped_by_observer);
  EXPECT_EQ(built_.state.step, 3);
}

TEST_F(WatchedRunTest, EndsWithTheLastStateThatIsSound) {
  State last = built_.state;
  const SimulationReport report =
      Run(100, [&](const State& state, const auto&) {
        last = state;
        return true;
      });
  EXPECT_EQ(report.termination, Termination::kUnsound);
  EXPECT_FALSE(report.stopped_by_observer);
  EXPECT_GT(report.steps, 0);
  EXPECT_EQ(report.steps, built_.state.step);
  EXPECT_TRUE(SameState(built_.state, last));
  const std::string step = std::to_string(report.steps + 1);
  EXPECT_THAT(report.message,
              HasSubstr("step " + step + " at t = " +
                        std::to_string(report.steps) + " s: body \"box\" has"));
  EXPECT_THAT(report.message, HasSubstr("that of the last good step"));
  // The monitor has not seen what was taken back.
  EXPECT_LT(monitor_.energy().max_relative_error(), 1e-13);
}

}  // namespace
}  // namespace emmy
