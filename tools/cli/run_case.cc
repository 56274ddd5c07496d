#include "tools/cli/run_case.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/diagnostics/watched_run.h"
#include "emmy/integrate/simulate.h"
#include "emmy/model/validation.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/progress.h"

namespace emmy {
namespace {

// Writes the rows of the history, each state at most once.
class Recorder {
 public:
  // The row of `last_step` is there already; −1: none is.
  Recorder(const Model& model, const InvariantMonitor& monitor,
           HistoryWriter* history, int64_t last_step)
      : model_(model),
        monitor_(monitor),
        history_(history),
        last_step_(last_step) {}

  // The header and the row of the start, for a history that is open.
  void Begin(const State& state) {
    if (history_ == nullptr) return;
    status_ = history_->Begin();
    Record(state, 0);
  }

  // `monitor` must have observed `state`.
  void Record(const State& state, int iterations) {
    if (history_ == nullptr || !status_.ok() || state.step == last_step_) {
      return;
    }
    last_step_ = state.step;
    status_ = history_->Write(model_, state, monitor_.latest(), iterations);
  }

  const absl::Status& status() const { return status_; }

 private:
  const Model& model_;
  const InvariantMonitor& monitor_;
  HistoryWriter* history_;
  int64_t last_step_;
  absl::Status status_;
};

// Iterations and time of a run, over all its parts.
struct Effort {
  int64_t total_iterations = 0;
  int max_iterations = 0;
  int last_iterations = 0;
  double wall_seconds = 0.0;
};

Effort EffortBefore(const Checkpoint* resume) {
  if (resume == nullptr) return {};
  const auto whole = [](int64_t value) {
    return static_cast<int>(
        std::min<int64_t>(value, std::numeric_limits<int>::max()));
  };
  return {.total_iterations = resume->total_iterations,
          .max_iterations = whole(resume->max_iterations),
          .last_iterations = whole(resume->last_iterations),
          .wall_seconds = resume->wall_seconds};
}

std::string DescribeInvariant(const char* name, const char* unit,
                              double max_error, double scale,
                              double max_relative_error, bool conserved) {
  if (!conserved) {
    return absl::StrFormat("  %-17s not conserved by this model\n", name);
  }
  return absl::StrFormat("  %-17s largest error %.1e of %.4g %s: %.1e\n", name,
                         max_error, scale, unit, max_relative_error);
}

}  // namespace

RunResult RunCase(const RunOptions& options,
                  EnergyMomentumIntegrator& integrator, LoadedCase& loaded,
                  HistoryWriter* history) {
  State& state = loaded.state;
  const int64_t output_every = loaded.description.output_every;
  const int64_t last_step = options.num_steps;
  InvariantMonitor monitor(loaded.model, state);
  int64_t last_row = -1;
  if (options.resume != nullptr) {
    state = options.resume->state;
    monitor.Resume(state, options.resume->extremes);
    // Rows in between, of an end that was none, are not in the checkpoint.
    last_row = state.step - state.step % output_every;
  }
  const auto start = std::chrono::steady_clock::now();
  const Effort before = EffortBefore(options.resume);
  Effort effort = before;
  const auto update_time = [&] {
    const std::chrono::duration<double> wall =
        std::chrono::steady_clock::now() - start;
    effort.wall_seconds = before.wall_seconds + wall.count();
  };
  // The text of a large case takes a second: once, and only if it is needed.
  uint64_t case_checksum = 0;
  if (options.resume != nullptr) {
    case_checksum = options.resume->case_checksum;
  } else if (!options.checkpoint.path.empty()) {
    case_checksum = CaseChecksum(loaded.description);
  }
  Recorder recorder(loaded.model, monitor, history, last_row);
  Checkpointer checkpointer(
      options.checkpoint, [&]() -> absl::StatusOr<Checkpoint> {
        update_time();
        Checkpoint checkpoint{.case_name = loaded.description.name,
                              .case_checksum = case_checksum,
                              .build = CheckpointBuild(),
                              .state = state,
                              .kept = integrator.Keep(),
                              .extremes = monitor.extremes(),
                              .total_iterations = effort.total_iterations,
                              .max_iterations = effort.max_iterations,
                              .last_iterations = effort.last_iterations,
                              .wall_seconds = effort.wall_seconds,
                              .history = std::nullopt};
        if (history == nullptr) return checkpoint;
        const absl::StatusOr<HistoryPosition> position = history->Sync();
        if (!position.ok()) return position.status();
        checkpoint.history = *position;
        return checkpoint;
      });
  const auto files_ok = [&] {
    return recorder.status().ok() && checkpointer.status().ok();
  };
  if (options.resume == nullptr) {
    recorder.Begin(state);
    if (files_ok()) checkpointer.Write(state.step);
  }
  Progress progress(state.step, last_step, options.quiet);
  SimulationReport report;
  if (files_ok()) {
    report =
        WatchedRun(integrator, loaded.model, state, last_step - state.step,
                   monitor, [&](const State& reached, const StepReport& step) {
                     effort.total_iterations += step.iterations;
                     effort.max_iterations =
                         std::max(effort.max_iterations, step.iterations);
                     effort.last_iterations = step.iterations;
                     if (reached.step % output_every == 0) {
                       recorder.Record(reached, step.iterations);
                     }
                     if (recorder.status().ok()) {
                       checkpointer.Stepped(reached.step);
                     }
                     progress.Update(reached.step);
                     return files_ok() && !IsInterrupted();
                   });
  }
  progress.Clear();
  // Before the row of an end that is no output step: whoever goes on, goes on
  // without it.
  if (files_ok()) checkpointer.Write(state.step);
  recorder.Record(state, effort.last_iterations);
  update_time();

  RunResult result;
  RunSummary& summary = result.summary;
  summary.case_name = loaded.description.name;
  summary.status = RunStatus::kFailed;
  if (!report.ok()) {
    summary.message = report.message;
  } else if (!recorder.status().ok()) {
    summary.message = absl::StrFormat("%s", recorder.status().message());
  } else if (!checkpointer.status().ok()) {
    summary.message = absl::StrFormat("%s", checkpointer.status().message());
  } else if (state.step < last_step) {
    summary.status = RunStatus::kInterrupted;
    summary.message = absl::StrFormat("interrupted after step %d at %.6g s",
                                      state.step, state.time.value);
  } else {
    summary.status = RunStatus::kCompleted;
  }
  result.has_checkpoint = checkpointer.has_written();
  result.can_be_resumed = summary.status != RunStatus::kCompleted &&
                          report.ok() &&
                          (result.has_checkpoint || options.resume != nullptr);
  summary.steps = state.step;
  summary.time = state.time.value;
  summary.wall_seconds = effort.wall_seconds;
  summary.degrees_of_freedom = loaded.model.degrees_of_freedom();
  summary.energy = monitor.energy();
  summary.momentum = monitor.momentum();
  summary.angular_momentum = monitor.angular_momentum();
  summary.mean_iterations = state.step > 0
                                ? static_cast<double>(effort.total_iterations) /
                                      static_cast<double>(state.step)
                                : 0.0;
  summary.max_iterations = effort.max_iterations;
  return result;
}

std::string DescribeSummary(const RunSummary& summary) {
  std::string text = absl::StrFormat(
      "%s: %d steps to %.6g s in %.3g s, %.3g iterations a step\n",
      EscapeControls(summary.case_name), summary.steps, summary.time,
      summary.wall_seconds, summary.mean_iterations);
  const EnergyRecord& energy = summary.energy;
  text += DescribeInvariant("energy", "J", energy.max_error, energy.scale,
                            energy.max_relative_error(), energy.conserved);
  const auto add = [&](const char* name, const char* unit,
                       const MomentumRecord& record) {
    text += DescribeInvariant(name, unit, record.max_error, record.scale,
                              record.max_relative_error(), record.conserved);
  };
  add("momentum", "kg m/s", summary.momentum);
  add("angular momentum", "kg m^2/s", summary.angular_momentum);
  return text;
}

}  // namespace emmy
