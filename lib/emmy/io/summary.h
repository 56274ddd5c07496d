// summary.json: what became of a run, in one small file (emmy-summary/1).

#ifndef EMMY_IO_SUMMARY_H_
#define EMMY_IO_SUMMARY_H_

#include <cstdint>
#include <string>

#include "emmy/base/export.h"
#include "emmy/diagnostics/invariant_monitor.h"

namespace emmy {

// How a run ended.
enum class RunStatus {
  kCompleted,    // All steps done.
  kFailed,       // Stopped by an error before that; the message says which.
  kInterrupted,  // Stopped from outside (Ctrl-C).
};

// What became of a run.
struct RunSummary {
  std::string case_name;                  // Case::name
  RunStatus status = RunStatus::kFailed;  // How it ended.
  std::string message;                    // Empty if completed.
  int64_t steps = 0;                      // Accepted steps.
  double time = 0.0;                      // Reached [s].
  double wall_seconds = 0.0;              // Of all its parts, if resumed [s].
  int64_t degrees_of_freedom = 0;         // Model::degrees_of_freedom
  EnergyRecord energy;                    // InvariantMonitor::energy
  MomentumRecord momentum;                // InvariantMonitor::momentum
  MomentumRecord angular_momentum;        // InvariantMonitor::angular_momentum
  double mean_iterations = 0.0;           // Per step.
  int max_iterations = 0;                 // Of one step.
};

// "completed", "failed" or "interrupted".
EMMY_EXPORT std::string StatusName(RunStatus status);

// The text of summary.json, with the build of this library. JSON has no NaN
// and no infinity; in their place stands null.
EMMY_EXPORT std::string WriteSummary(const RunSummary& summary);

}  // namespace emmy

#endif  // EMMY_IO_SUMMARY_H_
