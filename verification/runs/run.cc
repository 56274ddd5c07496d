#include "verification/runs/run.h"

#include <utility>

#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/model/model_builder.h"

namespace emmy::verification {

absl::StatusOr<Run> Run::Start(const ModelDescription& description,
                               double time_step, const Scheme& scheme) {
  return Start(description, IntegratorOptions{.time_step = time_step}, scheme);
}

absl::StatusOr<Run> Run::Start(const ModelDescription& description,
                               const IntegratorOptions& options,
                               const Scheme& scheme) {
  absl::StatusOr<BuiltModel> built = BuildModel(description);
  if (!built.ok()) return built.status();
  auto model = std::make_unique<const Model>(std::move(built->model));
  absl::StatusOr<StepFunction> step = scheme(*model, options);
  if (!step.ok()) return step.status();
  return Run(std::move(model), std::move(built->state), *std::move(step));
}

absl::Status Run::Advance(int64_t num_steps,
                          const std::function<void(const Run&)>& observe) {
  for (int64_t i = 0; i < num_steps; ++i) {
    const StepReport report = step_(state_);
    if (!report.ok()) return absl::AbortedError(report.message);
    if (observe) observe(*this);
  }
  return absl::OkStatus();
}

absl::StatusOr<ConservationErrors> MeasureConservation(
    const ModelDescription& description, double time_step, int64_t num_steps,
    const Scheme& scheme) {
  return MeasureConservation(description,
                             IntegratorOptions{.time_step = time_step},
                             num_steps, scheme);
}

absl::StatusOr<ConservationErrors> MeasureConservation(
    const ModelDescription& description, const IntegratorOptions& options,
    int64_t num_steps, const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, options, scheme);
  if (!run.ok()) return run.status();
  InvariantMonitor monitor(run->model(), run->state());
  const absl::Status status = run->Advance(
      num_steps,
      [&monitor](const Run& advanced) { monitor.Observe(advanced.state()); });
  if (!status.ok()) return status;
  return ConservationErrors{
      .energy = monitor.energy().max_relative_error(),
      .momentum = monitor.momentum().max_relative_error(),
      .angular_momentum = monitor.angular_momentum().max_relative_error()};
}

}  // namespace emmy::verification
