#include "verification/benchmarks/checked_run.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "emmy/model/model_builder.h"

namespace emmy::verification {

CheckedRun::CheckedRun(const ModelDescription& description,
                       const IntegratorOptions& options, int warm_up) {
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  if (!built.ok()) {
    error_ = built.status().ToString();
    return;
  }
  model_ = std::make_unique<const Model>(std::move(built->model));
  state_ = std::move(built->state);
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(*model_, options);
  if (!integrator.ok()) {
    error_ = integrator.status().ToString();
    return;
  }
  integrator_.emplace(*std::move(integrator));
  monitor_.emplace(*model_, state_);
  for (int i = 0; i < warm_up; ++i) {
    const StepReport report = integrator_->Step(state_);
    if (report.ok()) continue;
    error_ = report.message;
    return;
  }
  warm_ = state_;
}

void CheckedRun::TimeSteps(benchmark::State& state, double bound,
                           double bound_per_step) {
  state_ = warm_;
  int64_t iterations = 0;
  const int factorizations =
      integrator_.has_value() ? integrator_->num_factorizations() : 0;
  for (auto _ : state) {
    if (!error_.empty()) {
      state.SkipWithError(error_.c_str());
      return;
    }
    const StepReport report = integrator_->Step(state_);
    if (!report.ok()) {
      state.SkipWithError(report.message.c_str());
      return;
    }
    iterations += report.iterations;
  }
  monitor_->Observe(state_);
  const double energy = monitor_->energy().max_relative_error();
  const double angular = monitor_->angular_momentum().max_relative_error();
  const double allowed =
      bound + bound_per_step * static_cast<double>(state_.step);
  // Written so that NaN fails.
  if (!(energy <= allowed) || !(angular <= allowed)) {
    error_ = absl::StrCat("energy error ", energy, ", angular momentum error ",
                          angular, ", bound ", allowed);
    state.SkipWithError(error_.c_str());
  }
  const auto per_step = benchmark::Counter::kAvgIterations;
  state.counters["newton_iterations"] =
      benchmark::Counter(static_cast<double>(iterations), per_step);
  state.counters["factorizations"] = benchmark::Counter(
      static_cast<double>(integrator_->num_factorizations() - factorizations),
      per_step);
  state.counters["energy_error"] = energy;
  state.counters["angular_momentum_error"] = angular;
}

}  // namespace emmy::verification
