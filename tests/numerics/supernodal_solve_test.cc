#include "emmy/numerics/supernodal_solve.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <limits>
#include <vector>

#include "tests/support/random_source.h"

namespace emmy {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// A grid of `size` × `size` points with random couplings to their neighbours,
// diagonally dominant: fronts of every width arise in its factor.
SparseMatrix Grid(int size, uint64_t seed) {
  RandomSource random(seed);
  std::vector<Eigen::Triplet<double>> entries;
  const auto at = [size](int i, int j) { return i * size + j; };
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      entries.emplace_back(at(i, j), at(i, j), 10.0);
      const auto couple = [&](int k, int l) {
        if (k >= size || l < 0 || l >= size) return;
        const double value = random.Uniform(-1.0, 1.0);
        entries.emplace_back(at(i, j), at(k, l), value);
        entries.emplace_back(at(k, l), at(i, j), value);
      };
      couple(i + 1, j);
      couple(i, j + 1);
      couple(i + 1, j + 1);
      couple(i + 1, j - 1);
    }
  }
  SparseMatrix matrix(size * size, size * size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <typename Scalar>
class SupernodalSolveTest : public ::testing::Test {
 protected:
  // ‖x − x_exact‖ / ‖x_exact‖ after a solve with A x_exact. Dominance bounds
  // the condition number by (10 + 8) / (10 − 8) = 9; growth of rounding in a
  // triangular solve of n rows by n, here with the usual √n.
  static double Error(const SparseMatrix& matrix,
                      SupernodalSolve<Scalar>* solve) {
    RandomSource random(11);
    VectorXd expected(matrix.rows());
    for (Eigen::Index i = 0; i < expected.size(); ++i) {
      expected(i) = random.Uniform(-1.0, 1.0);
    }
    VectorXd x;
    solve->Solve(matrix * expected, &x);
    return (x - expected).norm() / expected.norm();
  }
  static double Bound(const SparseMatrix& matrix) {
    return 9.0 * std::sqrt(static_cast<double>(matrix.rows())) *
           static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  }
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SupernodalSolveTest, Scalars);

TYPED_TEST(SupernodalSolveTest, SolvesToThePrecisionOfItsPanels) {
  for (const int size : {1, 2, 5, 12, 30}) {
    const SparseMatrix matrix = Grid(size, 5);
    SupernodalSolve<TypeParam> solve;
    solve.Analyze(matrix);
    ASSERT_TRUE(solve.Factorize(matrix));
    EXPECT_LE(this->Error(matrix, &solve), this->Bound(matrix)) << size;
  }
}

TYPED_TEST(SupernodalSolveTest, TakesTheNumbersOfANewMatrix) {
  const SparseMatrix first = Grid(12, 5);
  const SparseMatrix second = Grid(12, 6);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(first);
  ASSERT_TRUE(solve.Factorize(first));
  EXPECT_GT(this->Error(second, &solve), 1e-3);  // Not yet.
  ASSERT_TRUE(solve.Factorize(second));
  EXPECT_LE(this->Error(second, &solve), this->Bound(second));
}

// Quasi-definite: the diagonal of D has both signs, in any order (Vanderbei).
TYPED_TEST(SupernodalSolveTest, FactorizesQuasiDefiniteMatrices) {
  SparseMatrix matrix = Grid(12, 5);
  for (Eigen::Index i = 0; i < matrix.rows(); i += 3) {
    matrix.coeffRef(i, i) = -matrix.coeff(i, i);
  }
  for (const size_t large : {size_t{0}, size_t{1} << 30}) {
    SupernodalSolve<TypeParam> solve;
    solve.Analyze(matrix, large);
    ASSERT_TRUE(solve.Factorize(matrix));
    EXPECT_LE(this->Error(matrix, &solve), this->Bound(matrix));
  }
}

TYPED_TEST(SupernodalSolveTest, RefusesPivotsThatVanishOrAreNotFinite) {
  const SparseMatrix good = Grid(5, 5);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(good);
  for (const double factor : {0.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    SparseMatrix bad = good;
    for (Eigen::Index k = 0; k < bad.nonZeros(); ++k) {
      bad.valuePtr()[k] *= factor;
    }
    EXPECT_FALSE(solve.Factorize(bad)) << factor;
  }
  ASSERT_TRUE(solve.Factorize(good));
  EXPECT_LE(this->Error(good, &solve), this->Bound(good));
}

// Where no other column depends on it.
TYPED_TEST(SupernodalSolveTest, RefusesAZeroByItself) {
  SparseMatrix matrix(3, 3);
  matrix.setIdentity();
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix);
  EXPECT_TRUE(solve.Factorize(matrix));
  matrix.coeffRef(1, 1) = 0.0;
  EXPECT_FALSE(solve.Factorize(matrix));
}

// A dense matrix is one panel after the other, each the widest there is.
TYPED_TEST(SupernodalSolveTest, FactorizesWidePanels) {
  constexpr int kSize = 250;
  RandomSource random(3);
  MatrixXd dense(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j <= i; ++j) {
      dense(i, j) = dense(j, i) = random.Uniform(-1.0, 1.0) / kSize;
    }
    dense(i, i) += 10.0;
  }
  const SparseMatrix matrix = dense.sparseView();
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix);
  ASSERT_TRUE(solve.Factorize(matrix));
  EXPECT_LE(this->Error(matrix, &solve), this->Bound(matrix));
}

