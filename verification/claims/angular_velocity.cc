// The angular velocity of an ANCF body against the rigid one's: three
// definitions, two starts, every penalty; what the penalty leaves, what the
// time step leaves, and what extrapolation removes.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "emmy/model/model_builder.h"
#include "verification/claims/groups.h"
#include "verification/exact/free_rigid_body.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

using Select = Vector3d BodyMotion::*;
// ω at 1/100 s, 2/100 s, … 10 s, whatever the time step.
using Omega = std::vector<Vector3d>;

constexpr int kReadings = 1000;
constexpr double kReading = kPaperDuration / kReadings;  // [s]

struct OmegaRun {
  Omega locked;
  Omega polar;
  Omega polar_exact;
};

absl::StatusOr<OmegaRun> RunOmega(const ModelDescription& description,
                                  double time_step, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, time_step, scheme);
  if (!run.ok()) return run.status();
  OmegaRun omega;
  for (int i = 0; i < kReadings; ++i) {
    const absl::Status status =
        run->Advance(std::llround(kReading / time_step));
    if (!status.ok()) return status;
    const BodyMotion motion = run->Motion();
    omega.locked.push_back(motion.omega_locked);
    omega.polar.push_back(motion.omega_polar);
    omega.polar_exact.push_back(motion.omega_polar_exact);
  }
  return omega;
}

absl::StatusOr<Omega> Locked(const ModelDescription& description,
                             double time_step, const Scheme& scheme) {
  absl::StatusOr<OmegaRun> run = RunOmega(description, time_step, scheme);
  if (!run.ok()) return run.status();
  return std::move(run->locked);
}

// Of the paper's box as a rigid body, (TOP-6..9).
absl::StatusOr<Omega> ExactOmega() {
  const absl::StatusOr<BuiltModel> built = BuildModel(PaperBoxConventional());
  if (!built.ok()) return built.status();
  exact::FreeRigidBodyStart<double> start;
  start.inertia = built->model.bodies()[0].inertia().tensor;
  start.angular_velocity =
      PaperBoxConventional().rigid_bodies[0].angular_velocity;
  const auto body = exact::FreeRigidBody<double>::Create(start);
  if (!body.ok()) return body.status();
  Omega omega;
  for (int i = 1; i <= kReadings; ++i) {
    omega.push_back(body->At(i * kReading).angular_velocity);
  }
  return omega;
}

// Largest |a − b| of a component [rad/s]; NaN stays.
double Difference(const Omega& a, const Omega& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double difference = (a[i] - b[i]).cwiseAbs().maxCoeff();
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

// (r fine − coarse)/(r − 1): without the error that the finer one has a
// fraction 1/r of.                                                  (ATT-5)
Omega Extrapolate(const Omega& fine, const Omega& coarse, double ratio) {
  Omega limit;
  for (size_t i = 0; i < fine.size(); ++i) {
    limit.push_back((ratio * fine[i] - coarse[i]) / (ratio - 1.0));
  }
  return limit;
}

// --- The figure: errors over penalties. ------------------------------------

constexpr char kScript[] = R"(set multiplot
set logscale xy
set xrange [1e4:1e15]
set yrange [1e-9:1]
set format '10^{%T}'
set xtics 1e4, 100, 1e14
set ytics 100
set mxtics 1
set mytics 1
set xlabel 'Penalty α  [Pa]'
set key off
array method[4] = ['polar (dashed: polar exact)', 'locked', 'extrapolated in α', \
  'locked, against Jacobi''s solution']
array colour[4] = [2, 1, 3, 6]
array place[4] = [0.10, 0.33, 0.47, 0.67]
do for [m = 1:4] {
  set arrow 10 + m from screen place[m], 0.95 to screen place[m] + 0.035, 0.95 \
    nohead lt colour[m]
  set label 10 + m method[m] at screen place[m] + 0.042, 0.95
}
array heading[2] = ['started undeformed', 'started relaxed']
set tmargin at screen 0.84
set bmargin at screen 0.14
do for [k = 0:1] {
  set lmargin at screen 0.09 + 0.46 * k
  set rmargin at screen 0.09 + 0.46 * k + 0.43
  set label 1 heading[k + 1] at graph 0.5, 1.04 center
  if (k == 0) { set ylabel 'Largest error of ω over 10 s  [rad/s]'
    set label 2 'α^{−1/2}' at first 3e8, 1.3e-3 font ',14'
    set label 3 'α^{−1}' at first 2e11, 3.5e-8 font ',14' } else {
    unset ylabel; set format y ''; unset label 2; unset label 3
    set label 3 'α^{−1}' at first 8e9, 3.5e-8 font ',14' }
  c = 2 + 5 * k
  plot (k == 0 ? 7.6 / sqrt(x) : NaN) with lines lt 7 lw 1 dt 3, \
       (k == 0 ? 3000 / x : 130 / x) with lines lt 7 lw 1 dt 3, \
       data using 1:(column(c)) with linespoints lt 2, \
       data using 1:(column(c + 1)) with lines lt 4 dt 2, \
       data using 1:(column(c + 2)) with linespoints lt 1, \
       data using 1:(column(c + 3)) with linespoints lt 6, \
       data using 1:(column(c + 4)) with linespoints lt 3
}
unset multiplot
)";

