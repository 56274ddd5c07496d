#include "emmy/numerics/nested_dissection.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <utility>
#include <vector>

#include "emmy/numerics/symmetric_block_matrix.h"

namespace emmy {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// A square net of size × size nodes with both diagonals.
SparseMatrix Net(int size) {
  std::vector<std::pair<int, int>> pairs;
  const auto at = [size](int i, int j) { return i * size + j; };
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      pairs.emplace_back(at(i, j), at(i, j));
      const auto couple = [&](int k, int l) {
        if (k < size && l >= 0 && l < size) {
          pairs.emplace_back(at(k, l), at(i, j));
        }
      };
      couple(i + 1, j);
      couple(i, j + 1);
      couple(i + 1, j + 1);
      couple(i + 1, j - 1);
    }
  }
  SymmetricBlockMatrix matrix(size * size, pairs);
  for (const auto& [row, column] : pairs) {
    matrix.Add(matrix.Find(row, column),
               row == column ? Matrix3d(20.0 * Matrix3d::Identity())
                             : Matrix3d(Matrix3d::Ones()));
  }
  SparseMatrix symmetric(3 * size * size, 3 * size * size);
  symmetric = matrix.lower().selfadjointView<Eigen::Lower>();
  return symmetric;
}

template <typename Ordering>
Eigen::Index FillIn(const SparseMatrix& matrix) {
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Ordering> factor(
      matrix);
  return factor.matrixL().nestedExpression().nonZeros();
}

TEST(NestedDissectionTest, KeepsTheThreeUnknownsOfABlockTogether) {
  const SparseMatrix net = Net(20);
  NestedDissection::Permutation order;
  NestedDissection()(net, order);
  ASSERT_EQ(order.size(), net.cols());
  std::vector<int> times(static_cast<size_t>(net.cols()), 0);
  for (Eigen::Index k = 0; k < order.size(); ++k) {
    const int unknown = order.indices()(k);
    ASSERT_GE(unknown, 0);
    ASSERT_LT(unknown, net.cols());
    ++times[static_cast<size_t>(unknown)];
    EXPECT_EQ(unknown % 3, static_cast<int>(k % 3));
    EXPECT_EQ(unknown / 3, order.indices()(k - k % 3) / 3);
  }
  EXPECT_EQ(times, std::vector<int>(times.size(), 1));
}

// For a plane net of n nodes dissection leaves O(n log n) entries, the given
// order of rows one after the other O(n √n).
TEST(NestedDissectionTest, LeavesLessFillInThanTheOrderOfTheRows) {
  const SparseMatrix net = Net(40);
  EXPECT_LT(FillIn<NestedDissection>(net),
            FillIn<Eigen::NaturalOrdering<int>>(net));
}

TEST(NestedDissectionTest, OrdersTheSmallestMatrix) {
  NestedDissection::Permutation order;
  NestedDissection()(Net(1), order);
  EXPECT_EQ(order.indices(), Eigen::Vector3i(0, 1, 2));
}

}  // namespace
}  // namespace emmy
