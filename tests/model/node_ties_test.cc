#include "emmy/model/node_ties.h"

#include <gtest/gtest.h>

namespace emmy {
namespace {

ResolvedPoint Body(size_t index) {
  return ResolvedBodyPoint{index, Vector3d(1.0, 2.0, 3.0)};
}

TEST(NodeTiesTest, NodesAreApartAtFirst) {
  const NodeTies ties(2);
  EXPECT_NE(ties.Representative(0), ties.Representative(1));
  EXPECT_FALSE(ties.Anchor(0).has_value());
  EXPECT_TRUE(ties.remaining().empty());
}

TEST(NodeTiesTest, TiedNodesAreOne) {
  NodeTies ties(4);
  ties.Tie(ResolvedNode{0}, ResolvedNode{1}, "/shared_points/0");
  ties.Tie(ResolvedNode{2}, ResolvedNode{3}, "/shared_points/1");
  EXPECT_NE(ties.Representative(0), ties.Representative(2));
  ties.Tie(ResolvedNode{1}, ResolvedNode{3}, "/shared_points/2");
  for (size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(ties.Representative(i), ties.Representative(0));
  }
  EXPECT_TRUE(ties.remaining().empty());
}

TEST(NodeTiesTest, AnAnchorServesAllNodesTiedTogetherBeforeAndAfter) {
  NodeTies ties(3);
  ties.Tie(ResolvedNode{0}, ResolvedNode{1}, "/shared_points/0");
  ties.Tie(Body(7), ResolvedNode{1}, "/shared_points/1");
  ties.Tie(ResolvedNode{2}, ResolvedNode{0}, "/shared_points/2");
  for (size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(ties.Anchor(i).has_value()) << i;
    EXPECT_EQ(std::get<ResolvedBodyPoint>(*ties.Anchor(i)).body, 7U);
  }
  EXPECT_TRUE(ties.remaining().empty());
}

TEST(NodeTiesTest, ASecondAnchorOfANodeRemainsAsAPair) {
  NodeTies ties(1);
  ties.Tie(ResolvedNode{0}, Body(1), "/shared_points/0");
  ties.Tie(ResolvedNode{0}, Body(2), "/shared_points/1");
  ASSERT_EQ(ties.remaining().size(), 1U);
  const AnchorPair& pair = ties.remaining()[0];
  EXPECT_EQ(std::get<ResolvedBodyPoint>(pair.first).body, 1U);
  EXPECT_EQ(std::get<ResolvedBodyPoint>(pair.second).body, 2U);
  EXPECT_EQ(pair.pointer, "/shared_points/1");
}

TEST(NodeTiesTest, AnchorsOfTwoNodesThatAreTiedRemainAsAPair) {
  NodeTies ties(2);
  ties.Tie(ResolvedNode{0}, Body(1), "/shared_points/0");
  ties.Tie(ResolvedNode{1}, Body(2), "/shared_points/1");
  ties.Tie(ResolvedNode{0}, ResolvedNode{1}, "/shared_points/2");
  ASSERT_EQ(ties.remaining().size(), 1U);
  EXPECT_EQ(ties.remaining()[0].pointer, "/shared_points/2");
}

TEST(NodeTiesTest, BodiesAndTheGroundRemainAsPairs) {
  NodeTies ties(0);
  ties.Tie(Body(0), Body(1), "/shared_points/0");
  ties.Tie(ResolvedGround{}, Body(1), "/shared_points/1");
  EXPECT_EQ(ties.remaining().size(), 2U);
}

TEST(NodeTiesTest, TyingTwiceChangesNothing) {
  NodeTies ties(2);
  ties.Tie(ResolvedNode{0}, ResolvedNode{1}, "/shared_points/0");
  ties.Tie(ResolvedNode{1}, ResolvedNode{0}, "/shared_points/1");
  EXPECT_EQ(ties.Representative(0), ties.Representative(1));
  EXPECT_TRUE(ties.remaining().empty());
}

}  // namespace
}  // namespace emmy
