// Claims and outcomes to report on, without measuring anything.

#ifndef EMMY_TESTS_VERIFICATION_SAMPLE_OUTCOME_H_
#define EMMY_TESTS_VERIFICATION_SAMPLE_OUTCOME_H_

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "verification/claim.h"
#include "verification/report/environment.h"

namespace emmy::verification {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// value <= 2 m.
inline Claim SampleClaim(const std::string& id) {
  Claim claim;
  claim.id = id;
  claim.sentence = "It holds.";
  claim.equations = "(EM-1..3); a paper";
  claim.metric = "the error";
  claim.unit = "m";
  claim.bound.upper = 2.0;
  claim.bound.derivation = "because of rounding";
  return claim;
}

inline Outcome SampleOutcome(const Claim& claim, std::vector<double> values,
                             std::vector<Figure> figures = {}) {
  ClaimResult result;
  for (size_t i = 0; i < values.size(); ++i) {
    result.values.push_back({"value " + std::to_string(i), values[i]});
  }
  result.notes = {"a note"};
  result.figures = std::move(figures);
  Outcome outcome = Judge(claim, Level::kQuick, result);
  outcome.wall_seconds = 0.25;
  return outcome;
}

inline Environment SampleEnvironment() {
  return {.build = {.version = "9.8.7", .compiler = "Cc 1", .flags = "-O9"},
          .processor = "Abacus",
          .system = "Some system",
          .threads = 3,
          .date = "2024-02-29T12:00:00Z",
          .command = "emmy verify --output 'a b'",
          .wall_seconds = 75.0};
}

inline Figure SampleFigure() {
  return {.name = "sample",
          .title = "A sample",
          .columns = {{"time [s]", {0.0, 0.1}}, {"x [m]", {1.0, 2.0}}},
          .script = "plot data using 1:2 title 'x'\n",
          .width = 640,
          .height = 480};
}

}  // namespace emmy::verification

#endif  // EMMY_TESTS_VERIFICATION_SAMPLE_OUTCOME_H_
