#include "emmy/numerics/factor_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <utility>
#include <vector>

#include "tests/support/random_source.h"

namespace emmy {
namespace {

using ::testing::ElementsAre;
using SparseMatrix = Eigen::SparseMatrix<double>;

// The lower triangle with these entries below its diagonal.
SparseMatrix Lower(int size, const std::vector<std::pair<int, int>>& below) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 4.0);
  for (const auto& [row, column] : below) {
    entries.emplace_back(row, column, 1.0);
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<int> Column(const FactorPattern& pattern, int column) {
  const int* const begin = pattern.begin(column);
  return {begin, begin + pattern.count(column)};
}

// An arrow whose tip comes first fills up, one whose tip comes last does not.
TEST(FactorPatternTest, ArrowsFillUpFromTheirTip) {
  const FactorPattern full =
      FindFactorPattern(Lower(4, {{1, 0}, {2, 0}, {3, 0}}));
  EXPECT_THAT(Column(full, 0), ElementsAre(1, 2, 3));
  EXPECT_THAT(Column(full, 1), ElementsAre(2, 3));
  EXPECT_THAT(Column(full, 2), ElementsAre(3));
  EXPECT_THAT(Column(full, 3), ElementsAre());
  const FactorPattern bare =
      FindFactorPattern(Lower(4, {{3, 0}, {3, 1}, {3, 2}}));
  for (int c = 0; c < 3; ++c) EXPECT_THAT(Column(bare, c), ElementsAre(3));
  EXPECT_EQ(bare.columns(), 4);
}

TEST(FactorPatternTest, IsThatOfEigensFactorInTheSameOrder) {
  constexpr int kSize = 60;
  RandomSource random(7);
  std::vector<std::pair<int, int>> below;
  for (int k = 0; k < 90; ++k) {
    const int row = static_cast<int>(random.Uniform(1.0, kSize));
    const int column = static_cast<int>(random.Uniform(0.0, row));
    below.emplace_back(row, column);
  }
  const SparseMatrix matrix = Lower(kSize, below);
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      ldlt(matrix);
  const SparseMatrix& expected = ldlt.matrixL().nestedExpression();
  const FactorPattern pattern = FindFactorPattern(matrix);
  for (int c = 0; c < kSize; ++c) {
    std::vector<int> rows;
    for (SparseMatrix::InnerIterator it(expected, c); it; ++it) {
      rows.push_back(static_cast<int>(it.row()));
    }
    EXPECT_EQ(Column(pattern, c), rows) << c;
  }
}

}  // namespace
}  // namespace emmy
