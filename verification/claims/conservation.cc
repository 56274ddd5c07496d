// Energy, momentum and angular momentum to round-off.

#include <cmath>
#include <ctime>

#include "absl/strings/str_format.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

int64_t NumSteps(const ClaimSetting& setting) {
  return IsFull(setting) ? 1000000 : 50000;
}

using Select = double ConservationErrors::*;

// One error for each penalty.
absl::StatusOr<ClaimResult> OverPenalties(const ClaimSetting& setting,
                                          const std::vector<double>& penalties,
                                          Select select) {
  ClaimResult result;
  for (const double penalty : penalties) {
    const absl::StatusOr<ConservationErrors> errors =
        MeasureConservation(PaperBoxAncf(penalty), kPaperTimeStep,
                            NumSteps(setting), setting.scheme);
    if (!errors.ok()) return errors.status();
    result.values.push_back({PenaltyLabel(penalty), (*errors).*select});
  }
  result.notes.push_back(
      absl::StrFormat("largest of %d steps of 1 ms", NumSteps(setting)));
  return result;
}

struct NamedModel {
  std::string name;
  ModelDescription model;
};

// The errors of each model; momentum only where there is some.
absl::StatusOr<ClaimResult> AllErrors(const ClaimSetting& setting,
                                      const std::vector<NamedModel>& models,
                                      bool has_momentum) {
  ClaimResult result;
  for (const NamedModel& named : models) {
    const absl::StatusOr<ConservationErrors> errors = MeasureConservation(
        named.model, kPaperTimeStep, NumSteps(setting), setting.scheme);
    if (!errors.ok()) return errors.status();
    result.values.push_back({named.name + ", energy", errors->energy});
    result.values.push_back(
        {named.name + ", angular momentum", errors->angular_momentum});
    if (has_momentum) {
      result.values.push_back({named.name + ", momentum", errors->momentum});
    }
  }
  result.notes.push_back(
      absl::StrFormat("largest of %d steps of 1 ms", NumSteps(setting)));
  return result;
}

// In flight, off the origin, turned: none of the momenta is zero or trivial.
ModelDescription Moving(ModelDescription model) {
  RigidBodyDescription& body = model.rigid_bodies[0];
  body.position = Vector3d(5.0, -3.0, 2.0);
  body.velocity = Vector3d(0.7, 1.1, -0.4);
  body.orientation = RotationVector{Vector3d(0.4, -1.2, 0.9)};
  return model;
}

absl::StatusOr<ClaimResult> PenaltyIndependence(const ClaimSetting& setting) {
  const std::vector<double> penalties = PowersOfTen(6, 14);
  const absl::StatusOr<ClaimResult> errors =
      OverPenalties(setting, penalties, &ConservationErrors::energy);
  if (!errors.ok()) return errors.status();
  std::vector<double> values;
  for (const MetricValue& value : errors->values) values.push_back(value.value);
  return ClaimResult{.values = {{"exponent", FitPower(penalties, values)}},
                     .figures = {},
                     .notes = errors->notes};
}

// Processor time of one step [µs], without measuring invariants.
absl::StatusOr<double> StepMicroseconds(const ModelDescription& description,
                                        const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  const auto thread_seconds = [] {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) +
           1e-9 * static_cast<double>(now.tv_nsec);
  };
  constexpr int64_t kSteps = 100000;
  const double start = thread_seconds();
  const absl::Status status = run->Advance(kSteps);
  if (!status.ok()) return status;
  return 1e6 * (thread_seconds() - start) / static_cast<double>(kSteps);
}

absl::StatusOr<ClaimResult> Energy(const ClaimSetting& setting) {
  absl::StatusOr<ClaimResult> result = OverPenalties(
      setting, PowersOfTen(6, 14, 2), &ConservationErrors::energy);
  if (!result.ok()) return result;
  const absl::StatusOr<double> time =
      StepMicroseconds(PaperBoxAncf(1e10), setting.scheme);
  if (!time.ok()) return time.status();
  // A property of the machine: said, not judged.
  result->notes.push_back(absl::StrFormat(
      "one step takes %.2f us of one core, a million %.1f s", *time, *time));
  return result;
}

