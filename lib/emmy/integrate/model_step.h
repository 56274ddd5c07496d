// The energy-momentum step of a whole model, part by part.
//
//   Δq/Δt = w̄ = ½ (w₀ + w₁),  M Δw/Δt + f̄(q₀, q₁) = F̄        (EM-1, EM-2)
// Parts that nothing joins are solved apart: free bodies of either formulation,
// then structures. Second order and symmetric; see energy_momentum.h for what
// is made of it.

#ifndef EMMY_INTEGRATE_MODEL_STEP_H_
#define EMMY_INTEGRATE_MODEL_STEP_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/integrate/ancf_body_lanes.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/conventional_body_lanes.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/integrate/conventional_structure_step.h"
#include "emmy/integrate/coupled_step.h"
#include "emmy/integrate/joint_step.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

// How the equations of a step are solved; see IntegratorOptions.
struct ModelStepOptions {
  NewtonOptions newton;             // When to stop.
  bool always_full_newton = false;  // The reference path for tests.
  // Of structures.
  SymmetricFactor::Method factor_method = SymmetricFactor::Method::kAutomatic;
  int num_threads = 1;  // Of long chains and large nets.
};

class ModelStep {
 public:
  // `model` and its `structures` must outlive the step. Fails with
  // kUnimplemented if conventional and ANCF bodies are joined.
  static absl::StatusOr<ModelStep> Create(
      const Model& model, const std::vector<Structure>& structures,
      double time_step, const ModelStepOptions& options);

  // Δt [s]
  double time_step() const { return time_step_; }

  // Solves for the next state; `state` is not changed. If it returns false,
  // `report` says why; its termination is not touched otherwise. No heap
  // allocation if the step converges, except for a sparse factor.
  bool Solve(const State& state, StepReport* report);

  // Advances `state` by the last solution, except its time and step number.
  void Commit(State& state);

  // Both at once; if it returns false, `state` is not changed. A model of one
  // free body spares itself the way through the increments.
  bool Advance(State& state, StepReport* report);

  // What each structure's step keeps from step to step.
  const std::vector<CoupledStep>& coupled() const { return coupled_; }
  // The same, to restore it.
  std::vector<CoupledStep>& coupled() { return coupled_; }

  // The same of joined conventional bodies.
  const std::vector<std::unique_ptr<JointStep>>& joined() const {
    return joined_;
  }

  // Factorisations of structures so far.
  int num_factorizations() const;

 private:
  // A rigid body to which nothing is attached.
  template <typename StepType, typename LanesType, typename IncrementType>
  struct FreePart {
    const ModelBody* body;
    StepType step;
    std::optional<LanesType> lanes;  // Tried first, where it fits.
    IncrementType increment;
  };
  using FreeAncf = FreePart<AncfBodyStep, AncfBodyLanes, AncfLanesIncrement>;
  using FreeConventional = FreePart<ConventionalBodyStep, ConventionalBodyLanes,
                                    ConventionalLanesIncrement>;

  ModelStep(const Model& model, const std::vector<Structure>& structures,
            double time_step, const ModelStepOptions& options,
            std::optional<ConventionalStructureStep> conventional_structure);

  template <typename Name>
  bool Accept(const BodyStepResult& result, const State& state,
              const Name& name, StepReport* report) const;
  template <typename Part>
  bool SolveFree(const State& state, Part& part, StepReport* report) const;
  template <typename Part>
  bool SolveFreeInGeneral(const State& state, int iterations, Part& part,
                          StepReport* report) const;
  template <typename Part>
  bool AdvanceOnly(Part& part, State& state, StepReport* report) const;
  bool SolveAndCommit(State& state, StepReport* report);

  CentreIncrement centre_;
  double time_step_;
  bool has_one_free_body_ = false;
  std::vector<FreeAncf> free_ancf_;
  std::vector<FreeConventional> free_conventional_;
  std::vector<std::unique_ptr<JointStep>> joined_;
  std::vector<CoupledStep> coupled_;
  std::optional<ConventionalStructureStep> conventional_structure_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_MODEL_STEP_H_
