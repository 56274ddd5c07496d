// Structures: trusses, cables and joints, kept laws and the rigid limit.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/larger.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "verification/claims/groups.h"
#include "verification/models/large_models.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

void AddErrors(const std::string& name, const ConservationErrors& errors,
               ClaimResult* result) {
  result->values.push_back({name + ", energy", errors.energy});
  result->values.push_back({name + ", momentum", errors.momentum});
  result->values.push_back(
      {name + ", angular momentum", errors.angular_momentum});
}

// --- The paper's box with a truss on one corner (5.2). ---------------------

absl::StatusOr<ClaimResult> TrussLaws(const ClaimSetting& setting,
                                      const std::vector<double>& penalties,
                                      int64_t num_steps) {
  ClaimResult result;
  for (const double penalty : penalties) {
    const absl::StatusOr<ConservationErrors> errors = MeasureConservation(
        PaperTrussAncf(penalty), kPaperTimeStep, num_steps, setting.scheme);
    if (!errors.ok()) return errors.status();
    AddErrors(PenaltyLabel(penalty), *errors, &result);
  }
  result.notes.push_back(
      absl::StrFormat("largest of %d steps of 1 ms", num_steps));
  return result;
}

constexpr int64_t kLimitSteps = 10000;  // 10 s of 1 ms.

// The locked angular velocity after every step.
absl::StatusOr<std::vector<Vector3d>> LockedOmega(
    const ModelDescription& description, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  std::vector<Vector3d> omega;
  const absl::Status status =
      run->Advance(kLimitSteps, [&omega](const Run& advanced) {
        omega.push_back(advanced.Motion().omega_locked);
      });
  if (!status.ok()) return status;
  return omega;
}

// max |ω − ω_conventional| over every step and component [rad/s], by penalty.
absl::StatusOr<std::vector<double>> LockedErrors(
    const std::vector<double>& penalties, const Scheme& scheme) {
  const absl::StatusOr<std::vector<Vector3d>> reference =
      LockedOmega(PaperTrussConventional(), scheme);
  if (!reference.ok()) return reference.status();
  std::vector<double> errors;
  for (const double penalty : penalties) {
    const absl::StatusOr<std::vector<Vector3d>> omega =
        LockedOmega(PaperTrussAncf(penalty), scheme);
    if (!omega.ok()) return omega.status();
    double error = 0.0;
    for (size_t i = 0; i < omega->size(); ++i) {
      error = Larger(error, ((*omega)[i] - (*reference)[i])
                                .cwiseAbs()
                                .maxCoeff<Eigen::PropagateNaN>());
    }
    errors.push_back(error);
  }
  return errors;
}

absl::StatusOr<ClaimResult> LockedExponent(const ClaimSetting& setting) {
  const std::vector<double> penalties =
      PowersOfTen(6, 10, IsFull(setting) ? 1 : 2);
  const absl::StatusOr<std::vector<double>> errors =
      LockedErrors(penalties, setting.scheme);
  if (!errors.ok()) return errors.status();
  ClaimResult result;
  result.values = {{"exponent", FitPower(penalties, *errors)}};
  for (size_t i = 0; i < penalties.size(); ++i) {
    result.notes.push_back(absl::StrFormat(
        "%s: %.3g rad/s", PenaltyLabel(penalties[i]), (*errors)[i]));
  }
  return result;
}

absl::StatusOr<ClaimResult> LockedError(const ClaimSetting& setting) {
  const absl::StatusOr<std::vector<double>> errors =
      LockedErrors({1e10}, setting.scheme);
  if (!errors.ok()) return errors.status();
  ClaimResult result;
  result.values.push_back({PenaltyLabel(1e10), errors->front()});
  return result;
}

absl::StatusOr<ClaimResult> OmegaAfterTenSeconds(const ClaimSetting& setting) {
  const Vector3d expected(-0.17353, 0.41422, 0.90952);
  ClaimResult result;
  const std::vector<std::pair<std::string, ModelDescription>> models = {
      {"ancf, 1e10 Pa", PaperTrussAncf(1e10)},
      {"conventional", PaperTrussConventional()}};
  for (const auto& [name, model] : models) {
    const absl::StatusOr<std::vector<Vector3d>> omega =
        LockedOmega(model, setting.scheme);
    if (!omega.ok()) return omega.status();
    const Vector3d& last = omega->back();
    result.values.push_back({name, (last - expected).cwiseAbs().maxCoeff()});
    result.notes.push_back(absl::StrFormat("%s: [%.7f, %.7f, %.7f] rad/s", name,
                                           last(0), last(1), last(2)));
  }
  return result;
}

// --- Large structures. -----------------------------------------------------

