// A whole run: steps, invariants of every step, history, progress.

#ifndef EMMY_TOOLS_CLI_RUN_CASE_H_
#define EMMY_TOOLS_CLI_RUN_CASE_H_

#include <cstdint>
#include <string>

#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/history.h"
#include "emmy/io/summary.h"

namespace emmy {

struct RunOptions {
  int64_t num_steps = 0;
  bool quiet = false;
};

// Advances `loaded.state`. The history, if any, gets the start, every
// output step and the last step reached. Ends early if a step fails, if the
// history cannot be written or if IsInterrupted(); the summary tells.
RunSummary RunCase(const RunOptions& options,
                   EnergyMomentumIntegrator& integrator, LoadedCase& loaded,
                   HistoryWriter* history);

// The summary in words, for people.
std::string DescribeSummary(const RunSummary& summary);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_RUN_CASE_H_
