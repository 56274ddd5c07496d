#include "verification/report/junit_report.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "verification/report/html_claim.h"
#include "verification/report/html_text.h"
#include "verification/report/text_report.h"

namespace emmy::verification {
namespace {

struct Suite {
  std::string group;
  std::string cases;
  size_t tests = 0;
  size_t failures = 0;
  size_t errors = 0;
  double seconds = 0.0;
};

std::string Counts(const Suite& suite, double seconds) {
  return absl::StrFormat(
      "tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"0\" time=\"%.6f\"",
      suite.tests, suite.failures, suite.errors, seconds);
}

void Add(const Outcome& outcome, Suite* suite) {
  const Claim& claim = *outcome.claim;
  ++suite->tests;
  suite->seconds += outcome.wall_seconds;
  absl::StrAppend(&suite->cases, "    <testcase classname=\"emmy.",
                  EscapeHtml(claim.group()), "\" name=\"",
                  EscapeHtml(claim.id.substr(claim.group().size() + 1)),
                  absl::StrFormat("\" time=\"%.6f\">\n", outcome.wall_seconds));
  if (!outcome.pass) {
    const bool measured = !outcome.result.values.empty();
    ++(measured ? suite->failures : suite->errors);
    const char* element = measured ? "failure" : "error";
    absl::StrAppend(
        &suite->cases, "      <", element, " type=\"",
        measured ? "bound" : "measurement", "\" message=\"",
        EscapeHtml(outcome.failure), "\">",
        EscapeHtml(absl::StrCat(
            claim.sentence, "\nmeasured: ", claim.metric,
            "\nresult: ", outcome.failure, "\nbound: ", BoundText(claim.bound),
            " (", claim.bound.derivation, ")\nagain: ", RerunCommand(outcome))),
        "</", element, ">\n");
  }
  absl::StrAppend(&suite->cases, "      <system-out>",
                  EscapeHtml(OutcomeText(outcome)),
                  "</system-out>\n    </testcase>\n");
}

}  // namespace

std::string JunitReport(const std::vector<Outcome>& outcomes,
                        const Environment& environment) {
  std::vector<Suite> suites;
  Suite total;
  for (const Outcome& outcome : outcomes) {
    // The registry keeps the claims of a group together.
    if (suites.empty() || suites.back().group != outcome.claim->group()) {
      suites.push_back({.group = outcome.claim->group(), .cases = ""});
    }
    Add(outcome, &suites.back());
  }
  std::string text;
  for (const Suite& suite : suites) {
    total.tests += suite.tests;
    total.failures += suite.failures;
    total.errors += suite.errors;
    absl::StrAppend(&text, "  <testsuite name=\"", EscapeHtml(suite.group),
                    "\" ", Counts(suite, suite.seconds), " timestamp=\"",
                    EscapeHtml(environment.date), "\">\n", suite.cases,
                    "  </testsuite>\n");
  }
  return absl::StrCat("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
                      "<testsuites name=\"emmy verify\" ",
                      Counts(total, environment.wall_seconds), ">\n", text,
                      "</testsuites>\n");
}

}  // namespace emmy::verification
