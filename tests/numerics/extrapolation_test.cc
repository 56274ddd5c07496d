#include "emmy/numerics/extrapolation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emmy {
namespace {

using Vector1d = Eigen::Matrix<double, 1, 1>;

// Takes one value and returns the prediction of the next.
double Advance(double value, Extrapolation* sequence) {
  Extrapolation::Errors errors{};
  sequence->Add(0, Vector1d(value), &errors);
  sequence->Predict(0, 1, Extrapolation::BestOrder(errors));
  return sequence->next(0);
}

class PolynomialTest : public ::testing::TestWithParam<int> {};

// Whole numbers, so that differences are exact.
TEST_P(PolynomialTest, IsPredictedExactlyOnceThereAreEnoughValues) {
  const int degree = GetParam();
  const auto value = [degree](int n) {
    return std::pow(n - 3.0, degree) + 2.0;
  };
  Extrapolation sequence;
  sequence.SetZero(1);
  for (int n = 0; n < 12; ++n) {
    const double next = Advance(value(n), &sequence);
    // A zero difference of a higher order may come first, by one value.
    if (n > degree + 1) {
      EXPECT_EQ(next, value(n + 1)) << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, PolynomialTest, ::testing::Values(0, 1, 2, 3),
                         ::testing::PrintToStringParamName());

TEST(ExtrapolationTest, PredictsASmoothSequenceToFourthOrder) {
  constexpr double kStep = 1e-2;
  Extrapolation sequence;
  sequence.SetZero(1);
  double prediction = 0.0;
  for (int n = 0; n < 100; ++n) {
    if (n > 10) {
      // ∇⁴ of the sine is below kStep⁴.
      EXPECT_LE(std::abs(prediction - std::sin(kStep * n)), 1.1e-8) << n;
    }
    prediction = Advance(std::sin(kStep * n), &sequence);
  }
}

// What a stiff vibration looks like: higher orders would miss it by more.
TEST(ExtrapolationTest, KeepsTheLastValueWhereTheSequenceTurnsInEveryStep) {
  Extrapolation sequence;
  sequence.SetZero(1);
  for (int n = 0; n < 20; ++n) {
    const double value = n % 2 == 0 ? 1.0 : -1.0;
    EXPECT_EQ(Advance(value, &sequence), value) << n;
  }
}

TEST(ExtrapolationTest, SequencesOfOneSetAreIndependentExceptForTheirOrder) {
  Extrapolation sequence;
  sequence.SetZero(3);
  for (int n = 0; n < 10; ++n) {
    Extrapolation::Errors errors{};
    sequence.Add(0, Eigen::Vector2d(2.0 * n, 5.0), &errors);
    sequence.Predict(0, 2, Extrapolation::BestOrder(errors));
  }
  EXPECT_EQ(sequence.next(0), 20.0);
  EXPECT_EQ(sequence.next(1), 5.0);
  EXPECT_EQ(sequence.next(2), 0.0);
}

TEST(ExtrapolationTest, BestOrderIsTheOneWithTheLeastError) {
  EXPECT_EQ(Extrapolation::BestOrder({4.0, 3.0, 2.0, 1.0}), 3);
  EXPECT_EQ(Extrapolation::BestOrder({1.0, 1.0, 2.0, 3.0}), 0);
}

}  // namespace
}  // namespace emmy
