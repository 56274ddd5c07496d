// Stored runs repeat bit for bit: with g++ and clang++, optimised or not.
//
// Nothing here writes. If a change is intended, `emmy regenerate` does, and
// the commit message says how much moved and why.

#include "verification/reference/regression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "verification/reference/reference_table.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RegressionTest : public ::testing::TestWithParam<RegressionRun> {
 protected:
  static ReferenceTable Stored() {
    absl::StatusOr<ReferenceTable> stored =
        ReadReference(RegressionPath(EMMY_SOURCE_DIR, GetParam().name));
    EXPECT_TRUE(stored.ok()) << stored.status();
    return stored.ok() ? *std::move(stored) : ReferenceTable();
  }
};

TEST_P(RegressionTest, RepeatsBitForBit) {
  const ReferenceTable stored = Stored();
  const absl::StatusOr<ReferenceTable> now =
      GetParam().compute(EnergyMomentumScheme);
  ASSERT_TRUE(now.ok()) << now.status();
  EXPECT_THAT(DescribeDifference(stored, *now), IsEmpty())
      << "if the change is intended, run: " << stored.command;
}

TEST_P(RegressionTest, SaysWhatItIsAndHowItWasMade) {
  const ReferenceTable stored = Stored();
  EXPECT_EQ(stored.kind, "regression");
  EXPECT_EQ(stored.name, GetParam().name);
  EXPECT_THAT(stored.command, HasSubstr(GetParam().name));
  EXPECT_THAT(stored.compiler, Not(IsEmpty()));
  EXPECT_THAT(stored.version, Not(IsEmpty()));
  EXPECT_GE(stored.rows.size(), 21U);
}

// Wrong on purpose: after 1000 steps one angular rate moves by one unit in
// the last place.
absl::StatusOr<StepFunction> OneUlpOff(const Model& model,
                                       const IntegratorOptions& options) {
  absl::StatusOr<StepFunction> step = EnergyMomentumScheme(model, options);
  if (!step.ok()) return step.status();
  return StepFunction([step = *std::move(step)](State& state) {
    StepReport report = step(state);
    if (state.step == 1000) {
      double& rate = state.velocity.value(3);
      rate = std::nextafter(rate, 2.0);
    }
    return report;
  });
}

TEST_P(RegressionTest, OneUlpInOneRateIsSeen) {
  const absl::StatusOr<ReferenceTable> wrong = GetParam().compute(OneUlpOff);
  ASSERT_TRUE(wrong.ok()) << wrong.status();
  EXPECT_THAT(DescribeDifference(Stored(), *wrong), HasSubstr("of 21 numbers"));
}

INSTANTIATE_TEST_SUITE_P(Runs, RegressionTest,
                         ::testing::ValuesIn(RegressionRuns()),
                         [](const auto& run) { return run.param.name; });

}  // namespace
}  // namespace emmy::verification
