#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"

namespace emmy {
namespace {

class IntegratorOptionsTest : public ::testing::Test {
 protected:
  // The message, or "" if the options are accepted.
  std::string Message(const IntegratorOptions& options) const {
    const auto integrator =
        EnergyMomentumIntegrator::Create(built_.model, options);
    if (integrator.ok()) return "";
    EXPECT_EQ(integrator.status().code(), absl::StatusCode::kInvalidArgument);
    return std::string(integrator.status().message());
  }

  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BuiltModel built_ = *BuildModel(ModelOf(PaperBox()));
};

TEST_F(IntegratorOptionsTest, ATimeStepHasToBeGiven) {
  EXPECT_EQ(
      Message({}),
      "/integrator/time_step: must be a finite number other than 0 [s], got 0");
}

TEST_F(IntegratorOptionsTest, ATimeStepIsFinite) {
  EXPECT_EQ(Message({.time_step = kNan}),
            "/integrator/time_step: must be a finite number other than 0 [s], "
            "got nan");
  EXPECT_EQ(Message({.time_step = kInfinity}),
            "/integrator/time_step: must be a finite number other than 0 [s], "
            "got inf");
}

TEST_F(IntegratorOptionsTest, ThereIsAnIterationAtLeast) {
  EXPECT_EQ(Message({.time_step = 1e-3, .max_iterations = 0}),
            "/integrator/max_iterations: must be at least 1, got 0");
}

TEST_F(IntegratorOptionsTest, ATimeStepMayGoBack) {
  EXPECT_EQ(Message({.time_step = -1e-3}), "");
}

TEST_F(IntegratorOptionsTest, AToleranceIsBetweenZeroAndOne) {
  const std::string expected =
      "/integrator/tolerance: must be \"round_off\" or a number between 0 and "
      "1, got ";
  EXPECT_EQ(Message({.time_step = 1e-3, .tolerance = 0.0}), expected + "0");
  EXPECT_EQ(Message({.time_step = 1e-3, .tolerance = 1.0}), expected + "1");
  EXPECT_EQ(Message({.time_step = 1e-3, .tolerance = -1e-6}),
            expected + "-1e-06");
  EXPECT_EQ(Message({.time_step = 1e-3, .tolerance = kNan}), expected + "nan");
  EXPECT_EQ(Message({.time_step = 1e-3, .tolerance = 1e-6}), "");
}

TEST_F(IntegratorOptionsTest, AnOrderThatIsNotThereIsRejected) {
  const std::string message = Message({.order = 3, .time_step = 1e-3});
  EXPECT_EQ(message.rfind("/integrator/order: must be ", 0), 0U) << message;
  EXPECT_NE(message.find(", got 3"), std::string::npos) << message;
}

// A caller's mistakes, which would read and write beside the state.
TEST_F(IntegratorOptionsTest, AStateOfAnotherModelStopsTheProgram) {
  auto integrator =
      EnergyMomentumIntegrator::Create(built_.model, {.time_step = 1e-3});
  ASSERT_TRUE(integrator.ok());
  State other =
      BuildModel(ModelOf(PaperBox(Formulation::kConventional)))->state;
  EXPECT_DEATH(static_cast<void>(integrator->Step(other)),
               "a state of 7 positions, .* for a model of 12 positions");
  EnergyMomentumIntegrator moved = *std::move(integrator);
  EXPECT_TRUE(moved.Step(built_.state).ok());
  // NOLINTNEXTLINE(bugprone-use-after-move): what is tested.
  EXPECT_DEATH(static_cast<void>(integrator->Step(built_.state)),
               "an integrator that was moved from");
}

}  // namespace
}  // namespace emmy
