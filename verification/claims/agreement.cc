// Both formulations of the same rigid body: how their attitudes approach each
// other as the penalty grows.

#include "absl/strings/str_format.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/motion_error.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

// Attitudes of both formulations; undeformed start.
absl::StatusOr<ClaimResult> AttitudeAgreement(
    const ClaimSetting& setting, ModelDescription (*ancf)(double),
    const ModelDescription& conventional) {
  constexpr ReadingTimes kTimes = {.interval = 0.01, .duration = 10.0};
  const IntegratorOptions options{.time_step = 1e-3};
  const absl::StatusOr<std::vector<BodyMotion>> rigid =
      ReadMotion(conventional, options, kTimes, setting.scheme);
  if (!rigid.ok()) return rigid.status();
  const std::vector<double> penalties =
      PowersOfTen(6, 10, IsFull(setting) ? 1 : 2);
  std::vector<double> errors;
  ClaimResult result;
  for (const double penalty : penalties) {
    const absl::StatusOr<std::vector<BodyMotion>> motion =
        ReadMotion(ancf(penalty), options, kTimes, setting.scheme);
    if (!motion.ok()) return motion.status();
    errors.push_back(LargestError(*motion, *rigid).attitude);
    result.notes.push_back(
        absl::StrFormat("%s: %.3g rad", PenaltyLabel(penalty), errors.back()));
  }
  result.values = {{"exponent", FitPower(penalties, errors)}};
  return result;
}

ModelDescription UndeformedBox(double penalty) { return PaperBoxAncf(penalty); }

}  // namespace

std::vector<Claim> AgreementClaims() {
  std::vector<Claim> claims;
  constexpr char kAttitudeDerivation[] =
      "p = -1: the angular velocity errs as 1/alpha (penalty/locked_exponent) "
      "and the attitude with it; the strain itself, which the polar attitude "
      "does not see, is as large. Ten per cent for the ends";
  claims.push_back(
      {.id = "agreement/box_attitude",
       .sentence = "The attitude of the ANCF body approaches the conventional "
                   "body's as 1/alpha.",
       .equations = "(ATT-1), (CRB-3)",
       .reference = Reference::kCrossFormulation,
       .metric = "p of max angle between the attitudes over 10 s = C alpha^p, "
                 "alpha = 1e6 ... 1e10 Pa, dt = 1 ms",
       .unit = "-",
       .bound = {.lower = -1.1,
                 .upper = -0.9,
                 .derivation = kAttitudeDerivation},
       .measure = [](const ClaimSetting& setting) {
         return AttitudeAgreement(setting, UndeformedBox,
                                  PaperBoxConventional());
       }});
  claims.push_back(
      {.id = "agreement/truss_attitude",
       .sentence = "With a truss on it as well, the attitude of the ANCF "
                   "body approaches the conventional body's as 1/alpha.",
       .equations = "(ATT-1), (CRB-6..8)",
       .reference = Reference::kCrossFormulation,
       .metric = "p of max angle between the attitudes over 10 s = C alpha^p, "
                 "alpha = 1e6 ... 1e10 Pa, dt = 1 ms",
       .unit = "-",
       .bound = {.lower = -1.1,
                 .upper = -0.9,
                 .derivation = kAttitudeDerivation},
       .measure = [](const ClaimSetting& setting) {
         return AttitudeAgreement(setting, PaperTrussAncf,
                                  PaperTrussConventional());
       }});
  return claims;
}

}  // namespace emmy::verification
