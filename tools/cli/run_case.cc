#include "tools/cli/run_case.h"

#include <chrono>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/simulate.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/progress.h"

namespace emmy {
namespace {

// Writes the rows of the history, each state at most once.
class Recorder {
 public:
  Recorder(const Model& model, const InvariantMonitor& monitor,
           HistoryWriter* history)
      : model_(model), monitor_(monitor), history_(history) {}

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
  int64_t last_step_ = -1;
  absl::Status status_;
};

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

RunSummary RunCase(const RunOptions& options,
                   EnergyMomentumIntegrator& integrator, LoadedCase& loaded,
                   HistoryWriter* history) {
  State& state = loaded.state;
  const int64_t output_every = loaded.description.output_every;
  const int64_t last_step = state.step + options.num_steps;

  InvariantMonitor monitor(loaded.model, state);
  Recorder recorder(loaded.model, monitor, history);
  recorder.Record(state, 0);
  Progress progress(options.num_steps, options.quiet);
  int iterations = 0;
  bool is_finite = true;

  const auto start = std::chrono::steady_clock::now();
  SimulationReport report;
  if (recorder.status().ok()) {
    report = Simulate(
        integrator, state, options.num_steps,
        [&](const State& reached, const StepReport& step) {
          monitor.Observe(reached);
          iterations = step.iterations;
          if (reached.step % output_every == 0 || reached.step == last_step) {
            recorder.Record(reached, iterations);
          }
          progress.Update(reached.step);
          is_finite = IsFinite(monitor.latest());
          return is_finite && recorder.status().ok() && !IsInterrupted();
        });
  }
  const std::chrono::duration<double> wall =
      std::chrono::steady_clock::now() - start;
  progress.Clear();
  recorder.Record(state, iterations);  // Where an early end was reached.

  RunSummary summary;
  summary.case_name = loaded.description.name;
  if (!report.ok()) {
    summary.status = RunStatus::kFailed;
    summary.message = report.message;
  } else if (!is_finite) {
    summary.status = RunStatus::kFailed;
    summary.message = absl::StrFormat(
        "energy or momentum is not finite after step %d at %.6g s", state.step,
        state.time.value);
  } else if (!recorder.status().ok()) {
    summary.status = RunStatus::kFailed;
    summary.message = absl::StrFormat("%s", recorder.status().message());
  } else if (state.step < last_step) {
    summary.status = RunStatus::kInterrupted;
    summary.message = absl::StrFormat("interrupted after step %d at %.6g s",
                                      state.step, state.time.value);
  } else {
    summary.status = RunStatus::kCompleted;
  }
  summary.steps = report.steps;
  summary.time = state.time.value;
  summary.wall_seconds = wall.count();
  summary.degrees_of_freedom = loaded.model.degrees_of_freedom();
  summary.energy = monitor.energy();
  summary.momentum = monitor.momentum();
  summary.angular_momentum = monitor.angular_momentum();
  summary.mean_iterations = report.mean_iterations();
  summary.max_iterations = report.max_iterations;
  return summary;
}

std::string DescribeSummary(const RunSummary& summary) {
  std::string text = absl::StrFormat(
      "%s: %d steps to %.6g s in %.3g s, %.3g iterations a step\n",
      summary.case_name, summary.steps, summary.time, summary.wall_seconds,
      summary.mean_iterations);
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
