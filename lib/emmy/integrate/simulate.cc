#include "emmy/integrate/simulate.h"

#include <algorithm>

namespace emmy {

SimulationReport Simulate(EnergyMomentumIntegrator& integrator, State& state,
                          int64_t num_steps, const Observer& observer) {
  SimulationReport report;
  for (int64_t i = 0; i < num_steps; ++i) {
    const StepReport step = integrator.Step(state);
    if (!step.ok()) {
      report.termination = step.termination;
      report.message = step.message;
      return report;
    }
    ++report.steps;
    report.total_iterations += step.iterations;
    report.max_iterations = std::max(report.max_iterations, step.iterations);
    if (observer && !observer(state, step)) {
      report.stopped_by_observer = true;
      return report;
    }
  }
  return report;
}

}  // namespace emmy