absl::StatusOr<ClaimResult> NetEnergy(const ClaimSetting& setting) {
  const int n = IsFull(setting) ? 60 : 20;
  const int64_t steps = IsFull(setting) ? 1000 : 50;
  const ModelDescription net = SpinningNet(n).model;
  ClaimResult result;
  for (const double time_step : {1e-3, 1e-2}) {
    const absl::StatusOr<ConservationErrors> errors =
        MeasureConservation(net, time_step, steps, setting.scheme);
    if (!errors.ok()) return errors.status();
    const std::string name = absl::StrFormat("dt = %g s", time_step);
    result.values.push_back({name + ", energy", errors->energy});
    result.notes.push_back(absl::StrFormat("%s: angular momentum %.2g", name,
                                           errors->angular_momentum));
  }
  result.notes.push_back(
      absl::StrFormat("%d x %d nodes, %d steps each", n, n, steps));
  return result;
}

struct ChainSize {
  int boxes;
  int64_t steps;
};

ChainSize SizeOfChain(const ClaimSetting& setting) {
  return IsFull(setting) ? ChainSize{1000, 1000} : ChainSize{100, 200};
}

absl::StatusOr<ClaimResult> ChainLaws(const ClaimSetting& setting) {
  const auto [boxes, steps] = SizeOfChain(setting);
  const absl::StatusOr<ConservationErrors> errors = MeasureConservation(
      BoxChain(boxes).model, kPaperTimeStep, steps, setting.scheme);
  if (!errors.ok()) return errors.status();
  ClaimResult result;
  AddErrors(absl::StrFormat("%d boxes", boxes), *errors, &result);
  result.notes.push_back(absl::StrFormat("%d steps of 1 ms", steps));
  return result;
}

double Ulp(double x) {
  return std::nextafter(std::abs(x), std::numeric_limits<double>::infinity()) -
         std::abs(x);
}

absl::StatusOr<ClaimResult> ChainJoints(const ClaimSetting& setting) {
  const auto [boxes, steps] = SizeOfChain(setting);
  absl::StatusOr<Run> run =
      Run::Start(BoxChain(boxes).model, kPaperTimeStep, setting.scheme);
  if (!run.ok()) return run.status();
  double worst = 0.0;
  const absl::Status status = run->Advance(steps, [&worst](const Run& now) {
    const double ulp = Ulp(now.state().position.value.cwiseAbs().maxCoeff());
    for (const ModelConstraint& constraint : now.model().constraints()) {
      Point difference;
      difference.terms = constraint.terms;
      const Vector3d gap =
          ExtendedPosition(now.model(), now.state(), difference).ToDouble();
      const double size = gap.cwiseAbs().maxCoeff() / ulp;
      if (!(size <= worst)) worst = size;  // NaN stays.
    }
  });
  if (!status.ok()) return status;
  ClaimResult result;
  result.values.push_back({absl::StrFormat("%d boxes", boxes), worst});
  result.notes.push_back(absl::StrFormat("%d joints, every one of %d steps",
                                         run->model().constraints().size(),
                                         steps));
  return result;
}

struct SlackStudy {
  double energy_error = 0.0;
  int64_t changes = 0;  // Of a cable from slack to taut or back, by step.
};

absl::StatusOr<SlackStudy> StudySlackCables(const ClaimSetting& setting) {
  const int n = IsFull(setting) ? 10 : 6;
  const int64_t steps = IsFull(setting) ? 1000 : 300;
  absl::StatusOr<Run> run =
      Run::Start(SlackCableNet(n).model, kPaperTimeStep, setting.scheme);
  if (!run.ok()) return run.status();
  InvariantMonitor monitor(run->model(), run->state());
  SlackStudy study;
  std::vector<bool> taut(run->model().lines().size(), false);
  const absl::Status status = run->Advance(steps, [&](const Run& now) {
    monitor.Observe(now.state());
    for (size_t i = 0; i < taut.size(); ++i) {
      const bool is_taut =
          now.state().strain.value(now.model().lines()[i].strain_offset) > 0.0;
      // All start on the edge; only from the second step on is it a change.
      if (now.state().step > 1 && is_taut != taut[i]) ++study.changes;
      taut[i] = is_taut;
    }
  });
  if (!status.ok()) return status;
  study.energy_error = monitor.energy().max_relative_error();
  return study;
}

absl::StatusOr<ClaimResult> SlackEnergy(const ClaimSetting& setting) {
  const absl::StatusOr<SlackStudy> study = StudySlackCables(setting);
  if (!study.ok()) return study.status();
  ClaimResult result;
  result.values.push_back({"energy", study->energy_error});
  result.notes.push_back(
      absl::StrFormat("%d changes between slack and taut", study->changes));
  return result;
}

absl::StatusOr<ClaimResult> SlackChanges(const ClaimSetting& setting) {
  const absl::StatusOr<SlackStudy> study = StudySlackCables(setting);
  if (!study.ok()) return study.status();
  ClaimResult result;
  result.values.push_back({"changes", static_cast<double>(study->changes)});
  return result;
}

constexpr char kFloorDerivation[] =
    "9 u, u = 2^-53: a step's increments are 1e-3 to 1e-2 of the values and "
    "rounded by u of themselves; they add up as a random walk, below u for "
    "each of a few terms, and the largest over the steps is three times that";

}  // namespace

