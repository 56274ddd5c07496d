#include "verification/report/theory_equations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "verification/registry.h"
#include "verification/report/group_text.h"

namespace emmy::verification {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

TEST(ParseEquationsTest, ReadsQuotedParagraphsThatEndInATag) {
  EXPECT_THAT(ParseEquations("Text (EM-9).\n\n> a = 1 — **(AB-1)**\n>\n> b =\n"
                             "> 2 —\n> **(AB-12)**\n\n> no tag\n"
                             "3. > c — **(CD-1)**\n\n   more\n"),
              ElementsAre(Pair("AB-1", "a = 1"), Pair("AB-12", "b = 2"),
                          Pair("CD-1", "c")));
}

TEST(TheoryEquationsTest, AreAllThatThePageDefines) {
  std::ifstream in(EMMY_SOURCE_DIR "/docs/theory.md");
  std::stringstream page;
  page << in.rdbuf();
  const std::string text = page.str();
  const std::regex definition(R"(\*\*\(([A-Z]+-[0-9]+)\)\*\*)");
  std::set<std::string> defined;
  for (std::sregex_iterator match(text.begin(), text.end(), definition);
       match != std::sregex_iterator(); ++match) {
    defined.insert((*match)[1]);
  }
  std::set<std::string> read;
  for (const auto& [tag, equation] : TheoryEquations()) {
    read.insert(tag);
    EXPECT_THAT(equation, Not(IsEmpty())) << tag;
  }
  EXPECT_EQ(read, defined);
}

TEST(CitedTagsTest, WritesRangesOutAndNamesEachOnce) {
  EXPECT_THAT(CitedTags("(EM-1..3), (QS-1); paper (27), (EM-2)"),
              ElementsAre("EM-1", "EM-2", "EM-3", "QS-1"));
  EXPECT_THAT(CitedTags("paper, figure 5"), IsEmpty());
}

TEST(CitedTagsTest, EveryTagThatAClaimCitesHasAnEquation) {
  for (const Claim& claim : AllClaims()) {
    for (const std::string& tag : CitedTags(claim.equations)) {
      EXPECT_EQ(TheoryEquations().count(tag), 1U) << claim.id << ": " << tag;
    }
  }
}

TEST(CitedTagsTest, EveryGroupOfClaimsRestsOnAnEquationAndIsIntroduced) {
  std::map<std::string, size_t> groups;
  for (const Claim& claim : AllClaims()) {
    groups[claim.group()] += CitedTags(claim.equations).size();
  }
  for (const auto& [group, count] : groups) {
    EXPECT_GT(count, 0U) << group;
    EXPECT_THAT(DescribeGroup(group).introduction, Not(IsEmpty()))
        << group << ": write one in verification/report/group_text.cc";
  }
}

TEST(DescribeGroupTest, AnUnknownGroupIsItsName) {
  EXPECT_EQ(DescribeGroup("no_such").title, "No such");
}

}  // namespace
}  // namespace emmy::verification
