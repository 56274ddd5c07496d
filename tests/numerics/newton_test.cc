#include "emmy/numerics/newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace emmy {
namespace {

constexpr double kFloor = 1e-16;

// None of the corrections ends the iteration.
void ExpectGoesOn(StagnationMonitor monitor,
                  const std::vector<double>& corrections) {
  for (const double correction : corrections) {
    EXPECT_FALSE(monitor.Update(correction, kFloor)) << correction;
  }
}

TEST(StagnationMonitorTest, FirstCorrectionsThatGrowAreNotStagnation) {
  ExpectGoesOn(StagnationMonitor(), {1.0, 2.0, 5.0, 3.0, 4.0, 4.0, 1.0});
}

TEST(StagnationMonitorTest, SlowConvergenceFarAboveTheFloorIsNotStagnation) {
  StagnationMonitor monitor;
  double correction = 1.0;
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(monitor.Update(correction, kFloor)) << correction;
    correction *= 0.9;
  }
}

TEST(StagnationMonitorTest, ShrinkingNearTheFloorGoesOn) {
  ExpectGoesOn(StagnationMonitor(), {1e-10, 1e-13, 1e-14, 1e-15, 1e-16, 1e-17});
}

TEST(StagnationMonitorTest, GainingLessThanABitNearTheFloorIsStagnation) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-15, kFloor));
  EXPECT_FALSE(monitor.Update(2e-16, kFloor));
  EXPECT_TRUE(monitor.Update(1.5e-16, kFloor));
}

// By a twentieth a time: twenty times the last member is left.
TEST(StagnationMonitorTest, SlowConvergenceNearTheFloorIsNotStagnation) {
  StagnationMonitor monitor;
  double correction = 1e3 * kFloor;
  for (; correction > 4.0 * kFloor; correction *= 0.95) {
    EXPECT_FALSE(monitor.Update(correction, kFloor)) << correction;
  }
  EXPECT_TRUE(monitor.Update(correction, kFloor));
}

TEST(StagnationMonitorTest, RoundingAboveItsEstimateEndsWhereItGrows) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-13, kFloor));
  EXPECT_FALSE(monitor.Update(7e-15, kFloor));
  EXPECT_FALSE(monitor.Update(5e-15, kFloor));
  EXPECT_TRUE(monitor.Update(6e-15, kFloor));
}

// A floor of known terms, which rounding exceeds a few times.
TEST(StagnationMonitorTest, OfALawItIsJudgedNearerToTheFloor) {
  StagnationMonitor monitor = StagnationMonitor::OfLaw();
  for (const double work : {2e-14, 3e-14, 3e-14, 7e-15}) {
    EXPECT_FALSE(monitor.Update(work, kFloor)) << work;
  }
  EXPECT_FALSE(monitor.Update(5e-15, kFloor));
  EXPECT_TRUE(monitor.Update(6e-15, kFloor));
}

// The next would be 1e-21: lost in a floor of 1e-16.
TEST(StagnationMonitorTest, ACorrectionThatLeavesLessThanRoundingIsTheLast) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-7, kFloor));
  EXPECT_FALSE(monitor.Update(1e-11, kFloor));
  EXPECT_FALSE(monitor.Update(1e-15, kFloor));  // 1e-19 would follow.
  EXPECT_TRUE(monitor.Update(1e-18, kFloor));
}

// Ratios 1e-10 and 0.45: the first correction hid a slow part.
TEST(StagnationMonitorTest, OneFastRatioDoesNotHideASlowPart) {
  StagnationMonitor monitor;
  double correction = 1e-3;
  EXPECT_FALSE(monitor.Update(correction, kFloor));
  correction = 1e-13;
  for (int i = 0; i < 8; ++i) {
    EXPECT_FALSE(monitor.Update(correction, kFloor)) << correction;
    correction *= 0.45;
  }
}