absl::StatusOr<Figure> OmegaFigure(const Scheme& scheme) {
  const absl::StatusOr<Omega> exact = ExactOmega();
  if (!exact.ok()) return exact.status();
  const absl::StatusOr<Omega> conventional =
      Locked(PaperBoxConventional(), kPaperTimeStep, scheme);
  if (!conventional.ok()) return conventional.status();
  const std::vector<double> penalties = PowersOfTen(5, 14);
  Figure figure{.name = "angular_velocity",
                .title =
                    "Error of the angular velocity over the penalty, "
                    "steps of 1 ms, against the conventional body with "
                    "the same step and the exact motion",
                .columns = {{"penalty [Pa]", penalties}},
                .script = kScript,
                .width = 1080,
                .height = 520};
  for (const Start start : {Start::kUndeformed, Start::kRelaxed}) {
    const std::string name =
        start == Start::kRelaxed ? "relaxed" : "undeformed";
    std::vector<Column> columns = {{"polar, " + name + " [rad/s]", {}},
                                   {"polar exact, " + name + " [rad/s]", {}},
                                   {"locked, " + name + " [rad/s]", {}},
                                   {"locked against exact, " + name, {}},
                                   {"locked extrapolated, " + name, {}}};
    Omega softer;
    for (const double penalty : penalties) {
      const absl::StatusOr<OmegaRun> run =
          RunOmega(PaperBoxAncf(penalty, start), kPaperTimeStep, scheme);
      if (!run.ok()) return run.status();
      columns[0].values.push_back(Difference(run->polar, *conventional));
      columns[1].values.push_back(Difference(run->polar_exact, *conventional));
      columns[2].values.push_back(Difference(run->locked, *conventional));
      columns[3].values.push_back(Difference(run->locked, *exact));
      columns[4].values.push_back(
          softer.empty() ? std::nan("")
                         : Difference(Extrapolate(run->locked, softer, 10.0),
                                      *conventional));
      softer = run->locked;
    }
    figure.columns.insert(figure.columns.end(), columns.begin(), columns.end());
  }
  return figure;
}

// --- Extrapolation in the penalty. ------------------------------------------

// Errors of the locked ω against the limit α → ∞ at the same time step, so
// that what the step leaves does not count.
struct Extrapolation {
  std::vector<double> penalties;     // The stiffer of the two.
  std::vector<double> errors;        // At that penalty.
  std::vector<double> extrapolated;  // From it and the softer one.
};

