#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/schema_checker.h"
#include "tests/verification/sample_outcome.h"
#include "verification/report/json_report.h"
#include "verification/report/text_report.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

class ReportTest : public ::testing::Test {
 protected:
  Outcome With(double value) const { return SampleOutcome(claim_, {value}); }

  Claim claim_ = SampleClaim("group/name");
};

TEST_F(ReportTest, LineHasVerdictValueBoundAndMargin) {
  EXPECT_THAT(OutcomeText(With(0.5)),
              AllOf(HasSubstr("group/name"), HasSubstr("ok"),
                    HasSubstr("0.5 m  bound <= 2 m  margin 75 %  (value 0)"),
                    HasSubstr("a note")));
  EXPECT_THAT(OutcomeText(With(3.0)), HasSubstr("FAILED"));
}

TEST_F(ReportTest, FailureGivesIdValueBoundReasonAndTheCommand) {
  EXPECT_THAT(VerdictText({With(0.5), With(3.0)}),
              AllOf(HasSubstr("FAILED group/name"), HasSubstr("value 0: 3 m"),
                    HasSubstr("<= 2 (because of rounding)"),
                    HasSubstr("emmy verify --only group/name --level quick"),
                    HasSubstr("1 of 2 claims hold (quick level)")));
}

TEST_F(ReportTest, JsonSaysWhereAndHowItWasMadeAndHowLongItTook) {
  const auto json =
      nlohmann::json::parse(JsonReport({With(0.5)}, SampleEnvironment()));
  EXPECT_EQ(json.at("date"), "2024-02-29T12:00:00Z");
  EXPECT_EQ(json.at("wall_seconds"), 75.0);
  EXPECT_EQ(json.at("machine").at("threads"), 3);
  EXPECT_EQ(json.at("machine").at("processor"), "Abacus");
  EXPECT_EQ(json.at("command"), "emmy verify --output 'a b'");
  EXPECT_EQ(json.at("claims").at(0).at("wall_seconds"), 0.25);
}

TEST_F(ReportTest, JsonHasTheVerdictAndEveryValue) {
  const auto json = nlohmann::json::parse(
      JsonReport({With(0.5), With(3.0)}, SampleEnvironment()));
  EXPECT_EQ(json.at("format"), "emmy-report/1");
  EXPECT_EQ(json.at("pass"), false);
  EXPECT_EQ(json.at("claims").at(0).at("pass"), true);
  EXPECT_EQ(json.at("claims").at(1).at("values").at(0).at("value"), 3.0);
  EXPECT_EQ(json.at("claims").at(1).at("bound").at("lower"), "-inf");
}

TEST_F(ReportTest, JsonOfANumberThatIsNoneIsAString) {
  const auto json =
      nlohmann::json::parse(JsonReport({With(kNan)}, SampleEnvironment()));
  EXPECT_EQ(json.at("claims").at(0).at("values").at(0).at("value"), "nan");
  EXPECT_EQ(json.at("claims").at(0).at("margin"), "nan");
}

class ReportSchemaTest : public ReportTest {
 protected:
  const nlohmann::json schema_ = nlohmann::json::parse(
      std::ifstream(EMMY_SOURCE_DIR "/verification/report/report.schema.json"));
  const nlohmann::json report_ = nlohmann::json::parse(JsonReport(
      {With(0.5), With(kNan),
       SampleOutcome(claim_, {1.0, 3.0}, {SampleFigure()}),
       Judge(claim_, Level::kFull, absl::InternalError("not measured"))},
      SampleEnvironment()));
  const SchemaChecker checker_{schema_};
};

TEST_F(ReportSchemaTest, EveryReportIsValid) {
  EXPECT_TRUE(checker_.IsValid(report_));
  EXPECT_TRUE(checker_.IsValid(
      nlohmann::json::parse(JsonReport({}, SampleEnvironment()))));
}

TEST_F(ReportSchemaTest, AnyKeyMissingOrTooManyIsInvalid) {
  const nlohmann::json flat = report_.flatten();
  for (const auto& member : flat.items()) {
    const nlohmann::json::json_pointer place(member.key());
    const auto parent = place.parent_pointer();
    if (!report_.at(parent).is_object()) continue;
    nlohmann::json changed = report_;
    changed[parent].erase(place.back());
    EXPECT_FALSE(checker_.IsValid(changed)) << "without " << member.key();
    changed = report_;
    changed[parent]["extra"] = 1;
    EXPECT_FALSE(checker_.IsValid(changed)) << "extra at " << member.key();
    changed = report_;
    changed[place] = nullptr;
    EXPECT_FALSE(checker_.IsValid(changed)) << "null at " << member.key();
  }
}

}  // namespace
}  // namespace emmy::verification
