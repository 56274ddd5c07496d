#include <iostream>

#include "emmy/emmy.h"

// Runs ten steps of a case: reading, building, stepping and measuring all come
// from the library.
int main(int argc, char** argv) {
  std::cout << "emmy " << emmy::GetBuildInfo().version << "\n";
  if (argc != 2) return 2;
  auto loaded = emmy::LoadCaseFile(argv[1]);
  if (!loaded.ok()) return 1;
  auto integrator = emmy::EnergyMomentumIntegrator::Create(
      loaded->model, {.time_step = loaded->description.integrator.time_step});
  if (!integrator.ok()) return 1;
  emmy::InvariantMonitor monitor(loaded->model, loaded->state);
  const auto report =
      emmy::Simulate(*integrator, loaded->state, 10,
                     [&](const emmy::State& state, const emmy::StepReport&) {
                       monitor.Observe(state);
                       return true;
                     });
  return report.ok() && monitor.energy().max_relative_error() < 1e-14 ? 0 : 1;
}
