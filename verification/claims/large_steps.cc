// Steps far larger than anyone takes: kept laws, or a clear failure.

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

const std::vector<double>& Penalties() {
  static const std::vector<double>* const penalties =
      new std::vector<double>(PowersOfTen(6, 14, 2));
  return *penalties;
}

absl::StatusOr<ClaimResult> KeptLaws(const ClaimSetting& setting,
                                     double time_step) {
  const int64_t steps = IsFull(setting) ? 100000 : 20000;
  ClaimResult result;
  for (const double penalty : Penalties()) {
    const absl::StatusOr<ConservationErrors> errors = MeasureConservation(
        PaperBoxAncf(penalty), time_step, steps, setting.scheme);
    if (!errors.ok()) return errors.status();
    result.values.push_back(
        {PenaltyLabel(penalty) + ", energy", errors->energy});
    result.values.push_back({PenaltyLabel(penalty) + ", angular momentum",
                             errors->angular_momentum});
  }
  result.notes.push_back(
      absl::StrFormat("largest of %d steps of %g s", steps, time_step));
  return result;
}

absl::StatusOr<ClaimResult> Converges(const ClaimSetting& setting,
                                      double time_step) {
  const int64_t steps = IsFull(setting) ? 100000 : 5000;
  ClaimResult result;
  int worst = 0;
  for (const double penalty : Penalties()) {
    absl::StatusOr<Run> run =
        Run::Start(PaperBoxAncf(penalty), time_step, setting.scheme);
    if (!run.ok()) return run.status();
    int64_t failed = 0;
    for (int64_t i = 0; i < steps && failed == 0; ++i) {
      const StepReport report = run->Step();
      worst = std::max(worst, report.iterations);
      // A step that fails leaves the state, and would fail again.
      if (!report.ok()) failed = steps - i;
    }
    result.values.push_back(
        {PenaltyLabel(penalty), static_cast<double>(failed)});
  }
  result.notes.push_back(absl::StrFormat(
      "%d steps of %g s, at most %d iterations", steps, time_step, worst));
  return result;
}

// Total energy and what rounding may have changed it by so far.
class RoundingBudget {
 public:
  explicit RoundingBudget(const Run& run)
      : body_(run.model().bodies()[0]), last_(run.state()) {
    start_ = MeasureInvariants(run.model(), run.state());
  }

  // After each accepted step.
  void Add(const Run& run, double time_step) {
    const AncfRigidBody& body = *body_.ancf();
    const State& state = run.state();
    const Eigen::Index s = body_.strain_offset;
    const Eigen::Index w = body_.velocity_offset + 3;
    const Vector6d mean_strain = 0.5 * (state.strain.value.segment<6>(s) +
                                        last_.strain.value.segment<6>(s));
    const Vector9d mean_rate = 0.5 * (state.velocity.value.segment<9>(w) +
                                      last_.velocity.value.segment<9>(w));
    // Work of each strain b ε̄ Δε, where Δε = Δt (A ē)·w̄ has the terms below.
    const double strain_terms =
        std::abs(time_step) * 3.0 * mean_rate.cwiseAbs().maxCoeff() *
        std::max(1.0, state.position.value.cwiseAbs().maxCoeff());
    const double work =
        body.penalty_stiffness().cwiseProduct(mean_strain).cwiseAbs().sum() *
        strain_terms;
    const double kinetic =
        MeasureInvariants(run.model(), state).InternalEnergy().ToDouble();
    constexpr double kOperations = 32.0;  // From Δw to Δε and f̄·Δq.
    bound_ += kOperations * kUnitRoundoff * (work + kinetic);
    last_ = state;
  }

  double Error(const Run& run) const {
    const Invariants now = MeasureInvariants(run.model(), run.state());
    return std::abs((now.TotalEnergy() - start_.TotalEnergy()).ToDouble());
  }
  double bound() const { return bound_; }

 private:
  const ModelBody& body_;
  State last_;
  Invariants start_;
  double bound_ = 0.0;  // [J]
};

bool SameBits(const VectorXd& a, const VectorXd& b) {
  return (a.array() == b.array()).all();
}

bool Unchanged(const State& a, const State& b) {
  return a.step == b.step && a.time.value == b.time.value &&
         SameBits(a.position.value, b.position.value) &&
         SameBits(a.velocity.value, b.velocity.value) &&
         SameBits(a.strain.value, b.strain.value);
}