absl::StatusOr<Extrapolation> ExtrapolatePenalties(
    Start start, const std::vector<double>& penalties, const Scheme& scheme) {
  // Its own error is 1e-6 of that at 1e8 Pa.
  const absl::StatusOr<Omega> limit =
      Locked(PaperBoxAncf(1e14, Start::kRelaxed), kPaperTimeStep, scheme);
  if (!limit.ok()) return limit.status();
  Extrapolation result;
  Omega softer;
  for (const double penalty : penalties) {
    absl::StatusOr<Omega> omega =
        Locked(PaperBoxAncf(penalty, start), kPaperTimeStep, scheme);
    if (!omega.ok()) return omega.status();
    if (!softer.empty()) {
      result.penalties.push_back(penalty);
      result.errors.push_back(Difference(*omega, *limit));
      result.extrapolated.push_back(
          Difference(Extrapolate(*omega, softer, 10.0), *limit));
    }
    softer = *std::move(omega);
  }
  return result;
}

absl::StatusOr<ClaimResult> Gains(const ClaimSetting& setting, Start start,
                                  const std::vector<double>& penalties) {
  const absl::StatusOr<Extrapolation> study =
      ExtrapolatePenalties(start, penalties, setting.scheme);
  if (!study.ok()) return study.status();
  ClaimResult result;
  for (size_t i = 0; i < study->penalties.size(); ++i) {
    const std::string label = PenaltyLabel(study->penalties[i]);
    result.values.push_back({label, study->errors[i] / study->extrapolated[i]});
    result.notes.push_back(absl::StrFormat("%s: %.3g, extrapolated %.3g rad/s",
                                           label, study->errors[i],
                                           study->extrapolated[i]));
  }
  return result;
}

absl::StatusOr<ClaimResult> RelaxedGain(const ClaimSetting& setting) {
  // Gain over √(α / 1e7 Pa): (ATT-6).
  absl::StatusOr<ClaimResult> result =
      Gains(setting, Start::kRelaxed, PowersOfTen(6, 9));
  if (!result.ok()) return result.status();
  double penalty = 1e7;
  for (MetricValue& value : result->values) {
    value.value /= std::sqrt(penalty / 1e7);
    penalty *= 10.0;
  }
  absl::StatusOr<Figure> figure = OmegaFigure(setting.scheme);
  if (!figure.ok()) return figure.status();
  result->figures.push_back(*std::move(figure));
  return result;
}

// --- What the time step leaves. ---------------------------------------------

absl::StatusOr<ClaimResult> TimeStepFloor(const ClaimSetting& setting) {
  const absl::StatusOr<Omega> exact = ExactOmega();
  if (!exact.ok()) return exact.status();
  std::vector<double> steps = {5e-3, 2.5e-3, 1.25e-3};
  std::vector<double> same_step;
  ClaimResult result;
  for (const double time_step : steps) {
    const absl::StatusOr<Omega> ancf =
        Locked(PaperBoxAncf(1e14, Start::kRelaxed), time_step, setting.scheme);
    if (!ancf.ok()) return ancf.status();
    const absl::StatusOr<Omega> conventional =
        Locked(PaperBoxConventional(), time_step, setting.scheme);
    if (!conventional.ok()) return conventional.status();
    same_step.push_back(Difference(*ancf, *conventional));
    result.notes.push_back(absl::StrFormat(
        "dt = %g s: ancf and conventional differ by %.3g, from the exact "
        "motion by %.3g and %.3g rad/s",
        time_step, same_step.back(), Difference(*ancf, *exact),
        Difference(*conventional, *exact)));
  }
  result.values = {{"exponent", FitPower(steps, same_step)}};
  return result;
}

absl::StatusOr<ClaimResult> ExtrapolatedInBoth(const ClaimSetting& setting) {
  const absl::StatusOr<Omega> exact = ExactOmega();
  if (!exact.ok()) return exact.status();
  std::vector<Omega> limits;  // α → ∞, by time step.
  for (const double time_step : {1e-3, 5e-4}) {
    std::vector<Omega> omega;
    for (const double penalty : {1e8, 1e9}) {
      absl::StatusOr<Omega> run = Locked(PaperBoxAncf(penalty, Start::kRelaxed),
                                         time_step, setting.scheme);
      if (!run.ok()) return run.status();
      omega.push_back(*std::move(run));
    }
    limits.push_back(Extrapolate(omega[1], omega[0], 10.0));
  }
  const Omega limit = Extrapolate(limits[1], limits[0], 4.0);
  ClaimResult result;
  result.values = {{"1e8 and 1e9 Pa, 1 and 0.5 ms", Difference(limit, *exact)}};
  result.notes.push_back(
      absl::StrFormat("extrapolated in the penalty alone: %.3g rad/s",
                      Difference(limits[1], *exact)));
  return result;
}

}  // namespace

