#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "verification/report/json_report.h"
#include "verification/report/text_report.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

class ReportTest : public ::testing::Test {
 protected:
  ReportTest() {
    claim_.id = "group/name";
    claim_.sentence = "It holds.";
    claim_.metric = "the error";
    claim_.unit = "m";
    claim_.bound.upper = 2.0;
    claim_.bound.derivation = "because";
  }

  Outcome With(double value) const {
    ClaimResult result;
    result.values = {{"first", value}};
    result.notes = {"a note"};
    return Judge(claim_, Level::kQuick, result);
  }

  Claim claim_;
};

TEST_F(ReportTest, LineHasVerdictValueBoundAndMargin) {
  EXPECT_THAT(OutcomeText(With(0.5)),
              AllOf(HasSubstr("group/name"), HasSubstr("ok"),
                    HasSubstr("0.5 m  bound <= 2 m  margin 75 %  (first)"),
                    HasSubstr("a note")));
  EXPECT_THAT(OutcomeText(With(3.0)), HasSubstr("FAILED"));
}

TEST_F(ReportTest, FailureGivesIdValueBoundReasonAndTheCommand) {
  EXPECT_THAT(VerdictText({With(0.5), With(3.0)}),
              AllOf(HasSubstr("FAILED group/name"), HasSubstr("first: 3 m"),
                    HasSubstr("<= 2 (because)"),
                    HasSubstr("emmy verify --only group/name --level quick"),
                    HasSubstr("1 of 2 claims hold (quick level)")));
}

TEST_F(ReportTest, JsonHasTheVerdictAndEveryValue) {
  const auto json = nlohmann::json::parse(JsonReport({With(0.5), With(3.0)}));
  EXPECT_EQ(json.at("format"), "emmy-report/1");
  EXPECT_EQ(json.at("pass"), false);
  EXPECT_EQ(json.at("claims").at(0).at("pass"), true);
  EXPECT_EQ(json.at("claims").at(1).at("values").at(0).at("value"), 3.0);
  EXPECT_EQ(json.at("claims").at(1).at("bound").at("lower"), "-inf");
}

TEST_F(ReportTest, JsonOfANumberThatIsNoneIsAString) {
  const auto json = nlohmann::json::parse(
      JsonReport({With(std::numeric_limits<double>::quiet_NaN())}));
  EXPECT_EQ(json.at("claims").at(0).at("values").at(0).at("value"), "nan");
  EXPECT_EQ(json.at("claims").at(0).at("margin"), "nan");
}

}  // namespace
}  // namespace emmy::verification
