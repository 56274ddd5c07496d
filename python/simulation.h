// A model, its state and what steps it, as one object with one owner.

#ifndef EMMY_PYTHON_SIMULATION_H_
#define EMMY_PYTHON_SIMULATION_H_

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "python/history.h"

namespace emmy::python {

// Become emmy.InputError and emmy.StepError.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct StepError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Simulation {
 public:
  // Both throw InputError with the message of the program `emmy`, and work
  // without Python's lock. `threads` is at least 1.
  static std::unique_ptr<Simulation> FromFile(
      const std::string& path, const std::vector<std::string>& overrides,
      int threads);
  static std::unique_ptr<Simulation> FromText(
      const std::string& text, const std::vector<std::string>& overrides,
      int threads);

  // What a run does besides stepping.
  struct RunOptions {
    int64_t num_steps = 0;
    int64_t record_every = 0;  // 0: no history.
    // progress(steps done, steps in all), at most ten times a second and at
    // the end; ends the run by returning what is neither None nor true.
    pybind11::object progress = pybind11::none();
  };

  // Steps without Python's lock, which it takes ten times a second to look for
  // Ctrl-C. Throws StepError if a step fails, and whatever a signal handler or
  // `progress` raises; the state is that after the last good step, and
  // history() ends with it. If memory runs out, history() has the rows for
  // which there was some.
  void Run(const RunOptions& options);

  // The rows of the last run that recorded any; else null.
  const std::shared_ptr<History>& history() const { return history_; }

  const Case& description() const { return loaded_->description; }
  const Model& model() const { return loaded_->model; }
  const State& state() const { return loaded_->state; }
  const InvariantMonitor& monitor() const { return monitor_; }

 private:
  Simulation(std::string prefix, std::unique_ptr<LoadedCase> loaded,
             EnergyMomentumIntegrator integrator);

  static std::unique_ptr<Simulation> Create(
      const std::string& prefix, std::unique_ptr<LoadedCase> loaded,
      const std::optional<std::string>& path,
      const std::vector<std::string>& overrides, int threads);

  std::string prefix_;                  // Of messages: "<file>: " or empty.
  std::unique_ptr<LoadedCase> loaded_;  // Pinned: the integrator refers to it.
  EnergyMomentumIntegrator integrator_;
  InvariantMonitor monitor_;
  std::shared_ptr<History> history_;
  int iterations_ = 0;  // Of the last step.
  bool running_ = false;
};

}  // namespace emmy::python

#endif  // EMMY_PYTHON_SIMULATION_H_