// The fourth is rounding, twice the floor; without it 1e-18 would have come,
// and 1e-23 next.
TEST(StagnationMonitorTest, AFastSequenceNeedNotConfirmItsRounding) {
  StagnationMonitor monitor(0x1p-10, /*explains_rounding=*/true);
  EXPECT_FALSE(monitor.Update(1e-4, kFloor));
  EXPECT_FALSE(monitor.Update(1e-9, kFloor));
  EXPECT_FALSE(monitor.Update(1e-13, kFloor));
  EXPECT_TRUE(monitor.Update(2e-16, kFloor));
}

// A rate that was 1e-4 and 1e-5 is taken as 1e-4.
TEST(StagnationMonitorTest, SaysWhatAMemberShouldHaveBeen) {
  StagnationMonitor monitor(0x1p-10, /*explains_rounding=*/true);
  (void)monitor.Update(1e-4, kFloor);
  (void)monitor.Update(1e-8, kFloor);
  EXPECT_TRUE(std::isinf(monitor.expected()));
  (void)monitor.Update(1e-13, kFloor);
  EXPECT_TRUE(std::isinf(monitor.expected()));
  (void)monitor.Update(2e-16, kFloor);
  EXPECT_NEAR(monitor.expected(), 1e-17, 1e-23);
}

// Nor is it explained where that was not asked for.
TEST(StagnationMonitorTest, ALawIsSeenToHold) {
  ExpectGoesOn(StagnationMonitor(), {1e-4, 1e-9, 1e-13, 2e-16});
}

// 1e-15 should have come: what is at the floor may not be rounding alone.
TEST(StagnationMonitorTest, RoundingDoesNotEndASlowSequence) {
  ExpectGoesOn(StagnationMonitor(0x1p-10, /*explains_rounding=*/true),
               {1e-12, 1e-13, 1e-14, 1e-16});
}

// Ten floors are not rounding, whatever was to come.
TEST(StagnationMonitorTest, AMemberAboveRoundingIsNotExplainedAway) {
  ExpectGoesOn(StagnationMonitor(0x1p-10, /*explains_rounding=*/true),
               {1e-4, 1e-9, 1e-13, 1e-15});
}

TEST(StagnationMonitorTest, HowMuchMayBeLeftIsSaidAtTheStart) {
  StagnationMonitor monitor(/*negligible=*/0x1p-6);
  EXPECT_FALSE(monitor.Update(1e-7, kFloor));
  EXPECT_FALSE(monitor.Update(1e-11, kFloor));
  EXPECT_TRUE(monitor.Update(1e-15, kFloor));
}

TEST(StagnationMonitorTest, GrowingNearTheFloorIsStagnation) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-16, kFloor));
  EXPECT_TRUE(monitor.Update(3e-16, kFloor));
}

TEST(StagnationMonitorTest, OneCorrectionAloneIsNotStagnation) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-18, kFloor));
}

TEST(StagnationMonitorTest, StaysStagnantWhateverFollows) {
  StagnationMonitor monitor;
  EXPECT_FALSE(monitor.Update(1e-16, kFloor));
  EXPECT_TRUE(monitor.Update(1e-16, kFloor));
  EXPECT_TRUE(monitor.Update(1e-17, kFloor));
  EXPECT_TRUE(monitor.Update(1.0, kFloor));
}

TEST(StagnationMonitorTest, AZeroCorrectionIsTheEndEvenWithoutAFloor) {
  StagnationMonitor monitor;
  EXPECT_TRUE(monitor.Update(0.0, 0.0));
}

TEST(StagnationMonitorTest, NotANumberIsNeverStagnation) {
  StagnationMonitor monitor;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(monitor.Update(kNan, kFloor));
  EXPECT_FALSE(monitor.Update(kNan, kFloor));
}

TEST(StepReportTest, IsPessimisticUntilShownOtherwise) {
  EXPECT_FALSE(StepReport{}.ok());
  EXPECT_EQ(StepReport{}.termination, Termination::kMaxIterations);
}

TEST(NewtonOptionsTest, DefaultIsRoundOff) {
  EXPECT_FALSE(NewtonOptions{}.tolerance.has_value());
}

}  // namespace
}  // namespace emmy
