// The time loop: steps, and an observer after each.

#ifndef EMMY_INTEGRATE_SIMULATE_H_
#define EMMY_INTEGRATE_SIMULATE_H_

#include <cstdint>
#include <functional>
#include <string>

#include "emmy/base/export.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// Called after every accepted step; returning false ends the run.
using Observer = std::function<bool(const State&, const StepReport&)>;

// What became of a run.
struct [[nodiscard]] SimulationReport {
  Termination termination = Termination::kConverged;  // Of the last step.
  bool stopped_by_observer = false;                   // By returning false.
  int64_t steps = 0;             // Accepted steps of this run.
  int64_t total_iterations = 0;  // Of the accepted steps.
  int max_iterations = 0;        // Of one accepted step.
  std::string message;  // Of the step that failed; `state` is before it.

  // No step failed, whether or not the observer ended the run.
  bool ok() const { return termination == Termination::kConverged; }
  // Per accepted step; 0 without one.
  double mean_iterations() const {
    return steps > 0 ? static_cast<double>(total_iterations) /
                           static_cast<double>(steps)
                     : 0.0;
  }
};

// Takes up to `num_steps` steps from `state`, which ends after the last one
// that was accepted. Without an observer nothing is called.
EMMY_EXPORT SimulationReport Simulate(EnergyMomentumIntegrator& integrator,
                                      State& state, int64_t num_steps,
                                      const Observer& observer);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_SIMULATE_H_