std::vector<Claim> AngularVelocityClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "angular_velocity/extrapolation_relaxed",
       .sentence = "Started relaxed, two penalties a decade apart give the "
                   "limit of the rigid body: extrapolation gains a factor "
                   "that grows as the root of the penalty.",
       .equations = "(ATT-4..6), (ANCF-8)",
       .reference = Reference::kCrossFormulation,
       .metric = "error at alpha / error extrapolated from alpha/10 and "
                 "alpha / sqrt(alpha / 1e7 Pa), alpha = 1e7 ... 1e9 Pa",
       .unit = "-",
       .bound = {.lower = 10.0,
                 .derivation =
                     "the next term is a vibration of omega / Omega of the "
                     "first, with Omega = 70 rad/s at 1e7 Pa; the softer "
                     "penalty's share of it is 10^1.5 / 9 = 3.5 times larger: "
                     "70 / 3.5 = 20, of which half is asked"},
       .measure = RelaxedGain});
  claims.push_back(
      {.id = "angular_velocity/extrapolation_undeformed",
       .sentence = "Started undeformed, extrapolation does not help: half of "
                   "the error is a vibration, different at each penalty.",
       .equations = "(ATT-4..6)",
       .reference = Reference::kCrossFormulation,
       .metric = "error at alpha / error extrapolated from alpha/10 and "
                 "alpha, alpha = 1e7 ... 1e9 Pa",
       .unit = "-",
       .bound = {.lower = 1.0,
                 .upper = 2.0,
                 .derivation =
                     "the strain swings between 0 and twice its mean; "
                     "extrapolation removes the mean, half of the largest "
                     "error, and leaves a vibration of the other half"},
       .measure = [](const ClaimSetting& setting) {
         return Gains(setting, Start::kUndeformed, PowersOfTen(6, 9));
       }});
  claims.push_back(
      {.id = "angular_velocity/time_step_floor",
       .sentence = "What is left at the largest penalties is the time step's: "
                   "both formulations err as dt^2, with different factors.",
       .equations = "(EM-1..3), (CRB-3)",
       .reference = Reference::kCrossFormulation,
       .metric = "p of C dt^p: max |omega - omega of the conventional body| "
                 "at 1e14 Pa, relaxed, dt = 5 ... 1.25 ms",
       .unit = "-",
       .bound = {.lower = 1.97,
                 .upper = 2.03,
                 .derivation =
                     "2, the order of both; the penalty's part of 4e-12 rad/s "
                     "is 1e-4 of the smallest value, and the next term, "
                     "(omega dt)^2, less"},
       .measure = TimeStepFloor});
  claims.push_back(
      {.id = "angular_velocity/extrapolated_in_both",
       .sentence = "Extrapolated in penalty and time step, four cheap runs "
                   "give the exact angular velocity to eight digits.",
       .equations = "(ATT-4..6), (TOP-6..9)",
       .reference = Reference::kExact,
       .metric = "max |omega - exact omega| over 10 s",
       .unit = "rad/s",
       .bound = {.upper = 1e-8,
                 .derivation =
                     "4e-7 at 1e9 Pa over the gain of 200 at that penalty is "
                     "2e-9; five times as much for its growth by the second "
                     "extrapolation, which adds up 4/3 and 1/3, and for what "
                     "vibrations in and out of phase may do. dt^4 is below"},
       .measure = ExtrapolatedInBoth});
  return claims;
}

}  // namespace emmy::verification
