#include "verification/report/junit_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/status/status.h"
#include "tests/support/well_formed.h"
#include "tests/verification/sample_outcome.h"

namespace emmy::verification {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(JunitReportTest, HasASuiteForEachGroupAndCountsFailuresAndErrors) {
  const Claim a = SampleClaim("first/a");
  const Claim b = SampleClaim("first/b");
  const Claim c = SampleClaim("second/c");
  const std::string text =
      JunitReport({SampleOutcome(a, {0.5}), SampleOutcome(b, {3.0}),
                   Judge(c, Level::kQuick, absl::InternalError("broke"))},
                  SampleEnvironment());
  EXPECT_EQ(ProblemInMarkup(text), "");
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("<testsuites name=\"emmy verify\" tests=\"3\" "
                      "failures=\"1\" errors=\"1\" skipped=\"0\" "
                      "time=\"75.000000\">"),
            HasSubstr("<testsuite name=\"first\" tests=\"2\" failures=\"1\" "
                      "errors=\"0\" skipped=\"0\" time=\"0.500000\" "
                      "timestamp=\"2024-02-29T12:00:00Z\">"),
            HasSubstr("<testcase classname=\"emmy.first\" name=\"a\" "
                      "time=\"0.250000\">\n      <system-out>"),
            HasSubstr("<error type=\"measurement\" message=\"broke\">")));
}

TEST(JunitReportTest, FailureSaysValueBoundAndCommand) {
  const Claim claim = SampleClaim("group/name");
  EXPECT_THAT(
      JunitReport({SampleOutcome(claim, {kNan})}, SampleEnvironment()),
      AllOf(HasSubstr("<failure type=\"bound\" message=\"value 0: nan m, bound "
                      "&lt;= 2\">"),
            HasSubstr("bound: &lt;= 2 (because of rounding)"),
            HasSubstr("again: emmy verify --only group/name --level quick")));
}

TEST(JunitReportTest, TextIsNeverMarkup) {
  Claim claim = SampleClaim("group/name");
  claim.sentence = claim.bound.derivation = claim.metric = "]]></a>\"'&\x01";
  EXPECT_EQ(ProblemInMarkup(JunitReport({SampleOutcome(claim, {3.0})},
                                        SampleEnvironment())),
            "");
}

}  // namespace
}  // namespace emmy::verification
