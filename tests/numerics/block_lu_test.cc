#include "emmy/numerics/block_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <utility>
#include <vector>

namespace emmy {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

// A matrix near a quasi-definite one: blocks from `multipliers` on have no
// diagonal block of their own.
struct Filled {
  Filled(int num_blocks, const Pairs& pairs, int multipliers)
      : lu(num_blocks, pairs, Waits(num_blocks, pairs, multipliers)),
        dense(MatrixXd::Zero(3 * num_blocks, 3 * num_blocks)) {
    for (int i = 0; i < multipliers; ++i) {
      Set(i, i, 8.0 * Matrix3d::Identity() + 0.1 * Random());
    }
    for (const auto& [i, j] : pairs) {
      const Matrix3d block = Matrix3d::Identity() + 0.3 * Random();
      Set(i, j, block);
      Set(j, i, block.transpose() + 0.05 * Random());
    }
  }

  static std::vector<std::vector<int>> Waits(int num_blocks, const Pairs& pairs,
                                             int multipliers) {
    std::vector<std::vector<int>> waits(static_cast<size_t>(num_blocks));
    for (const auto& [i, j] : pairs) {
      if (j >= multipliers) waits[static_cast<size_t>(j)].push_back(i);
    }
    return waits;
  }
  Matrix3d Random() {
    Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i) = uniform(engine);
    return m;
  }
  void Set(int row, int column, const Matrix3d& block) {
    lu.Add(lu.Find(row, column), block);
    dense.block<3, 3>(3 * row, 3 * column) += block;
  }
  // Of A x = b, relative to b.
  double Miss() {
    VectorXd b(dense.rows());
    for (double& entry : b) entry = uniform(engine);
    EXPECT_TRUE(lu.Factorize());
    VectorXd x;
    lu.Solve(b, &x);
    return (dense * x - b).norm() / b.norm();
  }

  std::mt19937 engine{7};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  BlockLu lu;
  MatrixXd dense;
};

// Bodies 0 … n − 1 in a row, joint n + i between i and i + 1.
Pairs Chain(int n) {
  Pairs pairs;
  for (int i = 0; i + 1 < n; ++i) {
    pairs.emplace_back(i, n + i);
    pairs.emplace_back(i + 1, n + i);
  }
  return pairs;
}

// A backward stable solution leaves a few u κ, κ < 100 here.
constexpr double kMiss = 1e-13;

TEST(BlockLuTest, SolvesAChainWithMultipliers) {
  EXPECT_LE(Filled(19, Chain(10), 10).Miss(), kMiss);
}

TEST(BlockLuTest, SolvesAClosedLoop) {
  Pairs pairs = Chain(10);
  pairs.emplace_back(0, 19);
  pairs.emplace_back(9, 19);
  EXPECT_LE(Filled(20, pairs, 10).Miss(), kMiss);
}

// All multipliers of a star are left when the last block is eliminated.
TEST(BlockLuTest, SolvesAStarWithMultipliers) {
  Pairs pairs;
  for (int i = 1; i < 8; ++i) {
    pairs.emplace_back(i, 7 + i);
    pairs.emplace_back(0, 7 + i);
  }
  EXPECT_LE(Filled(15, pairs, 8).Miss(), kMiss);
}

TEST(BlockLuTest, SolvesAFullMatrix) {
  Pairs pairs;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < i; ++j) pairs.emplace_back(i, j);
  }
  EXPECT_LE(Filled(5, pairs, 5).Miss(), kMiss);
}

TEST(BlockLuTest, SolvesAgainAfterSetZero) {
  Filled filled(19, Chain(10), 10);
  EXPECT_LE(filled.Miss(), kMiss);
  filled.lu.SetZero();
  for (int i = 0; i < 19; ++i) {
    filled.lu.Add(filled.lu.Find(i, i), 2.0 * Matrix3d::Identity());
  }
  filled.dense = 2.0 * MatrixXd::Identity(57, 57);
  EXPECT_EQ(filled.Miss(), 0.0);
}

// A chain of n blocks has n + 2 (n − 1) of them, and bodies that go first join
// their two joints: nothing that grows faster than the chain.
TEST(BlockLuTest, AChainFillsInByItsLength) {
  const auto stored = [](int n) {
    return BlockLu(2 * n - 1, Chain(n), {}).num_stored();
  };
  EXPECT_LE(stored(100), 800U);
  EXPECT_LE(stored(1000) - stored(100), 900U * 8U);
}

TEST(BlockLuTest, ASingularPivotIsReported) {
  BlockLu lu(2, {{0, 1}}, {});
  EXPECT_FALSE(lu.Factorize());
}

TEST(BlockLuDeathTest, ABlockOutsideThePatternStops) {
  const BlockLu lu(3, {{0, 1}}, {});
  EXPECT_DEATH(static_cast<void>(lu.Find(0, 2)), "not in the pattern");
}

}  // namespace
}  // namespace emmy
