#include "verification/report/html_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_format.h"
#include "tests/support/well_formed.h"
#include "tests/verification/sample_outcome.h"
#include "tests/verification/wrong_schemes.h"
#include "verification/registry.h"
#include "verification/report/html_text.h"

namespace emmy::verification {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Page(const std::vector<Outcome>& outcomes,
                 const FigureImages& images = {}) {
  return HtmlPage(outcomes, SampleEnvironment(), images);
}

// From `begin` up to `end`.
std::string Part(const std::string& page, const std::string& begin,
                 const std::string& end) {
  const size_t from = page.find(begin);
  EXPECT_NE(from, std::string::npos) << begin;
  return page.substr(from, page.find(end, from) - from);
}

TEST(HtmlPageTest, HeadIsGreenIfAllClaimsHold) {
  const Claim claim = SampleClaim("group/name");
  const std::string page = Page({SampleOutcome(claim, {0.5})});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(
      Part(page, "<header", "</header>"),
      AllOf(HasSubstr("verdict green"), HasSubstr("All 1 claims hold"),
            HasSubstr("<strong>0</strong> failed"), HasSubstr("quick level"),
            HasSubstr("2024-02-29 12:00:00 UTC"), HasSubstr("1 min 15 s")));
  EXPECT_THAT(page, Not(HasSubstr("id=\"failures\"")));
}

TEST(HtmlPageTest, FailureComesFirstWithBoundValueMarginCommandAndAdvice) {
  const Claim good = SampleClaim("group/good");
  const Claim bad = SampleClaim("group/bad");
  const std::string page =
      Page({SampleOutcome(good, {0.5}), SampleOutcome(bad, {1.0, 3.0})});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(Part(page, "<header", "</header>"),
              AllOf(HasSubstr("verdict red"), HasSubstr("1 of 2 claims failed"),
                    HasSubstr("<strong>1</strong> passed")));
  EXPECT_LT(page.find("id=\"failures\""), page.find("id=\"claims\""));
  EXPECT_THAT(
      Part(page, "id=\"failures\"", "</section>"),
      AllOf(HasSubstr("group/bad"), Not(HasSubstr("group/good")),
            HasSubstr("value 1: " + HtmlNumber(3.0)), Not(HasSubstr("value 0")),
            HasSubstr("≤ " + HtmlNumber(2.0)), HasSubstr("margin −50&#8239;%"),
            HasSubstr("because of rounding"),
            HasSubstr("emmy verify --only group/bad --level quick"),
            HasSubstr("Compare compiler and flags")));
}

TEST(HtmlPageTest, WrongSchemeMakesItRed) {
  ClaimSetting setting;
  setting.scheme = BiasedRounding(1e-16);
  const Outcome outcome = RunClaim(*FindClaim("figures/paper_6"), setting);
  const std::string page = Page({outcome});
  EXPECT_THAT(page, HasSubstr("verdict red"));
  EXPECT_THAT(
      Part(page, "id=\"failures\"", "</section>"),
      AllOf(HasSubstr(HtmlNumber(outcome.worst.value)),
            HasSubstr("≤ " + HtmlNumber(outcome.claim->bound.upper)),
            HasSubstr("emmy verify --only figures/paper_6 --level quick")));
}

TEST(HtmlPageTest, NanIsAFailureThatSaysWhatToLookFor) {
  const Claim claim = SampleClaim("group/name");
  EXPECT_THAT(Page({SampleOutcome(claim, {0.5, kNan})}),
              AllOf(HasSubstr("verdict red"), HasSubstr(">NaN</data>"),
                    HasSubstr("A value is not a number")));
}

TEST(HtmlPageTest, WhatCouldNotBeMeasuredSaysWhy) {
  const Claim claim = SampleClaim("group/name");
  const std::string page = Page({Judge(
      claim, Level::kQuick, absl::NotFoundError("no <file> & nothing"))});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(Part(page, "id=\"failures\"", "</section>"),
              AllOf(HasSubstr("no &lt;file&gt; &amp; nothing"),
                    HasSubstr("Nothing could be measured")));
}

TEST(HtmlPageTest, NoClaimIsNoSuccess) {
  const std::string page = Page({});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(
      page, AllOf(HasSubstr("verdict red"), HasSubstr("No claim was checked")));
}

TEST(HtmlPageTest, NumbersAreTheOutcomesToTheLastDigit) {
  const Claim claim = SampleClaim("group/name");
  const std::string page = Page({SampleOutcome(claim, {1.0 / 3.0, 0.1})});
  for (const double value : {1.0 / 3.0, 0.1, 2.0}) {
    EXPECT_THAT(page, HasSubstr(absl::StrFormat("value=\"%.17g\"", value)));
  }
}

TEST(HtmlPageTest, TextIsNeverMarkup) {
  const std::string evil = "</script><b onclick='x'>&\"";
  Claim claim = SampleClaim("group/name");
  claim.sentence = claim.metric = claim.equations = claim.unit = evil;
  claim.bound.derivation = evil;
  Figure figure = SampleFigure();
  figure.title = figure.columns[0].name = evil;
  Outcome outcome = SampleOutcome(claim, {3.0}, {figure});
  outcome.result.notes = {evil};
  outcome.result.values[0].label = evil;
  Environment environment = SampleEnvironment();
  environment.command = environment.processor = environment.system = evil;
  environment.date = environment.build.flags = evil;
  const std::string page = HtmlPage({outcome}, environment, {});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<b ")));
}

TEST(HtmlPageTest, FigureIsInsideWithItsDataAndScript) {
  const Claim claim = SampleClaim("group/name");
  const Figure figure = SampleFigure();
  const std::string page = Page({SampleOutcome(claim, {0.5}, {figure})},
                                {{"sample", "<svg>1</svg>"}});
  EXPECT_THAT(page,
              AllOf(HasSubstr(DataUri("image/svg+xml", "<svg>1</svg>")),
                    HasSubstr("alt=\"A sample: time [s], x [m]\""),
                    HasSubstr("download=\"sample.csv\" href=\"" +
                              DataUri("text/csv", FigureCsv(figure))),
                    HasSubstr("download=\"sample.gp\" href=\"" +
                              DataUri("text/plain", FigureScript(figure)))));
}

TEST(HtmlPageTest, FigureThatWasNotDrawnIsANoteWithTheData) {
  const Claim claim = SampleClaim("group/name");
  const std::string page =
      Page({SampleOutcome(claim, {0.5}, {SampleFigure()})});
  EXPECT_EQ(ProblemInMarkup(page), "");
  EXPECT_THAT(page, AllOf(HasSubstr("Not drawn"), Not(HasSubstr("<img")),
                          HasSubstr("download=\"sample.csv\"")));
}

TEST(HtmlPageTest, ClaimWithoutFigureHasNone) {
  const Claim claim = SampleClaim("group/name");
  EXPECT_THAT(Page({SampleOutcome(claim, {0.5})}), Not(HasSubstr("<figure")));
}

TEST(HtmlPageTest, AsksForNothingFromOutside) {
  const Claim claim = SampleClaim("group/name");
  const std::string page = Page({SampleOutcome(claim, {0.5})});
  EXPECT_THAT(page, AllOf(Not(HasSubstr("http://")), Not(HasSubstr("https://")),
                          Not(HasSubstr("url(")), Not(HasSubstr("@import")),
                          HasSubstr("default-src &#39;none&#39;")));
}

TEST(HtmlPageTest, GroupHasItsEquationsAndClaims) {
  const Claim claim = SampleClaim("conservation/name");
  const std::string part = Part(Page({SampleOutcome(claim, {0.5})}),
                                "id=\"group-conservation\"", "</section>");
  EXPECT_THAT(part,
              AllOf(HasSubstr("<h2>Conservation</h2>"), HasSubstr("(EM-1)"),
                    HasSubstr("(EM-3)"), HasSubstr("<math>"),
                    HasSubstr("id=\"claim-conservation-name\""),
                    HasSubstr("<li>a note</li>")));
}

TEST(HtmlPageTest, SaysWhereAndHowItWasMade) {
  EXPECT_THAT(Part(Page({}), "id=\"environment\"", "</section>"),
              AllOf(HasSubstr("9.8.7"), HasSubstr("Cc 1"), HasSubstr("-O9"),
                    HasSubstr("Abacus"), HasSubstr("<dd>3</dd>"),
                    HasSubstr("Some system"),
                    HasSubstr("emmy verify --output &#39;a b&#39;")));
}

}  // namespace
}  // namespace emmy::verification