std::vector<Claim> StructureClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "structures/truss_conservation",
       .sentence = "The paper's box with a truss on one corner keeps energy, "
                   "momentum and angular momentum to round-off, for every "
                   "penalty from 1e5 to 1e12 Pa.",
       .equations = "(ANCF-5), (LINE-2), (LINE-3), (EM-9); paper, 5.2",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return TrussLaws(setting, PowersOfTen(5, 12), 10000);
       }});
  claims.push_back(
      {.id = "structures/truss_million_steps",
       .sentence = "The paper's box with a truss keeps its laws over a million "
                   "steps.",
       .equations = "(ANCF-5), (LINE-2), (LINE-3), (EM-9); paper, 5.2",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return TrussLaws(setting, {1e10}, IsFull(setting) ? 1000000 : 20000);
       }});
  claims.push_back(
      {.id = "structures/locked_exponent",
       .sentence = "With a truss, the locked angular velocity approaches that "
                   "of the conventional body as 1/alpha.",
       .equations = "(ATT-4), (CRB-6..8)",
       .reference = Reference::kCrossFormulation,
       .metric = "p of C alpha^p, alpha = 1e6 ... 1e10 Pa: max |omega - omega "
                 "of the conventional body| over 10 s, dt = 1 ms",
       .unit = "-",
       .bound = {.lower = -1.1,
                 .upper = -0.9,
                 .derivation =
                     "p = -1: strains, and with them J(e), are wrong by "
                     "M omega^2 / b; ten per cent for the ends"},
       .measure = LockedExponent});
  claims.push_back(
      {.id = "structures/locked_error",
       .sentence = "With a truss, at 1e10 Pa, the locked angular velocity is "
                   "that of the conventional body to six digits.",
       .equations = "(ATT-4), (CRB-6..8)",
       .reference = Reference::kCrossFormulation,
       .metric = "max |omega - omega of the conventional body| over 10 s, dt = "
                 "1 ms",
       .unit = "rad/s",
       .bound = {.upper = 1.1e-6,
                 .derivation =
                     "set: M omega^2 / b = 5e-7 of strain changes the inertia "
                     "by as much, and 10 s of rotation at 1 rad/s add it up, "
                     "with a mean of half over the vibration"},
       .measure = LockedError});
  claims.push_back(
      {.id = "structures/omega_after_ten_seconds",
       .sentence = "After 10 s the box with the truss turns with (-0.17353, "
                   "0.41422, 0.90952) rad/s.",
       .equations = "(ATT-4), (CRB-6..8); paper, 5.2",
       .reference = Reference::kCrossFormulation,
       .metric = "largest difference of a component",
       .unit = "rad/s",
       .bound = {.upper = 1e-5,
                 .derivation = "the five digits given, with their last one "
                               "uncertain by the step's second order"},
       .measure = OmegaAfterTenSeconds});
  claims.push_back(
      {.id = "structures/net_energy",
       .sentence = "A spinning net of trusses with a hub keeps its energy to "
                   "round-off.",
       .equations = "(LINE-2), (LINE-3), (EM-9..11)",
       .reference = Reference::kExact,
       .metric = "largest |E - E0| / E, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = NetEnergy});
  claims.push_back(
      {.id = "structures/chain_conservation",
       .sentence = "A chain of boxes joined by shared points keeps energy, "
                   "momentum and angular momentum to round-off.",
       .equations = "(EM-9), (PNT-1)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = ChainLaws});
  claims.push_back(
      {.id = "structures/chain_joints",
       .sentence = "The joints of a chain stay closed: no drift.",
       .equations = "(EM-9), (PNT-1)",
       .reference = Reference::kExact,
       .metric = "largest gap of a joint / ulp of the largest coordinate",
       .unit = "ulp",
       .bound = {.upper = 1.0,
                 .derivation =
                     "half an ulp for each of two coordinates given as "
                     "doubles. G dq = 0 adds only round-off of compensations, "
                     "u of it a step"},
       .measure = ChainJoints});
  claims.push_back(
      {.id = "structures/slack_energy",
       .sentence = "A net of cables that go slack and taut keeps its energy.",
       .equations = "(LINE-4), (EM-9)",
       .reference = Reference::kExact,
       .metric = "largest |E - E0| / E, every step",
       .unit = "-",
       .bound = {.upper = 1e-14,
                 .derivation =
                     "set: ten times the bound without slack cables, whose "
                     "forces jump in stiffness within a step"},
       .measure = SlackEnergy});
  claims.push_back(
      {.id = "structures/slack_changes",
       .sentence = "Its cables do change between slack and taut, hundreds of "
                   "times.",
       .equations = "(LINE-4)",
       .reference = Reference::kExact,
       .metric = "changes between slack and taut from one step to the next",
       .unit = "changes",
       .bound = {.lower = 200.0,
                 .derivation = "so many that every case of (LINE-4) occurs "
                               "often in the claim on the energy"},
       .measure = SlackChanges});
  return claims;
}

}  // namespace emmy::verification
