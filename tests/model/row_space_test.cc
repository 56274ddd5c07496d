#include "emmy/model/row_space.h"

#include <gtest/gtest.h>

#include <vector>

namespace emmy {
namespace {

RowSpace OfRows(const std::vector<SparseRow>& rows) {
  RowSpace space;
  for (const SparseRow& row : rows) {
    for (const auto& [column, value] : row) space.CountUse(column);
  }
  for (const SparseRow& row : rows) space.Add(space.Reduce(row));
  return space;
}

TEST(RowSpaceTest, ACombinationReducesToNothing) {
  const RowSpace space = OfRows({{{0, 1.0}, {1, 2.0}}, {{1, 1.0}, {2, -1.0}}});
  EXPECT_EQ(LargestEntry(space.Reduce({{0, 2.0}, {1, 7.0}, {2, -3.0}})), 0.0);
}

TEST(RowSpaceTest, AnIndependentRowIsLeftInNoColumnOfAPivot) {
  const RowSpace space = OfRows({{{0, 1.0}, {1, 2.0}}, {{1, 1.0}, {2, -1.0}}});
  const SparseRow left = space.Reduce({{0, 1.0}, {2, 4.0}});
  EXPECT_GT(LargestEntry(left), 0.0);
  EXPECT_EQ(LargestEntry(space.Reduce(left)), LargestEntry(left));
}

TEST(RowSpaceTest, TheEmptySpaceLeavesARowAsItIs) {
  const SparseRow row = {{3, -2.5}, {5, 1.0}};
  EXPECT_EQ(RowSpace().Reduce(row), row);
  EXPECT_EQ(LargestEntry(row), 2.5);
}

}  // namespace
}  // namespace emmy