// Energy error in units of its rounding bound, over accepted steps. A failure
// is an end of the run that says so and leaves the state; one that does not
// counts as infinite.
double SilentError(Run& run, double time_step, int64_t steps, int* failures) {
  RoundingBudget budget(run);
  double worst = 0.0;
  for (int64_t i = 0; i < steps; ++i) {
    const State before = run.state();
    const StepReport report = run.Step();
    if (!report.ok()) {
      ++*failures;
      const bool clear =
          !report.message.empty() && Unchanged(before, run.state());
      return clear ? worst : std::numeric_limits<double>::infinity();
    }
    // To report a step and not take it would keep every law.
    if (run.state().step != before.step + 1 ||
        !(run.state().time.value > before.time.value)) {
      return std::numeric_limits<double>::infinity();
    }
    budget.Add(run, time_step);
    const double error = budget.Error(run);
    worst = std::isfinite(error) ? std::max(worst, error / budget.bound())
                                 : std::numeric_limits<double>::infinity();
  }
  return worst;
}

absl::StatusOr<ClaimResult> NeverSilent(const ClaimSetting& setting) {
  const int64_t steps = IsFull(setting) ? 2000 : 200;
  ClaimResult result;
  int failures = 0;
  for (const double time_step : {0.5, 1.0, 2.0, 5.0, 20.0, 100.0}) {
    double worst = 0.0;
    for (const double penalty : Penalties()) {
      absl::StatusOr<Run> run =
          Run::Start(PaperBoxAncf(penalty), time_step, setting.scheme);
      if (!run.ok()) return run.status();
      worst = std::max(worst, SilentError(*run, time_step, steps, &failures));
    }
    result.values.push_back({absl::StrFormat("dt = %g s", time_step), worst});
  }
  result.notes.push_back(
      absl::StrFormat("%d steps each, 5 penalties; %d of 30 runs ended with a "
                      "message and an unchanged state",
                      steps, failures));
  return result;
}

}  // namespace

std::vector<Claim> LargeStepClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "large_steps/hundredth_second",
       .sentence = "Steps of 0.01 s keep energy and angular momentum to "
                   "round-off at every penalty.",
       .equations = "(EM-1..5)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 2e-15,
                 .derivation =
                     "set for 10^5 steps: rounding of a step grows with its "
                     "length, so 10^5 steps of 0.01 s may cost sqrt(10) times "
                     "what 10^6 of 0.001 s do, for which 1e-15 is claimed"},
       .measure = [](const ClaimSetting& setting) {
         return KeptLaws(setting, 0.01);
       }});
  claims.push_back(
      {.id = "large_steps/tenth_second",
       .sentence = "Steps of 0.1 s, six degrees each, keep energy and angular "
                   "momentum at every penalty.",
       .equations = "(EM-1..5)",
       .reference = Reference::kExact,
       .metric = "largest relative error, every step",
       .unit = "-",
       .bound = {.upper = 1e-13,
                 .derivation =
                     "ten times longer steps than 0.01 s: ten times the "
                     "rounding of a step, and fewer of its digits cancel "
                     "between the rotation and its strain"},
       .measure = [](const ClaimSetting& setting) {
         return KeptLaws(setting, 0.1);
       }});
  claims.push_back({.id = "large_steps/half_second",
                    .sentence =
                        "Steps of 0.5 s, half a radian each, converge at every "
                        "penalty.",
                    .equations = "(EM-5), (EM-8)",
                    .reference = Reference::kExact,
                    .metric = "steps that did not converge",
                    .unit = "steps",
                    .bound = {.upper = 0.0, .derivation = "none may fail"},
                    .measure = [](const ClaimSetting& setting) {
                      return Converges(setting, 0.5);
                    }});
  claims.push_back(
      {.id = "large_steps/never_silent",
       .sentence = "However large the step, up to 100 s, it either keeps the "
                   "energy to rounding or fails with a message and leaves the "
                   "state.",
       .equations = "(EM-7)",
       .reference = Reference::kExact,
       .metric = "largest |E - E0| / rounding bound of the steps so far",
       .unit = "-",
       .bound = {.upper = 1.0,
                 .derivation =
                     "32 u times the absolute terms of every strain's work "
                     "and of the energy, summed over the steps (Higham, "
                     "Accuracy and Stability, 3.1)"},
       .measure = NeverSilent});
  return claims;
}

}  // namespace emmy::verification
