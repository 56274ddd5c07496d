#include "emmy/model/constraint_rank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace emmy {
namespace {

using ::testing::ElementsAre;

ModelConstraint Row(const std::string& name,
                    const std::vector<WeightedVector>& terms) {
  ModelConstraint constraint;
  constraint.name = name;
  constraint.terms = terms;
  return constraint;
}

std::vector<std::string> KeptNames(
    const std::vector<ModelConstraint>& constraints) {
  std::vector<std::string> names;
  for (const ModelConstraint& kept : IndependentConstraints(constraints)) {
    names.push_back(kept.name);
  }
  return names;
}

TEST(IndependentConstraintsTest, KeepsIndependentRowsUnchangedAndInOrder) {
  const std::vector<ModelConstraint> kept = IndependentConstraints(
      {Row("a", {{0, 1.0}, {1, -1.0}}), Row("b", {{1, 2.0}, {2, 0.5}})});
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].name, "a");
  EXPECT_EQ(kept[1].name, "b");
  ASSERT_EQ(kept[1].terms.size(), 2U);
  EXPECT_EQ(kept[1].terms[0].weight, 2.0);
  EXPECT_EQ(kept[1].terms[1].weight, 0.5);
}

TEST(IndependentConstraintsTest, DropsARepeatedRow) {
  EXPECT_THAT(KeptNames({Row("a", {{0, 1.0}, {1, -1.0}}),
                         Row("again", {{0, -2.0}, {1, 2.0}})}),
              ElementsAre("a"));
}

TEST(IndependentConstraintsTest, DropsTheThirdPointOnAnAxis) {
  // Points ξ₁ = −1, 0, 1 of two bodies (x̄, e₁) and (x̄', e₁').
  const auto at = [](const std::string& name, double xi) {
    return Row(name, {{0, 1.0}, {1, xi}, {2, -1.0}, {3, -xi}});
  };
  EXPECT_THAT(KeptNames({at("left", -1.0), at("right", 1.0), at("middle", 0)}),
              ElementsAre("left", "right"));
}

TEST(IndependentConstraintsTest, DropsTheRowThatClosesALoop) {
  EXPECT_THAT(
      KeptNames(
          {Row("ab", {{0, 1.0}, {1, -1.0}}), Row("bc", {{1, 1.0}, {2, -1.0}}),
           Row("cd", {{2, 1.0}, {3, -1.0}}), Row("da", {{3, 1.0}, {0, -1.0}})}),
      ElementsAre("ab", "bc", "cd"));
}

TEST(IndependentConstraintsTest, DropsARowDependentUpToRounding) {
  EXPECT_THAT(KeptNames({Row("a", {{0, 0.1}, {1, 0.3}}),
                         Row("b", {{0, 0.1 + 1e-16}, {1, 0.3}})}),
              ElementsAre("a"));
}

TEST(IndependentConstraintsTest, KeepsANearbyButIndependentRow) {
  EXPECT_THAT(KeptNames({Row("a", {{0, 1.0}, {1, 1.0}}),
                         Row("b", {{0, 1.0}, {1, 1.0 + 1e-6}})}),
              ElementsAre("a", "b"));
}

TEST(IndependentConstraintsTest, DecidesRelativeToTheSizeOfARow) {
  EXPECT_THAT(KeptNames({Row("a", {{0, 1e-15}, {1, -1e-15}}),
                         Row("b", {{0, 1e15}, {1, 1e15}})}),
              ElementsAre("a", "b"));
}

}  // namespace
}  // namespace emmy
