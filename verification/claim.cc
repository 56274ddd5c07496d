#include "verification/claim.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace emmy::verification {

double Margin(const Bound& bound, double value) {
  if (std::isnan(value)) return value;
  const bool below = std::isfinite(bound.upper);
  const bool above = std::isfinite(bound.lower);
  if (below && above) {
    const double half = 0.5 * (bound.upper - bound.lower);
    const double inside = std::min(value - bound.lower, bound.upper - value);
    // A bound of one number has no middle: on it or off it.
    if (half == 0.0) return inside == 0.0 ? 0.0 : inside;
    return inside / half;
  }
  const double limit = below ? bound.upper : bound.lower;
  const double inside = below ? limit - value : value - limit;
  return limit != 0.0 ? inside / std::abs(limit) : inside;
}

Outcome Judge(const Claim& claim, Level level,
              const absl::StatusOr<ClaimResult>& measured) {
  Outcome outcome;
  outcome.claim = &claim;
  outcome.level = level;
  outcome.margin = std::numeric_limits<double>::quiet_NaN();
  if (!measured.ok()) {
    outcome.failure = std::string(measured.status().message());
    return outcome;
  }
  outcome.result = *measured;
  if (measured->values.empty()) {
    outcome.failure = "nothing was measured";
    return outcome;
  }
  outcome.pass = true;
  for (const MetricValue& value : measured->values) {
    const double margin = Margin(claim.bound, value.value);
    // Written so that NaN fails, and stays the worst once it has appeared.
    const bool keeps =
        value.value >= claim.bound.lower && value.value <= claim.bound.upper;
    if (!keeps) {
      outcome.pass = false;
      absl::StrAppend(
          &outcome.failure, outcome.failure.empty() ? "" : "; ",
          absl::StrFormat("%s: %.4g%s, bound %s", value.label, value.value,
                          claim.unit == "-" ? "" : " " + claim.unit,
                          BoundText(claim.bound)));
    }
    const bool first = &value == &measured->values.front();
    if (first || (!std::isnan(outcome.margin) && !(margin >= outcome.margin))) {
      outcome.margin = margin;
      outcome.worst = value;
    }
  }
  return outcome;
}

Outcome RunClaim(const Claim& claim, const ClaimSetting& setting) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome = Judge(claim, setting.level, claim.measure(setting));
  outcome.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
  return outcome;
}

std::string ReferenceName(Reference reference) {
  switch (reference) {
    case Reference::kExact:
      return "exact";
    case Reference::kPublished:
      return "published";
    case Reference::kCrossFormulation:
      return "cross-formulation";
    case Reference::kRegression:
      return "regression";
  }
  return "unknown";
}

std::string LevelName(Level level) {
  return level == Level::kQuick ? "quick" : "full";
}

std::string BoundText(const Bound& bound) {
  const bool below = std::isfinite(bound.upper);
  const bool above = std::isfinite(bound.lower);
  if (below && above) {
    return absl::StrFormat("%g ... %g", bound.lower, bound.upper);
  }
  if (above) return absl::StrFormat(">= %g", bound.lower);
  return absl::StrFormat("<= %g", bound.upper);
}

}  // namespace emmy::verification
