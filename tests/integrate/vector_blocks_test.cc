#include "emmy/integrate/vector_blocks.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "emmy/base/work_team.h"

namespace emmy {
namespace {

TEST(VectorBlocksTest, FewVectorsHaveNoBlocks) {
  const VectorBlocks few(3999);
  EXPECT_EQ(few.count(), 0U);
  EXPECT_EQ(few.Common(0, 0), std::nullopt);
}

// Else two threads would add to the same vector.
TEST(VectorBlocksTest, ABlockIsCommonToItsOwnVectorsAlone) {
  const VectorBlocks many(8000);
  ASSERT_EQ(many.count(), 8U);
  EXPECT_EQ(many.Common(0, 999), 0U);
  EXPECT_EQ(many.Common(999, 0), 0U);
  EXPECT_EQ(many.Common(7000, 7999), 7U);
  EXPECT_EQ(many.Common(999, 1000), std::nullopt);
  EXPECT_EQ(many.Common(1000, 999), std::nullopt);
  EXPECT_EQ(many.Common(0, 7999), std::nullopt);
}

TEST(BlockedItemsTest, EachItemIsWorkedOnOnceInItsBlockOrRemains) {
  BlockedItems<int> items(8000);
  EXPECT_TRUE(items.Add(0, 10, 20));
  EXPECT_FALSE(items.Add(1, 999, 1000));
  EXPECT_TRUE(items.Add(2, 7998, 7999));
  EXPECT_TRUE(items.Add(3, 20, 30));
  EXPECT_EQ(items.rest(), std::vector<int>{1});
  WorkTeam alone(1);
  std::vector<int> order;
  items.ForBlocks(&alone, [&order](int item) { order.push_back(item); });
  EXPECT_EQ(order, (std::vector<int>{0, 3, 2}));
}

}  // namespace
}  // namespace emmy
