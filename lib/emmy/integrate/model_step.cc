#include "emmy/integrate/model_step.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "absl/base/attributes.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/integrate/failure_text.h"

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

ABSL_ATTRIBUTE_NOINLINE BodyStepResult SolveInGeneral(
    const AncfBodyStep& step, const ModelBody& body, const State& state,
    double time_step, AncfLanesIncrement* increment) {
  AncfBodyIncrement general;
  const BodyStepResult result = step.Solve(
      AncfStart(body, state),
      time_step * Columns(state.acceleration.next, body.velocity_offset + 3),
      &general);
  increment->Set(general);
  return result;
}

ABSL_ATTRIBUTE_NOINLINE BodyStepResult SolveInGeneral(
    const ConventionalBodyStep& step, const ModelBody& body, const State& state,
    double time_step, ConventionalLanesIncrement* increment) {
  ConventionalBodyIncrement general;
  const BodyStepResult result = step.Solve(
      ConventionalStart(body, state),
      time_step * state.acceleration.next.segment<3>(body.velocity_offset + 3),
      &general);
  increment->Set(general);
  return result;
}

// The most that any part needed.
void Record(const BodyStepResult& result, StepReport* report) {
  report->iterations = std::max(report->iterations, result.iterations);
  report->correction = std::max(report->correction, result.correction);
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
    : centre_(time_step, model.gravity()),
      time_step_(time_step),
      conventional_structure_(std::move(conventional_structure)) {
  const NewtonOptions& newton = options.newton;
  const AncfBodyStep::Tangent tangent = options.always_full_newton
                                            ? AncfBodyStep::Tangent::kFullNewton
                                            : AncfBodyStep::Tangent::kAutomatic;
  for (const Structure& structure : structures) {
    if (structure.is_free_body()) {
      const ModelBody* body = structure.bodies.front().body;
      FreeAncf part{body,
                    AncfBodyStep(*body->ancf(), time_step, newton, tangent),
                    std::nullopt,
                    {}};
      if (!options.always_full_newton && part.step.penalty_dominates() &&
          AncfBodyLanes::Fits(*body->ancf())) {
        part.lanes.emplace(*body->ancf(), time_step, newton);
      }
      free_ancf_.push_back(part);
      continue;
    }
    const CoupledStepOptions coupled = {
        .newton = newton,
        .method = options.factor_method,
        .always_factorize = options.always_full_newton,
        .num_threads = options.num_threads};
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
    FreeConventional part{
        &body,
        ConventionalBodyStep(*body.conventional(), time_step, newton),
        std::nullopt,
        {}};
    if (!options.always_full_newton &&
        ConventionalBodyLanes::Fits(*body.conventional())) {
      part.lanes.emplace(*body.conventional(), time_step, newton);
    }
    free_conventional_.push_back(part);
  }
  has_one_free_body_ = free_ancf_.size() + free_conventional_.size() == 1 &&
                       joined_.empty() && coupled_.empty() &&
                       !conventional_structure_.has_value();
}

int ModelStep::num_factorizations() const {
  int sum = 0;
  for (const auto& step : joined_) sum += step->num_factorizations();
  for (const CoupledStep& step : coupled_) sum += step.num_factorizations();
  return sum;
}

// Names are made only on failure, for a step must not allocate.
template <typename Name>
bool ModelStep::Accept(const BodyStepResult& result, const State& state,
                       const Name& name, StepReport* report) const {
  Record(result, report);
  if (result.termination == Termination::kConverged) return true;
  report->termination = result.termination;
  report->message = absl::StrFormat(
      "step %d at t = %.17g s: %s, worst at %s (time step %g s, %d "
      "iterations, last correction %.3g); the state is that of the last good "
      "step; a smaller time step may help",
      state.step + 1, state.time.value, FailureText(result.termination), name(),
      time_step_, result.iterations, result.correction);
  return false;
}

// After `iterations` that have led nowhere.
template <typename Part>
ABSL_ATTRIBUTE_NOINLINE bool ModelStep::SolveFreeInGeneral(
    const State& state, int iterations, Part& part, StepReport* report) const {
  BodyStepResult result =
      SolveInGeneral(part.step, *part.body, state, time_step_, &part.increment);
  result.iterations += iterations;
  const auto name = [&part] {
    return absl::StrCat("body \"", part.body->name, "\"");
  };
  return Accept(result, state, name, report);
}

template <typename Part>
bool ModelStep::SolveFree(const State& state, Part& part,
                          StepReport* report) const {
  BodyStepResult result;
  if (part.lanes.has_value()) {
    result = SolveInLanes(*part.lanes, *part.body, state, &part.increment);
    if (result.termination == Termination::kConverged) {
      Record(result, report);
      return true;
    }
  }
  return SolveFreeInGeneral(state, result.iterations, part, report);
}

bool ModelStep::Solve(const State& state, StepReport* report) {
  for (FreeAncf& part : free_ancf_) {
    if (!SolveFree(state, part, report)) return false;
  }
  for (FreeConventional& part : free_conventional_) {
    if (!SolveFree(state, part, report)) return false;
  }
  for (const std::unique_ptr<JointStep>& part : joined_) {
    const BodyStepResult result = part->Solve(state);
    const auto name = [&part] { return part->WorstPart(); };
    if (!Accept(result, state, name, report)) return false;
  }
  for (CoupledStep& part : coupled_) {
    const BodyStepResult result = part.Solve(state);
    const auto name = [&part] { return part.WorstPart(); };
    if (!Accept(result, state, name, report)) return false;
  }
  if (conventional_structure_.has_value()) {
    const BodyStepResult result = conventional_structure_->Solve(state);
    const auto name = [this] { return conventional_structure_->WorstPart(); };
    if (!Accept(result, state, name, report)) return false;
  }
  return true;
}

void ModelStep::Commit(State& state) {
  for (const FreeAncf& part : free_ancf_) {
    CommitInLanes(part.increment, time_step_, centre_, *part.body, state);
  }
  for (const FreeConventional& part : free_conventional_) {
    CommitInLanes(part.increment, time_step_, centre_, *part.body, state);
  }
  for (const auto& part : joined_) part->Commit(state);
  for (const CoupledStep& part : coupled_) part.Commit(state);
  if (conventional_structure_.has_value()) {
    conventional_structure_->Commit(state);
  }
}

ABSL_ATTRIBUTE_NOINLINE bool ModelStep::SolveAndCommit(State& state,
                                                       StepReport* report) {
  if (!Solve(state, report)) return false;
  Commit(state);
  return true;
}

template <typename Part>
bool ModelStep::AdvanceOnly(Part& part, State& state,
                            StepReport* report) const {
  BodyStepResult result;
  if (part.lanes.has_value()) {
    result = AdvanceInLanes(*part.lanes, centre_, *part.body, state);
    if (result.termination == Termination::kConverged) {
      Record(result, report);
      return true;
    }
  }
  if (!SolveFreeInGeneral(state, result.iterations, part, report)) return false;
  CommitInLanes(part.increment, time_step_, centre_, *part.body, state);
  return true;
}

bool ModelStep::Advance(State& state, StepReport* report) {
  if (!has_one_free_body_) return SolveAndCommit(state, report);
  return free_ancf_.empty()
             ? AdvanceOnly(free_conventional_.front(), state, report)
             : AdvanceOnly(free_ancf_.front(), state, report);
}

}  // namespace emmy
