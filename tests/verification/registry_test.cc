#include "verification/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace emmy::verification {
namespace {

using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;

TEST(RegistryTest, EveryClaimSaysWhatItMeasuresAndWhereItsBoundComesFrom) {
  std::set<std::string> ids;
  for (const Claim& claim : AllClaims()) {
    EXPECT_TRUE(ids.insert(claim.id).second) << claim.id << " occurs twice";
    EXPECT_THAT(claim.id, MatchesRegex("[a-z_]+/[a-z0-9_]+"));
    EXPECT_THAT(claim.sentence, MatchesRegex("[A-Z].*[.]")) << claim.id;
    EXPECT_THAT(claim.equations, Not(IsEmpty())) << claim.id;
    EXPECT_THAT(claim.metric, Not(IsEmpty())) << claim.id;
    EXPECT_THAT(claim.unit, Not(IsEmpty())) << claim.id;
    EXPECT_GT(claim.bound.derivation.size(), 10U) << claim.id;
    EXPECT_TRUE(std::isfinite(claim.bound.lower) ||
                std::isfinite(claim.bound.upper))
        << claim.id;
    EXPECT_LE(claim.bound.lower, claim.bound.upper) << claim.id;
    EXPECT_TRUE(claim.measure) << claim.id;
  }
}

TEST(RegistryTest, FindsByIdOnly) {
  EXPECT_EQ(FindClaim("order/ancf_body")->id, "order/ancf_body");
  EXPECT_EQ(FindClaim("order"), nullptr);
  EXPECT_EQ(FindClaim(""), nullptr);
}

TEST(RunClaimsTest, OutcomesDoNotDependOnTheNumberOfThreads) {
  const std::vector<const Claim*> claims = {FindClaim("figures/paper_6"),
                                            FindClaim("external/positions"),
                                            FindClaim("penalty/locked_error")};
  size_t finished = 0;
  const auto count = [&finished](const Outcome&) { ++finished; };
  const std::vector<Outcome> one = RunClaims(claims, ClaimSetting(), 1, count);
  const std::vector<Outcome> four = RunClaims(claims, ClaimSetting(), 4, count);
  EXPECT_EQ(finished, 6U);
  for (size_t i = 0; i < claims.size(); ++i) {
    EXPECT_EQ(one[i].claim, claims[i]);
    EXPECT_EQ(four[i].claim, claims[i]);
    EXPECT_GT(one[i].wall_seconds, 0.0);
    ASSERT_EQ(one[i].result.values.size(), four[i].result.values.size());
    for (size_t k = 0; k < one[i].result.values.size(); ++k) {
      EXPECT_EQ(one[i].result.values[k].value, four[i].result.values[k].value);
    }
  }
}

}  // namespace
}  // namespace emmy::verification
