// Towards the rigid body: the angular velocity as the penalty grows.

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr int64_t kSteps = 10000;  // 10 s of 1 ms.

using Select = Vector3d BodyMotion::*;

// ω of the conventional body after every step; it has one of them.
absl::StatusOr<std::vector<Vector3d>> ConventionalOmega(const Scheme& scheme) {
  absl::StatusOr<Run> run =
      Run::Start(PaperBoxConventional(), kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  std::vector<Vector3d> omega;
  const absl::Status status = run->Advance(kSteps, [&](const Run& advanced) {
    omega.push_back(advanced.Motion().omega_locked);
  });
  if (!status.ok()) return status;
  return omega;
}

// max |ω − ω_conventional| over every step and component [rad/s].
absl::StatusOr<double> OmegaError(double penalty, Start start, Select select,
                                  const std::vector<Vector3d>& reference,
                                  const Scheme& scheme) {
  absl::StatusOr<Run> run =
      Run::Start(PaperBoxAncf(penalty, start), kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  double error = 0.0;
  const absl::Status status = run->Advance(kSteps, [&](const Run& advanced) {
    const auto step = static_cast<size_t>(advanced.state().step);
    const Vector3d difference = advanced.Motion().*select - reference[step - 1];
    error =
        Larger(error, difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  });
  if (!status.ok()) return status;
  return error;
}

struct Study {
  std::vector<double> penalties;
  std::vector<double> errors;
};

absl::StatusOr<Study> StudyPenalties(const ClaimSetting& setting,
                                     const std::vector<double>& penalties,
                                     Start start, Select select) {
  const absl::StatusOr<std::vector<Vector3d>> reference =
      ConventionalOmega(setting.scheme);
  if (!reference.ok()) return reference.status();
  Study study{.penalties = penalties, .errors = {}};
  for (const double penalty : penalties) {
    const absl::StatusOr<double> error =
        OmegaError(penalty, start, select, *reference, setting.scheme);
    if (!error.ok()) return error.status();
    study.errors.push_back(*error);
  }
  return study;
}

std::vector<double> Decades(const ClaimSetting& setting, int first, int last) {
  return PowersOfTen(first, last, IsFull(setting) ? 1 : 2);
}

absl::StatusOr<ClaimResult> Exponent(const ClaimSetting& setting, int first,
                                     int last, Start start, Select select) {
  const absl::StatusOr<Study> study =
      StudyPenalties(setting, Decades(setting, first, last), start, select);
  if (!study.ok()) return study.status();
  ClaimResult result;
  result.values = {{"exponent", FitPower(study->penalties, study->errors)}};
  for (size_t i = 0; i < study->errors.size(); ++i) {
    result.notes.push_back(absl::StrFormat(
        "%s: %.3g rad/s", PenaltyLabel(study->penalties[i]), study->errors[i]));
  }
  return result;
}

absl::StatusOr<ClaimResult> ErrorAt(const ClaimSetting& setting, double penalty,
                                    Start start,
                                    const std::vector<Select>& selects,
                                    const std::vector<std::string>& labels) {
  ClaimResult result;
  for (size_t i = 0; i < selects.size(); ++i) {
    const absl::StatusOr<Study> study =
        StudyPenalties(setting, {penalty}, start, selects[i]);
    if (!study.ok()) return study.status();
    result.values.push_back({labels[i], study->errors[0]});
  }
  return result;
}

constexpr char kMetric[] =
    "max |omega - omega of the conventional body| over 10 s, dt = 1 ms";

}  // namespace

std::vector<Claim> PenaltyClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "penalty/locked_exponent",
       .sentence = "The locked angular velocity approaches that of the "
                   "conventional body as 1/alpha.",
       .equations = "(ATT-4)",
       .reference = Reference::kCrossFormulation,
       .metric =
           std::string("p of C alpha^p, alpha = 1e6 ... 1e10 Pa: ") + kMetric,
       .unit = "-",
       .bound = {.lower = -1.1,
                 .upper = -0.9,
                 .derivation =
                     "p = -1: strains, and with them J(e), are wrong by "
                     "M omega^2 / b. Ten per cent for the ends, where the "
                     "next term in 1/alpha and the order of dt show"},
       .measure = [](const ClaimSetting& setting) {
         return Exponent(setting, 6, 10, Start::kUndeformed,
                         &BodyMotion::omega_locked);
       }});
  claims.push_back(
      {.id = "penalty/locked_error",
       .sentence = "At 1e10 Pa the locked angular velocity of a body started "
                   "undeformed is that of a rigid body to six digits.",
       .equations = "(ATT-4)",
       .reference = Reference::kCrossFormulation,
       .metric = kMetric,
       .unit = "rad/s",
       .bound = {.upper = 1.1e-6,
                 .derivation =
                     "set: M omega^2 / b = 5e-7 of strain changes the inertia "
                     "by as much, and 10 s of rotation at 1 rad/s add it up, "
                     "with a mean of half over the vibration"},
       .measure = [](const ClaimSetting& setting) {
         return ErrorAt(setting, 1e10, Start::kUndeformed,
                        {&BodyMotion::omega_locked}, {"locked"});
       }});
  claims.push_back(
      {.id = "penalty/polar_exponent",
       .sentence = "The paper's angular velocity (polar) of a body started "
                   "undeformed approaches it only as alpha^(-1/2).",
       .equations = "(ATT-2); paper (12)-(14)",
       .reference = Reference::kCrossFormulation,
       .metric =
           std::string("p of C alpha^p, alpha = 1e8 ... 1e12 Pa: ") + kMetric,
       .unit = "-",
       .bound = {.lower = -0.6,
                 .upper = -0.4,
                 .derivation =
                     "p = -1/2: the penalty vibration has the amplitude "
                     "1/alpha and the frequency sqrt(alpha), its velocity "
                     "enters the polar rates; 20 % for aliasing, as steps of "
                     "1 ms meet a vibration of up to 1e7 rad/s by chance"},
       .measure = [](const ClaimSetting& setting) {
         return Exponent(setting, 8, 12, Start::kUndeformed,
                         &BodyMotion::omega_polar);
       }});
  claims.push_back(
      {.id = "penalty/relaxed_error",
       .sentence = "Started relaxed, the body moves like a rigid one to seven "
                   "digits at 1e10 Pa, whichever angular velocity is asked.",
       .equations = "(ANCF-8), (ATT-2..4)",
       .reference = Reference::kCrossFormulation,
       .metric = kMetric,
       .unit = "rad/s",
       .bound = {.upper = 1.5e-7,
                 .derivation =
                     "set: the strain of 5e-7 is there from the start and "
                     "stays, so only its change with the motion counts; a "
                     "seventh of the undeformed start's bound"},
       .measure = [](const ClaimSetting& setting) {
         return ErrorAt(setting, 1e10, Start::kRelaxed,
                        {&BodyMotion::omega_locked, &BodyMotion::omega_polar,
                         &BodyMotion::omega_polar_exact},
                        {"locked", "polar", "polar exact"});
       }});
  return claims;
}

}  // namespace emmy::verification
