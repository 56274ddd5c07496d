#include "verification/report/claim_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/status/status.h"
#include "verification/reference/artifact.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ClaimTableTest, TableOfTheReadmeIsTheRegistrys) {
  const absl::StatusOr<std::string> difference =
      FindArtifact("claim_table")->compare(EMMY_SOURCE_DIR);
  ASSERT_TRUE(difference.ok()) << difference.status();
  EXPECT_THAT(*difference, IsEmpty())
      << "run: emmy regenerate --only claim_table";
}

TEST(ClaimTableTest, ReplacesOnlyWhatStandsBetweenTheMarks) {
  Claim claim;
  claim.id = "group/name";
  claim.sentence = "A sentence.";
  claim.metric = "|x|";
  claim.unit = "m";
  claim.bound = {.lower = 0.0, .upper = 2.0, .derivation = "why"};
  const absl::StatusOr<std::string> text = ReplaceClaimTable(
      "before\n<!-- claims: begin (x) -->\nold\n<!-- claims: end -->\nafter\n",
      {claim});
  ASSERT_TRUE(text.ok());
  EXPECT_THAT(*text, HasSubstr("before\n<!-- claims: begin (x) -->\n| id |"));
  EXPECT_THAT(*text, HasSubstr("\\|x\\| [m] | 0 ... 2 | why |\n"
                               "<!-- claims: end -->\nafter\n"));
  EXPECT_THAT(*text, Not(HasSubstr("old")));
}

TEST(ClaimTableTest, DocumentWithoutMarksIsAnError) {
  EXPECT_TRUE(absl::IsNotFound(ReplaceClaimTable("no marks", {}).status()));
}

}  // namespace
}  // namespace emmy::verification
