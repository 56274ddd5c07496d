#include "emmy/integrate/energy_momentum.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "emmy/base/check.h"
#include "emmy/integrate/composition.h"
#include "emmy/model/validation.h"

namespace emmy {

absl::StatusOr<EnergyMomentumIntegrator> EnergyMomentumIntegrator::Create(
    const Model& model, const IntegratorOptions& options) {
  if (!IsCompositionOrder(options.order)) {
    return FieldError("/integrator/order", "2, 4 or 6",
                      std::to_string(options.order));
  }
  if (!std::isfinite(options.time_step) || options.time_step == 0.0) {
    return FieldError("/integrator/time_step",
                      "a finite number other than 0 [s]",
                      NumberText(options.time_step));
  }
  if (options.max_iterations < 1) {
    return FieldError("/integrator/max_iterations", "at least 1",
                      std::to_string(options.max_iterations));
  }
  if (options.tolerance.has_value() &&
      !(*options.tolerance > 0.0 && *options.tolerance < 1.0)) {
    return FieldError("/integrator/tolerance",
                      "\"round_off\" or a number between 0 and 1",
                      NumberText(*options.tolerance));
  }
  if (options.num_threads < 1) {
    return FieldError("/integrator/num_threads", "at least 1",
                      std::to_string(options.num_threads));
  }
  EnergyMomentumIntegrator integrator(model, options);
  const absl::Status status = integrator.MakeSteps(model);
  if (!status.ok()) return status;
  return integrator;
}

EnergyMomentumIntegrator::EnergyMomentumIntegrator(
    const Model& model, const IntegratorOptions& options)
    : options_(options),
      state_size_(SizeOf(model)),
      structures_(std::make_unique<const std::vector<Structure>>(
          SplitIntoStructures(model))) {}

EnergyMomentumIntegrator::EnergyMomentumIntegrator(
    EnergyMomentumIntegrator&&) noexcept = default;
EnergyMomentumIntegrator& EnergyMomentumIntegrator::operator=(
    EnergyMomentumIntegrator&&) noexcept = default;
EnergyMomentumIntegrator::~EnergyMomentumIntegrator() = default;

absl::Status EnergyMomentumIntegrator::MakeSteps(const Model& model) {
  const ModelStepOptions step_options{
      .newton = {.tolerance = options_.tolerance,
                 .max_iterations = options_.max_iterations},
      .always_full_newton = options_.always_full_newton,
      .factor_method = options_.factor_method,
      .num_threads = options_.num_threads};
  for (const double size : SubSteps(options_.order, options_.time_step)) {
    // Steps of one size share what they keep, factorisations above all.
    const auto known = std::find_if(
        steps_.begin(), steps_.end(),
        [size](const ModelStep& step) { return step.time_step() == size; });
    sequence_.push_back(static_cast<size_t>(known - steps_.begin()));
    if (known != steps_.end()) continue;
    absl::StatusOr<ModelStep> step =
        ModelStep::Create(model, *structures_, size, step_options);
    if (!step.ok()) return step.status();
    steps_.push_back(*std::move(step));
  }
  if (sequence_.size() > 1) {
    start_.position.SetZero(model.num_positions());
    start_.velocity.SetZero(model.num_velocities());
    start_.strain.SetZero(model.num_strains());
    start_.end_velocity.SetZero(model.num_end_velocities());
    start_.acceleration.SetZero(model.num_velocities());
    start_.multiplier.SetZero(model.num_multipliers());
  }
  return absl::OkStatus();
}

int EnergyMomentumIntegrator::num_factorizations() const {
  int sum = 0;
  for (const ModelStep& step : steps_) sum += step.num_factorizations();
  return sum;
}

std::vector<KeptTangent> EnergyMomentumIntegrator::Keep() const {
  std::vector<KeptTangent> kept;
  for (const ModelStep& step : steps_) {
    for (const auto& part : step.joined()) kept.push_back(part->Keep());
    for (const CoupledStep& part : step.coupled()) kept.push_back(part.Keep());
  }
  return kept;
}

absl::Status EnergyMomentumIntegrator::Restore(
    const std::vector<KeptTangent>& kept) {
  size_t next = 0;
  bool fits = true;
  for (ModelStep& step : steps_) {
    for (const auto& part : step.joined()) {
      fits = fits && next < kept.size() && part->Restore(kept[next++]);
    }
    for (CoupledStep& part : step.coupled()) {
      fits = fits && next < kept.size() && part.Restore(kept[next++]);
    }
  }
  if (fits && next == kept.size()) return absl::OkStatus();
  for (ModelStep& step : steps_) {
    for (const auto& part : step.joined()) {
      static_cast<void>(part->Restore({}));
    }
    for (CoupledStep& part : step.coupled()) {
      static_cast<void>(part.Restore({}));
    }
  }
  return absl::InvalidArgumentError(
      "the factorisations that were kept are not those of this model");
}

bool EnergyMomentumIntegrator::Compose(State& state, StepReport* report) {
  start_ = state;
  for (size_t i = 0; i < sequence_.size(); ++i) {
    StepReport part;
    const bool solved = steps_[sequence_[i]].Advance(state, &part);
    report->iterations += part.iterations;
    report->correction = std::max(report->correction, part.correction);
    if (solved) continue;
    report->termination = part.termination;
    report->message = absl::StrCat("part ", i + 1, " of ", sequence_.size(),
                                   " of ", part.message);
    state = start_;
    return false;
  }
  return true;
}

StepReport EnergyMomentumIntegrator::Step(State& state) {
  EMMY_CHECK(!sequence_.empty(), "an integrator that was moved from");
  EMMY_CHECK(SizeOf(state) == state_size_, "a state of " << SizeOf(state)
                                                         << " for a model of "
                                                         << state_size_);
  StepReport report;
  // A step that is not composed leaves the state by itself when it fails.
  const bool solved = sequence_.size() == 1
                          ? steps_.front().Advance(state, &report)
                          : Compose(state, &report);
  if (!solved) return report;
  ++state.step;
  state.time.Add(options_.time_step);
  report.termination = Termination::kConverged;
  return report;
}

}  // namespace emmy
