#include "emmy/base/double_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr int kTrials = 2000;
constexpr double kSquare = kUnitRoundoff * kUnitRoundoff;  // u² = 2⁻¹⁰⁶

DoubleDouble RandomNumber(RandomSource& random, double low, double high) {
  const double hi = random.Magnitude(low, high);
  // Any low part up to half a unit of the high one.
  return FastNormalize(hi, hi * kUnitRoundoff * random.Uniform(-0.5, 0.5));
}

double RelativeError(const DoubleDouble& result, const Wide& exact) {
  return ToDouble(abs(Wide((ToWide(result) - exact) / exact)));
}

bool IsNormalized(const DoubleDouble& x) { return x.hi + x.lo == x.hi; }

TEST(TwoProductTest, ProductAndErrorAreTheExactProduct) {
  RandomSource random(20250111);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double a = random.Magnitude(1e-130, 1e130);
    const double b = random.Magnitude(1e-130, 1e130);
    const SumAndError result = TwoProduct(a, b);
    EXPECT_EQ(result.sum, a * b);
    EXPECT_EQ(Wide(result.sum) + Wide(result.error), Wide(a) * Wide(b))
        << "trial " << trial;
  }
}

// The bounds are those of Joldes, Muller and Popescu for the same algorithms
// (sum 3u², product 7u² without a fused multiply-add), and twice as much for
// the quotient's and the root's second correction, which is dropped.
TEST(DoubleDoubleTest, SumErrsByThreeSquaredUnits) {
  RandomSource random(20250112);
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble x = RandomNumber(random, 1e-3, 1e3);
    const DoubleDouble y = RandomNumber(random, 1e-3, 1e3);
    const DoubleDouble sum = x + y;
    EXPECT_LE(RelativeError(sum, ToWide(x) + ToWide(y)), 3.0 * kSquare * 1.01);
    EXPECT_TRUE(IsNormalized(sum));
  }
}

// Cancellation of the leading parts: the bound stays relative to the result.
TEST(DoubleDoubleTest, DifferenceOfNeighboursErrsByThreeSquaredUnits) {
  RandomSource random(20250113);
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble x = RandomNumber(random, 1.0, 2.0);
    const DoubleDouble y = x + DoubleDouble(random.Magnitude(1e-25, 1e-10));
    const Wide exact = ToWide(x) - ToWide(y);
    if (exact == 0) continue;
    EXPECT_LE(RelativeError(x - y, exact), 3.0 * kSquare * 1.01);
  }
}

TEST(DoubleDoubleTest, ProductErrsBySevenSquaredUnits) {
  RandomSource random(20250114);
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble x = RandomNumber(random, 1e-100, 1e100);
    const DoubleDouble y = RandomNumber(random, 1e-100, 1e100);
    const DoubleDouble product = x * y;
    EXPECT_LE(RelativeError(product, ToWide(x) * ToWide(y)), 7.0 * kSquare);
    EXPECT_TRUE(IsNormalized(product));
  }
}

TEST(DoubleDoubleTest, QuotientErrsByFifteenSquaredUnits) {
  RandomSource random(20250115);
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble x = RandomNumber(random, 1e-100, 1e100);
    const DoubleDouble y = RandomNumber(random, 1e-100, 1e100);
    EXPECT_LE(RelativeError(x / y, ToWide(x) / ToWide(y)), 15.0 * kSquare);
  }
}

TEST(DoubleDoubleTest, SquareRootErrsByFifteenSquaredUnits) {
  RandomSource random(20250116);
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble y = RandomNumber(random, 1e-100, 1e100);
    const DoubleDouble x = y.hi < 0.0 ? -y : y;
    EXPECT_LE(RelativeError(Sqrt(x), sqrt(ToWide(x))), 15.0 * kSquare);
  }
}

// The checks above would see an ordinary double.
TEST(DoubleDoubleTest, ADoubleOperationWouldBreakTheBounds) {
  const DoubleDouble third = DoubleDouble(1.0) / DoubleDouble(3.0);
  EXPECT_LE(RelativeError(third, Wide(1) / 3), 15.0 * kSquare);
  EXPECT_GT(RelativeError(DoubleDouble(1.0 / 3.0), Wide(1) / 3),
            1e12 * kSquare);
}

TEST(DoubleDoubleTest, RootOfZeroIsZero) {
  EXPECT_EQ(Sqrt(DoubleDouble(0.0)).hi, 0.0);
  EXPECT_EQ(Sqrt(DoubleDouble(0.0)).lo, 0.0);
}

TEST(DoubleDoubleTest, RoundsToTheNearestDouble) {
  const DoubleDouble x = DoubleDouble(1.0) + DoubleDouble(0x1p-54);
  EXPECT_EQ(x.ToDouble(), 1.0);
  EXPECT_EQ(x.lo, 0x1p-54);
}

TEST(DoubleDoubleTest, NotANumberIsNotLost) {
  const DoubleDouble nan(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan((nan + DoubleDouble(1.0)).ToDouble()));
  EXPECT_TRUE(std::isnan((DoubleDouble(2.0) * nan).ToDouble()));
  EXPECT_TRUE(std::isnan((DoubleDouble(2.0) / nan).ToDouble()));
  EXPECT_TRUE(std::isnan(Sqrt(nan).ToDouble()));
}

class DoubleDouble3Test : public ::testing::Test {
 protected:
  DoubleDouble3 RandomVector() {
    return {{RandomNumber(random_, 1e-3, 1e3), RandomNumber(random_, 1e-3, 1e3),
             RandomNumber(random_, 1e-3, 1e3)}};
  }

  RandomSource random_{20250117};
};

// Three products (7u²) and two sums (3u² each) of their absolute values.
constexpr double kDotBound = 13.0 * kSquare;

TEST_F(DoubleDouble3Test, DotErrsByThirteenSquaredUnitsOfItsTerms) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble3 a = RandomVector();
    const DoubleDouble3 b = RandomVector();
    const WideVector3 x = ToWide(a);
    const WideVector3 y = ToWide(b);
    const double terms = ToDouble(Wide(x.cwiseAbs().dot(y.cwiseAbs())));
    EXPECT_LE(std::abs(ToDouble(ToWide(Dot(a, b)) - x.dot(y))),
              kDotBound * terms);
  }
}

TEST_F(DoubleDouble3Test, CrossErrsByThirteenSquaredUnitsOfItsTerms) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble3 a = RandomVector();
    const DoubleDouble3 b = RandomVector();
    const WideVector3 x = ToWide(a);
    const WideVector3 y = ToWide(b);
    const WideVector3 error = ToWide(Cross(a, b)) - x.cross(y);
    EXPECT_LE(MaxAbs(error), kDotBound * 2.0 * MaxAbs(x) * MaxAbs(y));
  }
}

TEST_F(DoubleDouble3Test, NormIsTheRootOfTheSquare) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const DoubleDouble3 a = RandomVector();
    const WideVector3 x = ToWide(a);
    EXPECT_LE(RelativeError(Norm(a), sqrt(Wide(x.dot(x)))),
              kDotBound + 15.0 * kSquare);
  }
}

TEST_F(DoubleDouble3Test, HighAndLowPartsMakeTheVector) {
  const DoubleDouble3 a = RandomVector();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a.ToDouble()(i), a[i].hi);
    EXPECT_EQ(a.LowPart()(i), a[i].lo);
  }
}

}  // namespace
}  // namespace emmy
