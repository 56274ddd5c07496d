#include "python/simulation.h"

#include <chrono>
#include <exception>
#include <utility>

#include "absl/status/statusor.h"
#include "emmy/diagnostics/watched_run.h"
#include "emmy/integrate/simulate.h"
#include "emmy/io/history.h"
#include "python/lock.h"

namespace emmy::python {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void ThrowInputError(const absl::Status& status) {
  throw InputError(std::string(status.message()));
}

// Python's part in a run that does not hold its lock.
class Listener {
 public:
  Listener(const pybind11::object& progress, int64_t num_steps)
      : progress_(progress), num_steps_(num_steps) {}

  // False if the run should end, because `progress` says so or because an
  // exception waits in error().
  bool Listen(int64_t steps_done, Unlocked& unlocked) {
    const bool is_last = steps_done == num_steps_;
    const Clock::time_point now = Clock::now();
    if (now < next_ && !is_last) return true;
    next_ = now + std::chrono::milliseconds(100);
    const Locked lock(unlocked);
    const int answer = CallPython([&] { return Ask(steps_done); });
    // Not through the time loop: it ends by itself, between two steps.
    if (answer < 0) {
      error_ = std::make_exception_ptr(pybind11::error_already_set());
    }
    return answer > 0;
  }

  const std::exception_ptr& error() const { return error_; }

 private:
  // 1 to go on, 0 to end, -1 with Python's error set. Only for CallPython.
  int Ask(int64_t steps_done) const {
    if (PyErr_CheckSignals() != 0) return -1;
    if (progress_.is_none()) return 1;
    PyObject* const answer = PyObject_CallFunction(
        progress_.ptr(), "NN", PyLong_FromLongLong(steps_done),
        PyLong_FromLongLong(num_steps_));
    if (answer == nullptr) return -1;
    const int goes_on = answer == Py_None ? 1 : PyObject_IsTrue(answer);
    Py_DECREF(answer);
    return goes_on;
  }

  const pybind11::object& progress_;
  int64_t num_steps_;
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(100);
  std::exception_ptr error_;
};

}  // namespace

Simulation::Simulation(std::string prefix, std::unique_ptr<LoadedCase> loaded,
                       EnergyMomentumIntegrator integrator)
    : prefix_(std::move(prefix)),
      loaded_(std::move(loaded)),
      integrator_(std::move(integrator)),
      monitor_(loaded_->model, loaded_->state) {}

std::unique_ptr<Simulation> Simulation::Create(
    const std::string& prefix, std::unique_ptr<LoadedCase> loaded,
    const std::optional<std::string>& path,
    const std::vector<std::string>& overrides, int threads) {
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(
          loaded->model, OptionsOf(loaded->description.integrator, threads));
  if (!integrator.ok()) {
    ThrowInputError(path.has_value()
                        ? CaseFileError(*path, overrides, integrator.status())
                        : integrator.status());
  }
  return std::unique_ptr<Simulation>(
      new Simulation(prefix, std::move(loaded), *std::move(integrator)));
}

std::unique_ptr<Simulation> Simulation::FromFile(
    const std::string& path, const std::vector<std::string>& overrides,
    int threads) {
  const Unlocked unlocked;
  absl::StatusOr<LoadedCase> loaded = LoadCaseFile(path, overrides);
  if (!loaded.ok()) ThrowInputError(loaded.status());
  return Create(path + ": ", std::make_unique<LoadedCase>(*std::move(loaded)),
                path, overrides, threads);
}

std::unique_ptr<Simulation> Simulation::FromText(
    const std::string& text, const std::vector<std::string>& overrides,
    int threads) {
  const Unlocked unlocked;
  absl::StatusOr<Case> description = ParseCase(text, overrides);
  if (!description.ok()) ThrowInputError(description.status());
  absl::StatusOr<LoadedCase> loaded = BuildCase(*std::move(description));
  if (!loaded.ok()) ThrowInputError(loaded.status());
  return Create("", std::make_unique<LoadedCase>(*std::move(loaded)),
                std::nullopt, overrides, threads);
}

void Simulation::Run(const RunOptions& options) {
  if (running_) {
    throw std::runtime_error("this simulation is already running");
  }
  struct Running {
    bool& flag;
    explicit Running(bool& f) : flag(f) { flag = true; }
    ~Running() { flag = false; }
  } const running(running_);

  State& state = loaded_->state;
  const int64_t first = state.step;
  const bool records = options.record_every > 0;
  // Until the end of the run it belongs to nobody else: it still moves.
  const auto history = std::make_shared<History>(
      records ? HistoryColumns(model()) : std::vector<std::string>());
  int64_t last_row = -1;
  const auto record = [&]() {
    if (!records || last_row == state.step) return;
    last_row = state.step;
    history->Append(HistoryRow(model(), state, monitor_.latest(), iterations_));
  };

  Listener listener(options.progress, options.num_steps);
  SimulationReport report;
  std::exception_ptr error;
  try {
    Unlocked unlocked;
    record();
    report =
        WatchedRun(integrator_, model(), state, options.num_steps, monitor_,
                   [&](const State& reached, const StepReport& step) {
                     iterations_ = step.iterations;
                     if (records && reached.step % options.record_every == 0) {
                       record();
                     }
                     return listener.Listen(reached.step - first, unlocked);
                   });
    record();  // The last step reached.
  } catch (...) {
    error = std::current_exception();  // Of memory that ran out.
  }
  if (records) history_ = history;
  if (listener.error() != nullptr) std::rethrow_exception(listener.error());
  if (error != nullptr) std::rethrow_exception(error);
  if (!report.ok()) throw StepError(prefix_ + report.message);
}

}  // namespace emmy::python
