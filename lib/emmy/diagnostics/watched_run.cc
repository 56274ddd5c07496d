#include "emmy/diagnostics/watched_run.h"

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "emmy/diagnostics/check_state.h"
#include "emmy/diagnostics/invariants.h"

namespace emmy {

SimulationReport WatchedRun(EnergyMomentumIntegrator& integrator,
                            const Model& model, State& state, int64_t num_steps,
                            InvariantMonitor& monitor,
                            const Observer& observer) {
  State last_good = state;
  absl::Status sound;
  SimulationReport report =
      Simulate(integrator, state, num_steps,
               [&](const State& reached, const StepReport& step) {
                 const Invariants measured = MeasureInvariants(model, reached);
                 sound = CheckState(model, reached, measured);
                 if (!sound.ok()) return false;
                 monitor.Observe(measured);
                 last_good = reached;
                 return !observer || observer(reached, step);
               });
  if (sound.ok()) return report;
  report.termination = Termination::kUnsound;
  report.stopped_by_observer = false;
  --report.steps;
  report.message = absl::StrFormat(
      "step %d at t = %.6g s: %s; the state is that of the last good step",
      state.step, last_good.time.value, sound.message());
  state = last_good;
  return report;
}

}  // namespace emmy
