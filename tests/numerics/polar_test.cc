#include "emmy/numerics/polar.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "emmy/numerics/rotation.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Stretches {
  const char* name;
  Vector3d values;
  friend void PrintTo(const Stretches& s, std::ostream* os) { *os << s.name; }
};

class PolarTest : public ::testing::TestWithParam<Stretches> {
 protected:
  struct Sample {
    Matrix3d rotation;  // To a rounding.
    Matrix3d f;
  };

  // F = R Q diag(λ) Qᵀ with random R and Q.
  Sample Random() {
    const Matrix3d axes = QuaternionToMatrix(random_.UnitQuaternion());
    const Matrix3d rotation = QuaternionToMatrix(random_.UnitQuaternion());
    const Matrix3d f =
        rotation * axes * GetParam().values.asDiagonal() * axes.transpose();
    return {rotation, f};
  }

  static constexpr int kTrials = 100;
  RandomSource random_{20250220};
};

// Newton's iteration is backward stable in practice: some 30 operations an
// iteration, of which the last two count.
TEST_P(PolarTest, FirstFactorIsARotation) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const PolarDecomposition polar = DecomposePolar(Random().f);
    ASSERT_TRUE(polar.ok);
    const Matrix3d gram = polar.rotation.transpose() * polar.rotation;
    EXPECT_LE((gram - Matrix3d::Identity()).cwiseAbs().maxCoeff(),
              RoundoffBound(60, 1.0));
    EXPECT_GT(polar.rotation.determinant(), 0.0);
  }
}

TEST_P(PolarTest, SecondFactorIsSymmetricPositiveDefinite) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const PolarDecomposition polar = DecomposePolar(Random().f);
    EXPECT_EQ(polar.stretch, Matrix3d(polar.stretch.transpose()));
    const Vector3d eigenvalues =
        Eigen::SelfAdjointEigenSolver<Matrix3d>(polar.stretch).eigenvalues();
    // To rounding relative to the largest.
    EXPECT_GT(eigenvalues.minCoeff(),
              -RoundoffBound(60, eigenvalues.maxCoeff()));
  }
}

TEST_P(PolarTest, FactorsMultiplyToTheMatrix) {
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d f = Random().f;
    const PolarDecomposition polar = DecomposePolar(f);
    EXPECT_LE((polar.rotation * polar.stretch - f).cwiseAbs().maxCoeff(),
              RoundoffBound(60, 3.0 * f.cwiseAbs().maxCoeff()));
  }
}

// F is known to a rounding u |F| only, which changes R̃ by that over the sum of
// the two smallest stretches.
TEST_P(PolarTest, FirstFactorIsTheRotationThatWasPutIn) {
  Vector3d sorted = GetParam().values;
  std::sort(sorted.data(), sorted.data() + 3);
  const double sensitivity = sorted(2) / (sorted(0) + sorted(1));
  for (int trial = 0; trial < kTrials; ++trial) {
    const Sample sample = Random();
    const PolarDecomposition polar = DecomposePolar(sample.f);
    EXPECT_LE((polar.rotation - sample.rotation).cwiseAbs().maxCoeff(),
              RoundoffBound(60, 1.0 + sensitivity));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Stretch, PolarTest,
    ::testing::Values(Stretches{"None", {1, 1, 1}},
                      Stretches{"Tiny", {1 + 1e-12, 1, 1 - 1e-9}},
                      Stretches{"Moderate", {0.5, 1.0, 2.0}},
                      Stretches{"LargeScale", {3e20, 1e20, 2e20}},
                      Stretches{"SmallScale", {3e-20, 1e-20, 2e-20}},
                      Stretches{"OneSmall", {1e-8, 1.0, 1.0}}),
    [](const auto& stretches) { return stretches.param.name; });

// With two directions far below the third, the inverse is good to u κ only,
// and det F may be lost altogether: then there is no answer rather than a
// wrong one.
TEST(PolarIllConditionedTest, LosesAtMostTheConditionOrRefuses) {
  RandomSource random(20250221);
  int accepted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const double smallest = std::abs(random.Magnitude(1e-12, 1e-2));
    const double middle = smallest * random.Uniform(1.0, 10.0);
    const Matrix3d axes = QuaternionToMatrix(random.UnitQuaternion());
    const Matrix3d f = QuaternionToMatrix(random.UnitQuaternion()) *
                       Vector3d(smallest, middle, 1.0).asDiagonal() * axes;
    const PolarDecomposition polar = DecomposePolar(f);
    if (!polar.ok) {
      EXPECT_LT(smallest, 1e-7) << "refused without need";
      continue;
    }
    ++accepted;
    const double bound = RoundoffBound(60, 1.0 / smallest);
    const Matrix3d gram = polar.rotation.transpose() * polar.rotation;
    EXPECT_LE((gram - Matrix3d::Identity()).cwiseAbs().maxCoeff(), bound);
    EXPECT_LE((polar.rotation * polar.stretch - f).cwiseAbs().maxCoeff(), bound)
        << smallest;
  }
  EXPECT_GT(accepted, 500);
}

TEST(PolarFailureTest, WithoutPositiveDeterminantThereIsNoAttitude) {
  Matrix3d singular = Matrix3d::Identity();
  singular(2, 2) = 0.0;
  for (const Matrix3d& f :
       {Matrix3d(-Matrix3d::Identity()), singular, Matrix3d(Matrix3d::Zero()),
        Matrix3d(Matrix3d::Constant(kNan)),
        Matrix3d(kInfinity * Matrix3d::Identity())}) {
    const PolarDecomposition polar = DecomposePolar(f);
    EXPECT_FALSE(polar.ok) << f;
    EXPECT_TRUE(std::isnan(polar.rotation(0, 0))) << f;
    EXPECT_TRUE(std::isnan(polar.stretch(2, 1))) << f;
  }
}

}  // namespace
}  // namespace emmy
