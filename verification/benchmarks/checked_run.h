// A run whose steps are timed, and which refuses to time a wrong answer.

#ifndef EMMY_VERIFICATION_BENCHMARKS_CHECKED_RUN_H_
#define EMMY_VERIFICATION_BENCHMARKS_CHECKED_RUN_H_

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_description.h"

namespace emmy::verification {

class CheckedRun {
 public:
  // The model after `warm_up` steps, so that predictors and kept factors are
  // as in a long run. A model that cannot be built or stepped is remembered
  // and reported by TimeSteps.
  CheckedRun(const ModelDescription& description,
             const IntegratorOptions& options, int warm_up = 100);

  // Times steps from the state after the warm-up, each time it is called, one
  // an iteration, and fills the counters: `newton_iterations`, `energy_error`,
  // `angular_momentum_error`, `factorizations` per step. Energy and angular
  // momentum at the end are held against those of the start, before the
  // warm-up; if they are not kept to `bound`, and `bound_per_step` more for
  // each step since the start, or a step fails, the benchmark ends with an
  // error instead of a time.
  void TimeSteps(benchmark::State& state, double bound,
                 double bound_per_step = 0.0);

 private:
  std::string error_;
  std::unique_ptr<const Model> model_;
  State state_;
  State warm_;  // After the warm-up.
  std::optional<EnergyMomentumIntegrator> integrator_;
  std::optional<InvariantMonitor> monitor_;
};

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BENCHMARKS_CHECKED_RUN_H_
