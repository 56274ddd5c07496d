#include "verification/claim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "absl/status/status.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Claim SampleClaim(double lower, double upper) {
  Claim claim;
  claim.id = "group/name";
  claim.unit = "J";
  claim.bound = {.lower = lower, .upper = upper, .derivation = "for a test"};
  return claim;
}

Outcome JudgeValues(const Claim& claim, std::vector<MetricValue> values) {
  return Judge(
      claim, Level::kQuick,
      ClaimResult{.values = std::move(values), .figures = {}, .notes = {}});
}

TEST(JudgeTest, PassesOnlyIfEveryValueKeepsTheBound) {
  const Claim claim = SampleClaim(-1.0, 1.0);
  EXPECT_TRUE(JudgeValues(claim, {{"a", -1.0}, {"b", 1.0}}).pass);
  const Outcome outcome = JudgeValues(claim, {{"a", 0.0}, {"b", 1.5}});
  EXPECT_FALSE(outcome.pass);
  EXPECT_EQ(outcome.worst.label, "b");
  EXPECT_THAT(outcome.failure, HasSubstr("b: 1.5 J, bound -1 ... 1"));
}

TEST(JudgeTest, FailsOnNanWhereverItStands) {
  const Claim claim = SampleClaim(-1.0, 1.0);
  for (const auto& values : {std::vector<MetricValue>{{"a", kNan}, {"b", 0.0}},
                             std::vector<MetricValue>{{"a", 0.0}, {"b", kNan}},
                             std::vector<MetricValue>{{"a", kNan}}}) {
    const Outcome outcome = JudgeValues(claim, values);
    EXPECT_FALSE(outcome.pass);
    EXPECT_TRUE(std::isnan(outcome.margin));
    EXPECT_TRUE(std::isnan(outcome.worst.value));
  }
}

TEST(JudgeTest, FailsIfNothingWasMeasured) {
  const Outcome outcome = JudgeValues(SampleClaim(-1.0, 1.0), {});
  EXPECT_FALSE(outcome.pass);
  EXPECT_EQ(outcome.failure, "nothing was measured");
}

TEST(JudgeTest, FailsWithTheMessageOfAMeasurementThatCouldNotBeMade) {
  const Outcome outcome = Judge(SampleClaim(-1.0, 1.0), Level::kFull,
                                absl::AbortedError("step 7 failed"));
  EXPECT_FALSE(outcome.pass);
  EXPECT_EQ(outcome.failure, "step 7 failed");
}

TEST(MarginTest, IsThePartOfTheBoundThatIsLeft) {
  EXPECT_EQ(Margin({.lower = 1.0, .upper = 3.0, .derivation = ""}, 2.0), 1.0);
  EXPECT_EQ(Margin({.lower = 1.0, .upper = 3.0, .derivation = ""}, 2.5), 0.5);
  EXPECT_EQ(Margin({.lower = 1.0, .upper = 3.0, .derivation = ""}, 4.0), -1.0);
  Bound upper;
  upper.upper = 4.0;
  EXPECT_EQ(Margin(upper, 1.0), 0.75);
  EXPECT_EQ(Margin(upper, 4.0), 0.0);
  EXPECT_EQ(Margin(upper, 8.0), -1.0);
  upper.upper = 0.0;
  EXPECT_EQ(Margin(upper, 0.0), 0.0);
  EXPECT_LT(Margin(upper, 1.0), 0.0);
  EXPECT_TRUE(std::isnan(Margin(upper, kNan)));
}

TEST(ClaimTest, KnowsItsGroupAndTheCommandThatRepeatsIt) {
  const Claim claim = SampleClaim(0.0, 1.0);
  EXPECT_EQ(claim.group(), "group");
  EXPECT_EQ(claim.command(), "emmy verify --only group/name");
}

}  // namespace
}  // namespace emmy::verification
