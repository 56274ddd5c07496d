#include "tests/verification/wrong_schemes.h"

#include <functional>
#include <utility>
#include <vector>

#include "emmy/integrate/composition.h"

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

Scheme PreferredAxis(double bias) {
  return WithDamage([bias](State& state) {
    for (Eigen::Index i = 0; i < state.velocity.value.size(); i += 3) {
      state.velocity.compensation(i) += bias * state.velocity.value(i);
    }
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

absl::StatusOr<StepFunction> UnpairedComposition(
    const Model& model, const IntegratorOptions& options) {
  const std::vector<double> parts = SubSteps(options.order, options.time_step);
  std::vector<StepFunction> steps;
  for (size_t i = 0; i < parts.size(); i += 2) {
    IntegratorOptions single = options;
    single.order = 2;
    single.time_step = 2.0 * parts[i];
    absl::StatusOr<StepFunction> step = EnergyMomentumScheme(model, single);
    if (!step.ok()) return step.status();
    steps.push_back(*std::move(step));
  }
  return StepFunction([steps](State& state) {
    StepReport report;
    for (const StepFunction& step : steps) {
      report = step(state);
      if (!report.ok()) break;
    }
    return report;
  });
}

Scheme OtherOrder(int order) {
  return WithOptions([order](const Model&, IntegratorOptions* options) {
    options->order = order;
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
