#include "emmy/io/case.h"

#include <gtest/gtest.h>

namespace emmy {
namespace {

int64_t Steps(double duration, double time_step) {
  IntegratorSettings settings;
  settings.duration = duration;
  settings.time_step = time_step;
  return NumberOfSteps(settings);
}

TEST(NumberOfStepsTest, CountsWholeStepsInSpiteOfRounding) {
  EXPECT_EQ(Steps(10.0, 1e-3), 10000);
  EXPECT_EQ(Steps(0.3, 0.1), 3);  // 0.3 / 0.1 = 3 - 2 u in double.
  EXPECT_EQ(Steps(0.7, 0.1), 7);
  EXPECT_EQ(Steps(2.2, 1.1), 2);
  for (int n = 1; n <= 100000; ++n) {
    ASSERT_EQ(Steps(n * 1e-3, 1e-3), n);
    ASSERT_EQ(Steps(n / 60.0, 1.0 / 60.0), n);
  }
}

TEST(NumberOfStepsTest, ReachesADurationThatIsNotAWholeNumberOfSteps) {
  EXPECT_EQ(Steps(1.0, 0.3), 4);
  EXPECT_EQ(Steps(1e-9, 1.0), 1);
  EXPECT_EQ(Steps(1.0 + 1e-12, 1e-3), 1001);
}

TEST(NumberOfStepsTest, CountsUpToTheLargestNumber) {
  EXPECT_EQ(Steps(kMaxSteps, 1.0), int64_t{1} << 53);
}

TEST(OptionsOfTest, AreTheSettingsAndTheThreads) {
  IntegratorSettings settings;
  settings.order = 4;
  settings.time_step = 0.25;
  settings.tolerance = 1e-6;
  const IntegratorOptions options = OptionsOf(settings, 3);
  EXPECT_EQ(options.order, 4);
  EXPECT_EQ(options.time_step, 0.25);
  EXPECT_EQ(options.tolerance, 1e-6);
  EXPECT_EQ(options.num_threads, 3);
}

TEST(OptionsOfTest, GoToRoundOffOnOneThreadUnlessTold) {
  const IntegratorOptions options = OptionsOf(IntegratorSettings());
  EXPECT_FALSE(options.tolerance.has_value());
  EXPECT_EQ(options.num_threads, 1);
}

}  // namespace
}  // namespace emmy
