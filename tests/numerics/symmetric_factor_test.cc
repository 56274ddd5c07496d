#include "emmy/numerics/symmetric_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/support/random_source.h"

namespace emmy {
namespace {

using Method = SymmetricFactor::Method;

// A ring of blocks, diagonally dominant. The last `negative` blocks have a
// negative diagonal, as the constraints of a joint system do.
struct Sample {
  SymmetricBlockMatrix matrix;
  MatrixXd dense;
};

Sample MakeSample(int blocks, int negative, uint64_t seed) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < blocks; ++i) {
    pairs.emplace_back(i, i);
    pairs.emplace_back(i, (i + 1) % blocks);  // Also above the diagonal.
  }
  Sample sample{SymmetricBlockMatrix(blocks, pairs),
                MatrixXd::Zero(3 * blocks, 3 * blocks)};
  RandomSource random(seed);
  for (int i = 0; i < blocks; ++i) {
    const auto block = random.Entries<Matrix3d>(1.0);
    const double sign = i < blocks - negative ? 1.0 : -1.0;
    const Matrix3d diagonal =
        sign * (10.0 * Matrix3d::Identity() + block * block.transpose());
    sample.matrix.Add(sample.matrix.Find(i, i), diagonal);
    sample.dense.block<3, 3>(3 * i, 3 * i) = diagonal;
    const int j = (i + 1) % blocks;
    const int row = std::max(i, j);
    const int column = std::min(i, j);
    const auto coupling = random.Entries<Matrix3d>(1.0);
    sample.matrix.Add(sample.matrix.Find(row, column), coupling);
    sample.dense.block<3, 3>(3 * row, 3 * column) += coupling;
    sample.dense.block<3, 3>(3 * column, 3 * row) += coupling.transpose();
  }
  return sample;
}

double SolutionError(const Sample& sample, SymmetricFactor* factor) {
  RandomSource random(7);
  VectorXd expected(sample.dense.rows());
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    expected(i) = random.Uniform(-1.0, 1.0);
  }
  VectorXd x(expected.size());
  factor->Solve(sample.dense * expected, &x);
  return (x - expected).cwiseAbs().maxCoeff();
}

// Panels may be kept in single precision: enough for a correction.
constexpr double kSinglePrecision = 1e-5;
constexpr double kDoublePrecision = 1e-13;

TEST(SymmetricFactorTest, DenseSolvesToDoublePrecision) {
  const Sample sample = MakeSample(8, 0, 1);
  SymmetricFactor factor(sample.matrix, true, Method::kDense);
  ASSERT_TRUE(factor.Factorize(sample.matrix));
  EXPECT_LE(SolutionError(sample, &factor), kDoublePrecision);
}

TEST(SymmetricFactorTest, SparseSolvesWellEnoughForACorrection) {
  const Sample sample = MakeSample(100, 0, 2);
  for (const Method method :
       {Method::kPanels, Method::kSimplicial, Method::kSupernodal}) {
    SymmetricFactor factor(sample.matrix, true, method);
    ASSERT_TRUE(factor.Factorize(sample.matrix));
    EXPECT_LE(SolutionError(sample, &factor), kSinglePrecision);
  }
}

TEST(SymmetricFactorTest, SolvesQuasiDefiniteMatrices) {
  for (const int blocks : {8, 100}) {
    const Sample sample = MakeSample(blocks, blocks / 4, 3);
    SymmetricFactor factor(sample.matrix, false);
    ASSERT_TRUE(factor.Factorize(sample.matrix));
    EXPECT_LE(SolutionError(sample, &factor), kSinglePrecision) << blocks;
  }
}

TEST(SymmetricFactorTest, TakesTheNumbersOfALaterMatrix) {
  const Sample first = MakeSample(100, 0, 4);
  const Sample second = MakeSample(100, 0, 5);
  SymmetricFactor factor(first.matrix, true);
  ASSERT_TRUE(factor.Factorize(first.matrix));
  EXPECT_GT(SolutionError(second, &factor), 1e-3);
  ASSERT_TRUE(factor.Factorize(second.matrix));
  EXPECT_LE(SolutionError(second, &factor), kSinglePrecision);
}

TEST(SymmetricFactorTest, TellsAMatrixOfZeros) {
  Sample sample = MakeSample(4, 0, 6);
  sample.matrix.SetZero();
  SymmetricFactor factor(sample.matrix, true, Method::kDense);
  EXPECT_FALSE(factor.Factorize(sample.matrix));
}

TEST(SymmetricFactorTest, ChoosesDenseForSmallSystemsOnly) {
  const Sample small = MakeSample(SymmetricFactor::kDenseLimit / 3, 0, 7);
  const Sample large = MakeSample(SymmetricFactor::kDenseLimit / 3 + 1, 0, 7);
  EXPECT_EQ(SymmetricFactor(small.matrix, true).method(), Method::kDense);
  EXPECT_NE(SymmetricFactor(large.matrix, true).method(), Method::kDense);
}

TEST(SymmetricBlockMatrixTest, AddsToBothTrianglesAsOne) {
  const Sample sample = MakeSample(5, 0, 8);
  const MatrixXd lower = MatrixXd(sample.matrix.lower());
  EXPECT_EQ(MatrixXd(lower.triangularView<Eigen::Lower>()),
            MatrixXd(sample.dense.triangularView<Eigen::Lower>()));
}

}  // namespace
}  // namespace emmy
