#include "emmy/numerics/symmetric_block_matrix.h"

#include <gtest/gtest.h>

namespace emmy {
namespace {

Matrix3d Counting(double first) {
  Matrix3d block;
  for (int i = 0; i < 9; ++i) block(i) = first + i;
  return block;
}

MatrixXd Symmetric(const SymmetricBlockMatrix& matrix) {
  return MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
}

TEST(SymmetricBlockMatrixTest, BlocksLandWhereTheyBelong) {
  SymmetricBlockMatrix matrix(3, {{0, 0}, {1, 1}, {2, 2}, {2, 0}});
  const Matrix3d diagonal = Counting(1.0) + Counting(1.0).transpose();
  const Matrix3d coupling = Counting(20.0);
  matrix.Add(matrix.Find(1, 1), diagonal);
  matrix.Add(matrix.Find(2, 0), coupling);
  MatrixXd expected = MatrixXd::Zero(9, 9);
  expected.block<3, 3>(3, 3) = diagonal;
  expected.block<3, 3>(6, 0) = coupling;
  expected.block<3, 3>(0, 6) = coupling.transpose();
  EXPECT_EQ(Symmetric(matrix), expected);
}

TEST(SymmetricBlockMatrixTest, AddsToWhatIsThereUntilItIsCleared) {
  SymmetricBlockMatrix matrix(2, {{0, 0}, {1, 0}, {1, 1}});
  const SymmetricBlockMatrix::Slot slot = matrix.Find(1, 0);
  matrix.Add(slot, Counting(1.0));
  matrix.Add(slot, Counting(2.0));
  EXPECT_EQ((MatrixXd(matrix.lower()).block<3, 3>(3, 0)),
            Counting(1.0) + Counting(2.0));
  matrix.SetZero();
  EXPECT_EQ(MatrixXd(matrix.lower()).cwiseAbs().maxCoeff(), 0.0);
}

TEST(SymmetricBlockMatrixTest, APairAndItsMirrorImageAreOne) {
  const SymmetricBlockMatrix once(3, {{0, 0}, {1, 1}, {2, 2}, {2, 1}});
  const SymmetricBlockMatrix twice(
      3, {{1, 2}, {2, 1}, {0, 0}, {1, 1}, {2, 2}, {1, 1}});
  EXPECT_EQ(once.lower().nonZeros(), twice.lower().nonZeros());
}

TEST(SymmetricBlockMatrixDeathTest, ABlockOutsideThePatternIsNamed) {
  const SymmetricBlockMatrix matrix(3, {{0, 0}, {1, 1}, {2, 2}});
  EXPECT_DEATH(static_cast<void>(matrix.Find(2, 1)),
               "block \\(2, 1\\) is not in the pattern");
}

}  // namespace
}  // namespace emmy
