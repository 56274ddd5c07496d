// The energy-momentum integrator of a whole model, of order two, four or six.
//
//   Δq/Δt = w̄ = ½ (w₀ + w₁),  M Δw/Δt + f̄(q₀, q₁) = F̄
// Second order, time-reversible, exact in energy, momentum and angular
// momentum for any step and stiffness, up to the residual r left by the
// iteration:  E₁ − E₀ = Σ r·w̄                                      (EM-7)
// Orders four and six are compositions of such steps (COMP-1, COMP-2), so the
// same holds for them.
//
// State: advanced by compensated summation (SUM-2)                   (EM-4).

#ifndef EMMY_INTEGRATE_ENERGY_MOMENTUM_H_
#define EMMY_INTEGRATE_ENERGY_MOMENTUM_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/integrate/model_step.h"
#include "emmy/integrate/structure.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/model/state_size.h"
#include "emmy/numerics/newton.h"
#include "emmy/numerics/symmetric_factor.h"

namespace emmy {

// Order and length of a step, and how its equations are solved.
struct IntegratorOptions {
  int order = 2;           // 2, 4 or 6.
  double time_step = 0.0;  // Δt [s]; negative steps go back in time.
  // Empty: to round-off. Else relative, in (0, 1): see NewtonOptions.
  std::optional<double> tolerance = std::nullopt;
  // Of one attempt at a step or at a part of one. Structures are tried up to
  // five times; where conventional bodies are attached to lines, an attempt
  // that still shrinks goes on for up to three times as many.
  int max_iterations = 60;
  // The reference path for tests: Newton's method with the exact Jacobian for
  // free bodies, a fresh factorisation in every iteration for structures.
  bool always_full_newton = false;
  // How the equations of structures are factorised.
  SymmetricFactor::Method factor_method = SymmetricFactor::Method::kAutomatic;
  // For long chains of joined bodies and large nets; at least 1. The bits do
  // not depend on it.
  int num_threads = 1;
};

class EMMY_EXPORT EnergyMomentumIntegrator {
 public:
  // `model` must outlive the integrator. Fails with kInvalidArgument, naming
  // the JSON pointer `/integrator/...`, if an option is out of range, and
  // with kUnimplemented if conventional and ANCF bodies are joined.
  static absl::StatusOr<EnergyMomentumIntegrator> Create(
      const Model& model, const IntegratorOptions& options);

  // Here, so that whoever links to a shared library needs no other symbol.
  EnergyMomentumIntegrator(EnergyMomentumIntegrator&&) noexcept;
  // The same.
  EnergyMomentumIntegrator& operator=(EnergyMomentumIntegrator&&) noexcept;
  ~EnergyMomentumIntegrator();

  // Advances `state` by one step, of one, ten or eighteen parts. Unless the
  // report is ok, `state` is as before, whichever part failed; the message
  // names it. No heap allocation in a step that converges, except where
  // a structure renews a sparse factor. The iterations
  // reported are the sum over the parts, the correction is the largest.
  StepReport Step(State& state);

  // What is kept from step to step besides the state: factorisations of
  // structures, one for each size of step and structure. With its state and
  // what was kept then, another integrator of the same model and options goes
  // on with the same bits.
  std::vector<KeptTangent> Keep() const;
  // The inverse. Fails with kInvalidArgument, and forgets all factorisations,
  // if `kept` does not fit.
  absl::Status Restore(const std::vector<KeptTangent>& kept);

  // As given to Create.
  const IntegratorOptions& options() const { return options_; }

  // Factorisations of structures so far.
  int num_factorizations() const;

 private:
  EnergyMomentumIntegrator(const Model& model,
                           const IntegratorOptions& options);
  absl::Status MakeSteps(const Model& model);
  bool Compose(State& state, StepReport* report);

  IntegratorOptions options_;
  StateSize state_size_;
  // Behind a pointer, since the steps refer to them.
  std::unique_ptr<const std::vector<Structure>> structures_;
  std::vector<ModelStep> steps_;  // One for each size there is.
  std::vector<size_t> sequence_;  // Indices of `steps_`, in order of time.
  State start_;                   // Of a composed step, in case it fails.
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_ENERGY_MOMENTUM_H_
