// The energy-momentum step of a whole model.
//
//   Δq/Δt = w̄ = ½ (w₀ + w₁),  M Δw/Δt + f̄(q₀, q₁) = F̄
// Second order, time-reversible, exact in energy, momentum and angular
// momentum for any step and stiffness, up to the residual r left by the
// iteration:  E₁ − E₀ = Σ r·w̄                                      (EM-7)
//
// State: advanced by compensated summation (SUM-2)                   (EM-4).

#ifndef EMMY_INTEGRATE_ENERGY_MOMENTUM_H_
#define EMMY_INTEGRATE_ENERGY_MOMENTUM_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/integrate/conventional_structure_step.h"
#include "emmy/integrate/coupled_step.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

struct IntegratorOptions {
  int order = 2;
  double time_step = 0.0;  // Δt [s]; negative steps go back in time.
  // Empty: to round-off. Else relative, in (0, 1): see NewtonOptions.
  std::optional<double> tolerance;
  int max_iterations = 60;
  // The reference path for tests: Newton's method with the exact Jacobian for
  // free bodies, a fresh factorisation in every iteration for structures.
  bool always_full_newton = false;
  // How the equations of structures are factorised.
  SymmetricFactor::Method factor_method = SymmetricFactor::Method::kAutomatic;
};

class EnergyMomentumIntegrator {
 public:
  // `model` must outlive the integrator. Fails with kInvalidArgument, naming
  // the JSON pointer `/integrator/...`, if an option is out of range, and
  // with kUnimplemented if conventional and ANCF bodies are joined.
  static absl::StatusOr<EnergyMomentumIntegrator> Create(
      const Model& model, const IntegratorOptions& options);

  // Advances `state` by one step. Unless the report is ok, `state` is
  // unchanged. No heap allocation in a step that converges.
  StepReport Step(State& state);

  const IntegratorOptions& options() const { return options_; }

  // Factorisations of structures so far.
  int num_factorizations() const;

 private:
  // A rigid body to which nothing is attached.
  template <typename StepType, typename IncrementType>
  struct FreePart {
    const ModelBody* body;
    StepType step;
    IncrementType increment;
  };
  using FreeAncf = FreePart<AncfBodyStep, AncfBodyIncrement>;
  using FreeConventional =
      FreePart<ConventionalBodyStep, ConventionalBodyIncrement>;

  EnergyMomentumIntegrator(
      const Model& model, const IntegratorOptions& options,
      std::optional<ConventionalStructureStep> conventional_structure);

  bool Accept(const BodyStepResult& result, const State& state,
              const std::string& part, StepReport* report) const;
  bool SolveAll(const State& state, StepReport* report);
  void CommitCentre(const ModelBody& body, State& state) const;
  void Commit(State& state) const;

  const Model* model_;
  IntegratorOptions options_;
  // Behind a pointer, since the coupled steps refer to them.
  std::unique_ptr<const std::vector<Structure>> structures_;
  std::vector<FreeAncf> free_ancf_;
  std::vector<FreeConventional> free_conventional_;
  std::vector<CoupledStep> coupled_;
  std::optional<ConventionalStructureStep> conventional_structure_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_ENERGY_MOMENTUM_H_
