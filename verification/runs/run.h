// One run of a claim: a model, its state, and a scheme that advances it.

#ifndef EMMY_VERIFICATION_RUNS_RUN_H_
#define EMMY_VERIFICATION_RUNS_RUN_H_

#include <cstdint>
#include <functional>
#include <memory>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/model/model_description.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

class Run {
 public:
  static absl::StatusOr<Run> Start(const ModelDescription& description,
                                   const IntegratorOptions& options,
                                   const Scheme& scheme);
  // With all but the time step at their defaults.
  static absl::StatusOr<Run> Start(const ModelDescription& description,
                                   double time_step, const Scheme& scheme);

  const Model& model() const { return *model_; }
  const State& state() const { return state_; }
  State& state() { return state_; }
  // Of the first body.
  BodyMotion Motion() const { return ObserveBody(*model_, state_, 0); }

  // One step as it is, whatever its report says.
  StepReport Step() { return step_(state_); }

  // Fails with kAborted and the step's message if a step does not converge.
  // `observe` is called after each step; may be empty.
  absl::Status Advance(int64_t num_steps,
                       const std::function<void(const Run&)>& observe = {});

 private:
  Run(std::unique_ptr<const Model> model, State state, StepFunction step)
      : model_(std::move(model)),
        state_(std::move(state)),
        step_(std::move(step)) {}

  std::unique_ptr<const Model> model_;  // At a fixed place: step_ refers to it.
  State state_;
  StepFunction step_;
};

// Largest relative errors of the invariants over every step of a run.
struct ConservationErrors {
  double energy = 0.0;
  double momentum = 0.0;
  double angular_momentum = 0.0;
};

absl::StatusOr<ConservationErrors> MeasureConservation(
    const ModelDescription& description, const IntegratorOptions& options,
    int64_t num_steps, const Scheme& scheme);
absl::StatusOr<ConservationErrors> MeasureConservation(
    const ModelDescription& description, double time_step, int64_t num_steps,
    const Scheme& scheme);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_RUN_H_
