#include "emmy/integrate/energy_momentum.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/double_double.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

Matrix3d Columns(const VectorXd& vector, Eigen::Index offset) {
  return Eigen::Map<const Matrix3d>(vector.data() + offset);
}

AncfBodyStart AncfStart(const ModelBody& body, const State& state) {
  const Eigen::Index q = body.position_offset + 3;
  const Eigen::Index w = body.velocity_offset + 3;
  const Eigen::Index s = body.strain_offset;
  return {.gradients = Columns(state.position.value, q),
          .gradients_compensation = Columns(state.position.compensation, q),
          .rates = Columns(state.velocity.value, w),
          .rates_compensation = Columns(state.velocity.compensation, w),
          .strain = state.strain.value.segment<6>(s),
          .strain_compensation = state.strain.compensation.segment<6>(s)};
}

ConventionalBodyStart ConventionalStart(const ModelBody& body,
                                        const State& state) {
  const Eigen::Index q = body.position_offset + 3;
  const Eigen::Index w = body.velocity_offset + 3;
  return {.quaternion = state.position.value.segment<4>(q),
          .quaternion_compensation = state.position.compensation.segment<4>(q),
          .angular_velocity = state.velocity.value.segment<3>(w),
          .angular_velocity_compensation =
              state.velocity.compensation.segment<3>(w)};
}

const char* Reason(Termination termination) {
  switch (termination) {
    case Termination::kSingularTangent:
      return "the tangent is singular";
    case Termination::kNonFinite:
      return "a value is not finite";
    case Termination::kConverged:
    case Termination::kMaxIterations:
      break;
  }
  return "the iteration does not converge";
}

}  // namespace

absl::StatusOr<EnergyMomentumIntegrator> EnergyMomentumIntegrator::Create(
    const Model& model, const IntegratorOptions& options) {
  if (options.order != 2) {
    return FieldError("/integrator/order", "2", std::to_string(options.order));
  }
  if (!std::isfinite(options.time_step) || options.time_step == 0.0) {
    return FieldError("/integrator/time_step", "a finite number > 0 [s]",
                      NumberText(options.time_step));
  }
  if (options.tolerance.has_value() &&
      !(*options.tolerance > 0.0 && *options.tolerance < 1.0)) {
    return FieldError("/integrator/tolerance",
                      "\"round_off\" or a number between 0 and 1",
                      NumberText(*options.tolerance));
  }
  const NewtonOptions newton{.tolerance = options.tolerance,
                             .max_iterations = options.max_iterations};
  absl::StatusOr<std::optional<ConventionalStructureStep>> conventional =
      ConventionalStructureStep::Create(model, options.time_step, newton);
  if (!conventional.ok()) return conventional.status();
  return EnergyMomentumIntegrator(model, options, *std::move(conventional));
}

EnergyMomentumIntegrator::EnergyMomentumIntegrator(
    const Model& model, const IntegratorOptions& options,
    std::optional<ConventionalStructureStep> conventional_structure)
    : model_(&model),
      options_(options),
      structures_(std::make_unique<const std::vector<Structure>>(
          SplitIntoStructures(model))),
      conventional_structure_(std::move(conventional_structure)) {
  const NewtonOptions newton{.tolerance = options.tolerance,
                             .max_iterations = options.max_iterations};
  const AncfBodyStep::Tangent tangent = options.always_full_newton
                                            ? AncfBodyStep::Tangent::kFullNewton
                                            : AncfBodyStep::Tangent::kAutomatic;
  for (const Structure& structure : *structures_) {
    if (structure.is_free_body()) {
      const ModelBody* body = structure.bodies.front().body;
      free_ancf_.push_back(
          {body,
           AncfBodyStep(*body->ancf(), options.time_step, newton, tangent),
           AncfBodyIncrement{}});
    } else {
      coupled_.emplace_back(
          structure, options.time_step,
          CoupledStepOptions{.newton = newton,
                             .method = options.factor_method,
                             .always_factorize = options.always_full_newton});
    }
  }
  for (size_t i = 0; i < model.bodies().size(); ++i) {
    const ModelBody& body = model.bodies()[i];
    if (body.conventional() == nullptr) continue;
    if (conventional_structure_.has_value() &&
        conventional_structure_->Contains(i)) {
      continue;
    }
    free_conventional_.push_back(
        {&body,
         ConventionalBodyStep(*body.conventional(), options.time_step, newton),
         ConventionalBodyIncrement{}});
  }
}

int EnergyMomentumIntegrator::num_factorizations() const {
  int sum = 0;
  for (const CoupledStep& step : coupled_) sum += step.num_factorizations();
  return sum;
}

