// The time loop of a run whose every state is measured and has to be sound.

#ifndef EMMY_DIAGNOSTICS_WATCHED_RUN_H_
#define EMMY_DIAGNOSTICS_WATCHED_RUN_H_

#include <cstdint>

#include "emmy/base/export.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/integrate/simulate.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// As Simulate, with CheckState after every step: `monitor`, which must have
// observed `state`, observes those that pass, and then `observer`, which may be
// empty, is called. At the first that does not, `state` is set back to the one
// before, and the report says which step it was and why. Takes memory for
// another state, and the time to copy one in every step.
EMMY_EXPORT SimulationReport WatchedRun(EnergyMomentumIntegrator& integrator,
                                        const Model& model, State& state,
                                        int64_t num_steps,
                                        InvariantMonitor& monitor,
                                        const Observer& observer);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_WATCHED_RUN_H_