// Merged columns store zeros; that must stay a small part.
TYPED_TEST(SupernodalSolveTest, StoresFewZeros) {
  const SparseMatrix matrix = Grid(30, 5);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix);
  // The same order of elimination.
  const Eigen::SimplicialLDLT<SparseMatrix> ldlt(matrix);
  const auto entries = static_cast<double>(
      ldlt.matrixL().nestedExpression().nonZeros() + matrix.rows());
  EXPECT_GE(static_cast<double>(solve.panel_size()), entries);
  // 40 % zeros in narrow panels, as much again for the upper triangle of
  // their square blocks, and up to a unit of padding in each column.
  EXPECT_LE(static_cast<double>(solve.panel_size()), 3.0 * entries);
}

TYPED_TEST(SupernodalSolveTest, SolvesForAnySizeOfTheRightSide) {
  const SparseMatrix matrix = Grid(5, 5);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix);
  ASSERT_TRUE(solve.Factorize(matrix));
  const VectorXd ones = VectorXd::Ones(matrix.rows());
  VectorXd reference;
  solve.Solve(ones, &reference);
  for (const double size : {0.0, 1e-300, 1e-60, 1e60, 1e300}) {
    VectorXd x;
    solve.Solve(size * ones, &x);
    const double error = (x - size * reference).cwiseAbs().maxCoeff();
    EXPECT_LE(error, this->Bound(matrix) * size) << size;
  }
}

// A factor that counts as large is solved in parts, whatever its size.
TYPED_TEST(SupernodalSolveTest, SolvesInParts) {
  for (const int size : {2, 5, 12, 30}) {
    const SparseMatrix matrix = Grid(size, 5);
    SupernodalSolve<TypeParam> solve;
    solve.Analyze(matrix, /*large_factor=*/0);
    EXPECT_GT(solve.num_parts(), 0U);
    ASSERT_TRUE(solve.Factorize(matrix));
    EXPECT_LE(this->Error(matrix, &solve), this->Bound(matrix)) << size;
  }
}

TYPED_TEST(SupernodalSolveTest, SmallFactorsAreNotDividedUp) {
  const SparseMatrix matrix = Grid(30, 5);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix);
  EXPECT_EQ(solve.num_parts(), 0U);
}

// A forest: trees that do not meet have no common top.
TYPED_TEST(SupernodalSolveTest, SolvesUnconnectedUnknownsInParts) {
  SparseMatrix matrix(50, 50);
  matrix.setIdentity();
  matrix *= 10.0;
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix, /*large_factor=*/0);
  ASSERT_TRUE(solve.Factorize(matrix));
  EXPECT_LE(this->Error(matrix, &solve), this->Bound(matrix));
}

TYPED_TEST(SupernodalSolveTest, BitsDoNotDependOnTheNumberOfThreads) {
  const SparseMatrix matrix = Grid(40, 5);
  SupernodalSolve<TypeParam> solve;
  solve.Analyze(matrix, /*large_factor=*/0);
  ASSERT_TRUE(solve.Factorize(matrix));
  const VectorXd b = VectorXd::LinSpaced(matrix.rows(), -1.0, 2.0);
  VectorXd alone;
  solve.Solve(b, &alone);
  for (const size_t threads : {1U, 2U, 3U, 11U}) {
    WorkTeam team(threads);
    for (int repetition = 0; repetition < 3; ++repetition) {
      VectorXd x;
      solve.Solve(b, &x, &team);
      EXPECT_EQ(x, alone) << threads;
    }
  }
}

}  // namespace
}  // namespace emmy