bool EnergyMomentumIntegrator::Accept(const BodyStepResult& result,
                                      const State& state,
                                      const std::string& part,
                                      StepReport* report) const {
  report->iterations = std::max(report->iterations, result.iterations);
  report->correction = std::max(report->correction, result.correction);
  if (result.termination == Termination::kConverged) return true;
  report->termination = result.termination;
  report->message = absl::StrFormat(
      "step %d at t = %.17g s: %s, worst at %s (time step %g s, %d "
      "iterations, last correction %.3g); the state is that of the last good "
      "step; a smaller time step may help",
      state.step + 1, state.time.value, Reason(result.termination), part,
      options_.time_step, result.iterations, result.correction);
  return false;
}

bool EnergyMomentumIntegrator::SolveAll(const State& state,
                                        StepReport* report) {
  const double dt = options_.time_step;
  // Names are made only on failure, for a step must not allocate.
  const std::string none;
  for (FreeAncf& part : free_ancf_) {
    const BodyStepResult result = part.step.Solve(
        AncfStart(*part.body, state),
        dt * Columns(state.acceleration_guess, part.body->velocity_offset + 3),
        &part.increment);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state,
                ok ? none : absl::StrCat("body \"", part.body->name, "\""),
                report)) {
      return false;
    }
  }
  for (FreeConventional& part : free_conventional_) {
    const BodyStepResult result = part.step.Solve(
        ConventionalStart(*part.body, state),
        dt *
            state.acceleration_guess.segment<3>(part.body->velocity_offset + 3),
        &part.increment);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state,
                ok ? none : absl::StrCat("body \"", part.body->name, "\""),
                report)) {
      return false;
    }
  }
  for (CoupledStep& part : coupled_) {
    const BodyStepResult result = part.Solve(state);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state, ok ? none : part.WorstPart(), report)) {
      return false;
    }
  }
  if (conventional_structure_.has_value()) {
    const BodyStepResult result = conventional_structure_->Solve(state);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state, ok ? none : "a conventional body's structure",
                report)) {
      return false;
    }
  }
  return true;
}

// A constant force moves the centre of mass alone: solved in closed form.
void EnergyMomentumIntegrator::CommitCentre(const ModelBody& body,
                                            State& state) const {
  const double dt = options_.time_step;
  const Eigen::Index w = body.velocity_offset;
  const Vector3d velocity_increment = dt * model_->gravity();
  const Vector3d mean_velocity =
      state.velocity.value.segment<3>(w) +
      (state.velocity.compensation.segment<3>(w) + 0.5 * velocity_increment);
  // With its rounding error: a free body's velocity is the same in every step,
  // and so would be the rounding of the product, which then drifts.
  for (int i = 0; i < 3; ++i) {
    const SumAndError product = TwoProduct(dt, mean_velocity(i));
    AddCompensated(product.sum, product.error,
                   state.position.value(body.position_offset + i),
                   state.position.compensation(body.position_offset + i));
  }
  state.velocity.Add(w, velocity_increment);
}

void EnergyMomentumIntegrator::Commit(State& state) const {
  const double dt = options_.time_step;
  for (const FreeAncf& part : free_ancf_) {
    const ModelBody& body = *part.body;
    CommitCentre(body, state);
    const Eigen::Map<const Vector9d> gradients(part.increment.gradients.data());
    const Eigen::Map<const Vector9d> rates(part.increment.rates.data());
    state.position.Add(body.position_offset + 3, gradients);
    state.velocity.Add(body.velocity_offset + 3, rates);
    state.strain.Add(body.strain_offset, part.increment.strain);
    state.acceleration_guess.segment<9>(body.velocity_offset + 3) = rates / dt;
  }
  for (const FreeConventional& part : free_conventional_) {
    const ModelBody& body = *part.body;
    CommitCentre(body, state);
    state.position.Add(body.position_offset + 3, part.increment.quaternion);
    state.velocity.Add(body.velocity_offset + 3,
                       part.increment.angular_velocity);
    state.acceleration_guess.segment<3>(body.velocity_offset + 3) =
        part.increment.angular_velocity / dt;
  }
  for (const CoupledStep& part : coupled_) part.Commit(state);
  if (conventional_structure_.has_value()) {
    conventional_structure_->Commit(state);
  }
  ++state.step;
  state.time.Add(dt);
}

StepReport EnergyMomentumIntegrator::Step(State& state) {
  StepReport report;
  if (!SolveAll(state, &report)) return report;
  Commit(state);
  report.termination = Termination::kConverged;
  return report;
}

}  // namespace emmy
