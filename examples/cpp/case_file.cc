// A case file run by one's own program: case_file CASE.json [HISTORY.csv]

#include <cstdio>
#include <optional>

#include "emmy/emmy.h"

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  auto loaded = emmy::LoadCaseFile(argv[1]);
  if (!loaded.ok()) {
    std::fprintf(stderr, "%s\n", loaded.status().ToString().c_str());
    return 2;
  }
  const emmy::IntegratorSettings& settings = loaded->description.integrator;
  auto integrator = emmy::EnergyMomentumIntegrator::Create(
      loaded->model, emmy::OptionsOf(settings));
  if (!integrator.ok()) return 2;

  std::optional<emmy::HistoryWriter> history;
  if (argc > 2) {
    auto created = emmy::HistoryWriter::Create(argv[2], loaded->model);
    if (!created.ok()) return 1;
    history = *std::move(created);
  }
  emmy::InvariantMonitor monitor(loaded->model, loaded->state);
  bool is_written = true;
  const auto report = emmy::Simulate(
      *integrator, loaded->state, emmy::NumberOfSteps(settings),
      [&](const emmy::State& state, const emmy::StepReport& step) {
        monitor.Observe(state);
        if (history.has_value()) {
          is_written = history
                           ->Write(loaded->model, state, monitor.latest(),
                                   step.iterations)
                           .ok();
        }
        return is_written;
      });
  if (!report.ok()) {  // The state is that before the step that failed.
    std::fprintf(stderr, "%s\n", report.message.c_str());
    return 1;
  }
  std::printf("%s: %lld steps, %.1f iterations a step\n",
              loaded->description.name.c_str(),
              static_cast<long long>(report.steps), report.mean_iterations());
  return is_written ? 0 : 1;
}
