#include "emmy/integrate/model_step.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/double_double.h"

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

// The start of the next iteration from the acceleration of this step.
template <typename Derived>
void Predict(Eigen::Index offset, const Eigen::MatrixBase<Derived>& latest,
             State& state) {
  Extrapolation::Errors errors{};
  state.acceleration.Add(offset, latest, &errors);
  state.acceleration.Predict(offset, latest.size(),
                             Extrapolation::BestOrder(errors));
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

absl::StatusOr<ModelStep> ModelStep::Create(
    const Model& model, const std::vector<Structure>& structures,
    double time_step, const ModelStepOptions& options) {
  absl::StatusOr<std::optional<ConventionalStructureStep>> conventional =
      ConventionalStructureStep::Create(model, time_step, options.newton);
  if (!conventional.ok()) return conventional.status();
  return ModelStep(model, structures, time_step, options,
                   *std::move(conventional));
}

ModelStep::ModelStep(
    const Model& model, const std::vector<Structure>& structures,
    double time_step, const ModelStepOptions& options,
    std::optional<ConventionalStructureStep> conventional_structure)
    : model_(&model),
      time_step_(time_step),
      conventional_structure_(std::move(conventional_structure)) {
  const NewtonOptions& newton = options.newton;
  const AncfBodyStep::Tangent tangent = options.always_full_newton
                                            ? AncfBodyStep::Tangent::kFullNewton
                                            : AncfBodyStep::Tangent::kAutomatic;
  for (const Structure& structure : structures) {
    if (structure.is_free_body()) {
      const ModelBody* body = structure.bodies.front().body;
      free_ancf_.push_back(
          {body, AncfBodyStep(*body->ancf(), time_step, newton, tangent),
           AncfBodyIncrement{}});
      continue;
    }
    const CoupledStepOptions coupled = {
        .newton = newton,
        .method = options.factor_method,
        .always_factorize = options.always_full_newton};
    std::unique_ptr<JointStep> joined =
        JointStep::Create(structure, time_step, coupled, options.num_threads);
    if (joined != nullptr) {
      joined_.push_back(std::move(joined));
    } else {
      coupled_.emplace_back(structure, time_step, coupled);
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
        {&body, ConventionalBodyStep(*body.conventional(), time_step, newton),
         ConventionalBodyIncrement{}});
  }
}

int ModelStep::num_factorizations() const {
  int sum = 0;
  for (const auto& step : joined_) sum += step->num_factorizations();
  for (const CoupledStep& step : coupled_) sum += step.num_factorizations();
  return sum;
}

bool ModelStep::Accept(const BodyStepResult& result, const State& state,
                       const std::string& part, StepReport* report) const {
  report->iterations = std::max(report->iterations, result.iterations);
  report->correction = std::max(report->correction, result.correction);
  if (result.termination == Termination::kConverged) return true;
  report->termination = result.termination;
  report->message = absl::StrFormat(
      "step %d at t = %.17g s: %s, worst at %s (time step %g s, %d "
      "iterations, last correction %.3g); the state is that of the last good "
      "step; a smaller time step may help",
      state.step + 1, state.time.value, Reason(result.termination), part,
      time_step_, result.iterations, result.correction);
  return false;
}

bool ModelStep::Solve(const State& state, StepReport* report) {
  const double dt = time_step_;
  // Names are made only on failure, for a step must not allocate.
  const std::string none;
  for (FreeAncf& part : free_ancf_) {
    const BodyStepResult result = part.step.Solve(
        AncfStart(*part.body, state),
        dt * Columns(state.acceleration.next, part.body->velocity_offset + 3),
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
        dt * state.acceleration.next.segment<3>(part.body->velocity_offset + 3),
        &part.increment);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state,
                ok ? none : absl::StrCat("body \"", part.body->name, "\""),
                report)) {
      return false;
    }
  }
  for (const std::unique_ptr<JointStep>& part : joined_) {
    const BodyStepResult result = part->Solve(state);
    const bool ok = result.termination == Termination::kConverged;
    if (!Accept(result, state, ok ? none : part->WorstPart(), report)) {
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
void ModelStep::CommitCentre(const ModelBody& body, State& state) const {
  const double dt = time_step_;
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

void ModelStep::Commit(State& state) {
  const double dt = time_step_;
  for (const FreeAncf& part : free_ancf_) {
    const ModelBody& body = *part.body;
    CommitCentre(body, state);
    const Eigen::Map<const Vector9d> gradients(part.increment.gradients.data());
    const Eigen::Map<const Vector9d> rates(part.increment.rates.data());
    state.position.Add(body.position_offset + 3, gradients);
    state.velocity.Add(body.velocity_offset + 3, rates);
    state.strain.Add(body.strain_offset, part.increment.strain);
    Predict(body.velocity_offset + 3, rates / dt, state);
  }
  for (const FreeConventional& part : free_conventional_) {
    const ModelBody& body = *part.body;
    CommitCentre(body, state);
    state.position.Add(body.position_offset + 3, part.increment.quaternion);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Index w = body.velocity_offset + 3 + i;
      AddCompensated(part.increment.angular_velocity(i),
                     part.increment.angular_velocity_low(i),
                     state.velocity.value(w), state.velocity.compensation(w));
    }
    Predict(body.velocity_offset + 3, part.increment.angular_velocity / dt,
            state);
  }
  for (const auto& part : joined_) part->Commit(state);
  for (const CoupledStep& part : coupled_) part.Commit(state);
  if (conventional_structure_.has_value()) {
    conventional_structure_->Commit(state);
  }
}

}  // namespace emmy
