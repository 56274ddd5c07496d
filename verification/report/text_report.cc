#include "verification/report/text_report.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace emmy::verification {

std::string OutcomeText(const Outcome& outcome) {
  const Claim& claim = *outcome.claim;
  const char* verdict = outcome.pass ? "ok" : "FAILED";
  const std::string unit = claim.unit == "-" ? "" : " " + claim.unit;
  if (outcome.result.values.empty()) {
    return absl::StrFormat("%-34s %-6s %s\n", claim.id, verdict,
                           outcome.failure);
  }
  std::string text = absl::StrFormat(
      "%-34s %-6s %10.3g%s  bound %s%s  margin %.0f %%  (%s)\n", claim.id,
      verdict, outcome.worst.value, unit, BoundText(claim.bound), unit,
      100.0 * outcome.margin, outcome.worst.label);
  for (const std::string& note : outcome.result.notes) {
    absl::StrAppend(&text, "    ", note, "\n");
  }
  return text;
}

std::string VerdictText(const std::vector<Outcome>& outcomes) {
  std::string failures;
  size_t passed = 0;
  for (const Outcome& outcome : outcomes) {
    if (outcome.pass) {
      ++passed;
      continue;
    }
    const Claim& claim = *outcome.claim;
    absl::StrAppend(
        &failures, "FAILED ", claim.id, ": ", claim.sentence,
        "\n    measured: ", claim.metric, "\n    result:   ", outcome.failure,
        "\n    bound:    ", BoundText(claim.bound), " (",
        claim.bound.derivation, ")", "\n    again:    ", claim.command(),
        " --level ", LevelName(outcome.level), "\n");
  }
  return absl::StrCat(
      failures,
      absl::StrFormat("%d of %d claims hold (%s level)\n", passed,
                      outcomes.size(),
                      outcomes.empty() ? "no" : LevelName(outcomes[0].level)));
}

}  // namespace emmy::verification