constexpr char kFloorDerivation[] =
    "9 u, u = 2^-53, for 10^6 steps. The increments of a step are omega dt = "
    "1e-3 of the values and rounded by u of themselves, so a step errs by "
    "about 1e-3 u; 10^6 independent errors add to 10^3 of one, about u for "
    "each of a few terms; the largest over steps and runs is three times that";

}  // namespace

std::vector<Claim> ConservationClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "conservation/energy",
       .sentence = "The ANCF body keeps its energy to round-off, for every "
                   "penalty from 1e6 to 1e14 Pa.",
       .equations = "(ANCF-1), (ANCF-5), (EM-1..5); paper (27)",
       .reference = Reference::kExact,
       .metric = "largest |E - E0| / E, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = Energy});
  claims.push_back(
      {.id = "conservation/angular_momentum",
       .sentence = "The ANCF body keeps its angular momentum to round-off, for "
                   "every penalty from 1e6 to 1e14 Pa.",
       .equations = "(ANCF-7), (EM-2); paper (27)",
       .reference = Reference::kExact,
       .metric = "largest |L - L0| / |L|, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return OverPenalties(setting, PowersOfTen(6, 14, 2),
                              &ConservationErrors::angular_momentum);
       }});
  claims.push_back(
      {.id = "conservation/soft_penalty",
       .sentence = "At 1e4 Pa, where strains reach 20 %, energy and angular "
                   "momentum are kept as well.",
       .equations = "(ANCF-5), (EM-1..5)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return AllErrors(setting, {{"ancf", PaperBoxAncf(1e4)}}, false);
       }});
  claims.push_back(
      {.id = "conservation/conventional_body",
       .sentence = "The conventional body keeps its energy and angular "
                   "momentum to round-off.",
       .equations = "(CRB-2..4)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return AllErrors(setting, {{"conventional", PaperBoxConventional()}},
                          false);
       }});
  claims.push_back(
      {.id = "conservation/conventional_energy",
       .sentence =
           "The conventional body's energy is kept beyond a double: its "
           "angular velocity is advanced as a pair of them.",
       .equations = "(CRB-4), (CRBL-1), (CRBL-2), (SUM-2)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 3e-19,
                 .derivation =
                     "a step may leave 2^-20 u of its increment, of |W| dt = "
                     "1e-3 of the velocity, twice that of the energy: 2.1e-25; "
                     "a million of one sign, 2.1e-19. The rounding of pairs, "
                     "some 2^-104 a step, is far below"},
       .measure =
           [](const ClaimSetting& setting) -> absl::StatusOr<ClaimResult> {
         absl::StatusOr<ClaimResult> result = AllErrors(
             setting, {{"conventional", PaperBoxConventional()}}, false);
         if (result.ok()) result->values.resize(1);  // Energy.
         return result;
       }});
  claims.push_back(
      {.id = "conservation/moving_body",
       .sentence = "A turned body in flight away from the origin keeps energy, "
                   "momentum and angular momentum about the origin, in both "
                   "formulations.",
       .equations = "(ANCF-1), (ANCF-7), (CRB-2), (EM-4)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-15, .derivation = kFloorDerivation},
       .measure = [](const ClaimSetting& setting) {
         return AllErrors(setting,
                          {{"ancf", Moving(PaperBoxAncf(1e10))},
                           {"conventional", Moving(PaperBoxConventional())}},
                          true);
       }});
  claims.push_back(
      {.id = "conservation/penalty_independence",
       .sentence = "The energy error does not depend on the penalty.",
       .equations = "(QS-1), (EM-3)",
       .reference = Reference::kExact,
       .metric = "p of error = C alpha^p, alpha = 1e6 ... 1e14 Pa",
       .unit = "-",
       .bound = {.lower = -0.15,
                 .upper = 0.15,
                 .derivation =
                     "p = 0; one run's largest error scatters by a factor of "
                     "two, which moves the fit over nine penalties by 0.04. "
                     "Strain recomputed from coordinates gives p near 1/2 or "
                     "above"},
       .measure = PenaltyIndependence});
  return claims;
}

}  // namespace emmy::verification
