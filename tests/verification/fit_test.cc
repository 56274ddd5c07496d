#include "verification/runs/fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emmy::verification {
namespace {

TEST(FitPowerTest, FindsTheExponentOfAPower) {
  const std::vector<double> x = {1.0, 2.0, 8.0, 100.0};
  std::vector<double> y;
  for (const double value : x) y.push_back(3.0 * std::pow(value, -0.5));
  EXPECT_NEAR(FitPower(x, y), -0.5, 1e-15);
}

TEST(FitPowerTest, IsTheLeastSquaresLineOfLogarithms) {
  // ln y = 0, 1, 0 at ln x = 0, 1, 3: slope of (x - 4/3)(y - 1/3) / Sxx.
  const double e = std::exp(1.0);
  EXPECT_NEAR(FitPower({1.0, e, e * e * e}, {1.0, e, 1.0}), -1.0 / 14.0, 1e-15);
}

TEST(FitPowerTest, IsNanWithoutALine) {
  EXPECT_TRUE(std::isnan(FitPower({1.0}, {1.0})));
  EXPECT_TRUE(std::isnan(FitPower({1.0, 1.0}, {1.0, 2.0})));
  EXPECT_TRUE(std::isnan(FitPower({1.0, 2.0}, {0.0, 1.0})));
  EXPECT_TRUE(std::isnan(FitPower({1.0, 2.0}, {1.0, std::nan("")})));
}

TEST(PercentileTest, IsTheSmallestValueThatEnoughDoNotExceed) {
  EXPECT_EQ(Percentile({5, 1, 4, 2, 3, 10, 9, 8, 7, 6}, 0.9), 9.0);
  EXPECT_EQ(Percentile({3, 1, 2}, 1.0), 3.0);
  EXPECT_EQ(Percentile({3, 1, 2}, 0.01), 1.0);
}

TEST(PowersOfTenTest, IncludesBothEnds) {
  EXPECT_EQ(PowersOfTen(6, 10, 2), (std::vector<double>{1e6, 1e8, 1e10}));
}

}  // namespace
}  // namespace emmy::verification
