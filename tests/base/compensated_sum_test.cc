#include "emmy/base/compensated_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {
namespace {

constexpr int kTrials = 20000;

// Multiples of 2⁻⁴⁰ below 2⁶²: their sum is exact in 128-bit integers.
__extension__ using Integer = __int128;
Integer InUnits(double x) { return static_cast<Integer>(std::ldexp(x, 40)); }

TEST(TwoSumTest, SumAndErrorAddUpExactly) {
  RandomSource random(20250101);
  for (int trial = 0; trial < kTrials; ++trial) {
    // 53 bits below 2⁶² down to 2⁻⁴⁰ at the least.
    const double a = random.Magnitude(0x1p13, 0x1p61);
    const double b = random.Magnitude(0x1p13, 0x1p61);
    const SumAndError result = TwoSum(a, b);
    EXPECT_EQ(result.sum, a + b);
    EXPECT_EQ(InUnits(result.sum) + InUnits(result.error),
              InUnits(a) + InUnits(b))
        << "trial " << trial << ": " << a << " + " << b;
  }
}

TEST(TwoSumTest, DoesNotDependOnTheOrder) {
  RandomSource random(20250102);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double a = random.Magnitude(1e-300, 1e300);
    const double b = random.Magnitude(1e-300, 1e300);
    const SumAndError ab = TwoSum(a, b);
    const SumAndError ba = TwoSum(b, a);
    EXPECT_EQ(ab.sum, ba.sum);
    EXPECT_EQ(ab.error, ba.error);
  }
}

TEST(TwoSumTest, KeepsWhatAnAdditionDrops) {
  const SumAndError result = TwoSum(1e16, 1.0);
  EXPECT_EQ(result.sum, 1e16);
  EXPECT_EQ(result.error, 1.0);
}

// x₀ + n d by repeated addition, in units of 2⁻⁹⁰ to compare exactly.
struct RepeatedSum {
  double start;
  double increment;
  int64_t count;

  // Distance of `value + compensation` from the exact sum; all differences
  // here are exact or rounded relative to themselves.
  double Error(const CompensatedDouble& sum) const {
    // n·d exactly, as a pair, for n < 2²⁶ by splitting d.
    const double high = std::round(increment * 0x1p50) * 0x1p-50;
    const double low = increment - high;
    const auto n = static_cast<double>(count);
    return (((sum.value - start) - n * high) + sum.compensation) - n * low;
  }
};

// (SUM-2): each addition rounds increment + compensation once, by u |d| and
// not by u |x|; 10⁶ of them in a random direction. For d = 1e-9, x = 1.
TEST(CompensatedDoubleTest, AMillionSmallStepsLoseOnlyTheirOwnRounding) {
  const RepeatedSum sum{.start = 1.0, .increment = 1e-9, .count = 1000000};
  CompensatedDouble total{.value = sum.start};
  for (int64_t i = 0; i < sum.count; ++i) total.Add(sum.increment);
  // The compensation is up to u |x|, so increment + compensation is rounded
  // by u (|d| + u |x|).
  const double bound = RandomWalkBound(
      sum.count, RoundoffBound(1, sum.increment + kUnitRoundoff));
  EXPECT_LE(std::abs(sum.Error(total)), bound);
  // The same checker rejects the plain sum: 8e-14 against a bound of 7e-22.
  CompensatedDouble plain{.value = sum.start};
  for (int64_t i = 0; i < sum.count; ++i) plain.value += sum.increment;
  EXPECT_GT(std::abs(sum.Error(plain)), 1e6 * bound);
}

TEST(CompensatedDoubleTest, CompensationIsAtMostHalfAUnitOfTheValue) {
  RandomSource random(20250103);
  CompensatedDouble sum;
  for (int trial = 0; trial < kTrials; ++trial) {
    sum.Add(random.Magnitude(1e-12, 1e3));
    EXPECT_LE(std::abs(sum.compensation), kUnitRoundoff * std::abs(sum.value));
  }
}

TEST(CompensatedDoubleTest, AddingAndTakingAwayTheSameComesBack) {
  CompensatedDouble sum{.value = 1.0};
  for (int i = 0; i < 1000; ++i) sum.Add(0x1p-70);
  for (int i = 0; i < 1000; ++i) sum.Add(-0x1p-70);
  EXPECT_EQ(sum.value, 1.0);
  EXPECT_EQ(sum.compensation, 0.0);
}

TEST(CompensatedVectorTest, AddsToTheGivenSegmentOnly) {
  CompensatedVector v;
  v.SetZero(5);
  v.Add(1, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(v.value, (VectorXd(5) << 0.0, 1.0, 2.0, 3.0, 0.0).finished());
  EXPECT_EQ(v.compensation, VectorXd(VectorXd::Zero(5)));
}

TEST(CompensatedVectorTest, EachEntryIsACompensatedDouble) {
  RandomSource random(20250104);
  CompensatedVector v;
  v.SetZero(3);
  std::array<CompensatedDouble, 3> entries;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d increment = random.Vector(1.0);
    v.Add(0, increment);
    for (int i = 0; i < 3; ++i) {
      entries[static_cast<size_t>(i)].Add(increment(i));
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(v.value(i), entries[static_cast<size_t>(i)].value);
    EXPECT_EQ(v.compensation(i), entries[static_cast<size_t>(i)].compensation);
  }
}

}  // namespace
}  // namespace emmy
