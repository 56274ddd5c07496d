#include "tests/verification/wrong_schemes.h"

#include <functional>
#include <utility>

namespace emmy::verification {
namespace {

// The library's step with other options.
template <typename Change>
Scheme WithOptions(const Change& change) {
  return [change](const Model& model, const IntegratorOptions& options) {
    IntegratorOptions wrong = options;
    change(model, &wrong);
    return EnergyMomentumScheme(model, wrong);
  };
}

// The library's step, and then `damage` done to the state.
Scheme WithDamage(const std::function<void(State&)>& damage) {
  return [damage](
             const Model& model,
             const IntegratorOptions& options) -> absl::StatusOr<StepFunction> {
    absl::StatusOr<StepFunction> step = EnergyMomentumScheme(model, options);
    if (!step.ok()) return step.status();
    return StepFunction([step = *std::move(step), damage](State& state) {
      StepReport report = step(state);
      damage(state);
      return report;
    });
  };
}

}  // namespace

Scheme LooseNewton(double tolerance) {
  return WithOptions([tolerance](const Model&, IntegratorOptions* options) {
    options->tolerance = tolerance;
  });
}

Scheme FewIterations(int iterations) {
  return WithOptions([iterations](const Model&, IntegratorOptions* options) {
    options->max_iterations = iterations;
  });
}

Scheme BiasedRounding(double bias) {
  return WithDamage([bias](State& state) {
    state.velocity.compensation += bias * state.velocity.value;
  });
}

Scheme WrongClock(double error, bool ancf_only) {
  return WithOptions(
      [error, ancf_only](const Model& model, IntegratorOptions* options) {
        if (ancf_only && model.bodies()[0].ancf() == nullptr) return;
        options->time_step *= 1.0 + error;
      });
}

Scheme FirstOrderClock(double factor) {
  return WithOptions([factor](const Model&, IntegratorOptions* options) {
    options->time_step *= 1.0 + factor * options->time_step;
  });
}

Scheme StrainKick(double kick) {
  return WithDamage([kick](State& state) {
    if (state.step == 1) state.strain.value(0) += kick;
  });
}

absl::StatusOr<StepFunction> SilentFailure(const Model& model,
                                           const IntegratorOptions& options) {
  absl::StatusOr<StepFunction> step = EnergyMomentumScheme(model, options);
  if (!step.ok()) return step.status();
  return StepFunction([step = *std::move(step)](State& state) {
    StepReport report = step(state);
    report.termination = Termination::kConverged;
    return report;
  });
}

}  // namespace emmy::verification
