// A whole run: steps, invariants of every step, history, progress.

#ifndef EMMY_TOOLS_CLI_RUN_CASE_H_
#define EMMY_TOOLS_CLI_RUN_CASE_H_

#include <cstdint>
#include <string>

#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/checkpoint.h"
#include "emmy/io/history.h"
#include "emmy/io/summary.h"
#include "tools/cli/checkpointer.h"

namespace emmy {

struct RunOptions {
  int64_t num_steps = 0;  // From the start, not from `resume`.
  bool quiet = false;
  CheckpointSettings checkpoint;
  // To go on from; `integrator` and `history` have taken it up already.
  const Checkpoint* resume = nullptr;
};

struct RunResult {
  RunSummary summary;  // Of the whole run, what was before `resume` included.
  bool has_checkpoint = false;  // It has written one itself.
  // It ended early, and a checkpoint says where to go on: its own, or else the
  // one it began from.
  bool can_be_resumed = false;
};

// Advances `loaded.state`. The history, if any, is open, and gets its header
// (unless it is one to go on with), the start, every output step and the last
// step reached. Ends early if a step fails, if the history or a checkpoint
// cannot be written or if IsInterrupted(); the summary tells. Checkpoints are
// written at the start, when they are due, and at the end; each after the rows
// before it are on the disk.
RunResult RunCase(const RunOptions& options,
                  EnergyMomentumIntegrator& integrator, LoadedCase& loaded,
                  HistoryWriter* history);

// The summary in words, for people.
std::string DescribeSummary(const RunSummary& summary);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_RUN_CASE_H_
