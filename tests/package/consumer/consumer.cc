#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "emmy/emmy.h"

namespace {

// Goes on to this step; whether all could be computed.
bool RunTo(int64_t step, emmy::EnergyMomentumIntegrator& integrator,
           emmy::State& state, emmy::InvariantMonitor& monitor) {
  return emmy::Simulate(integrator, state, step - state.step,
                        [&](const emmy::State& now, const emmy::StepReport&) {
                          monitor.Observe(now);
                          return true;
                        })
      .ok();
}

// What the bytes of a checkpoint say, if it is one of this case.
std::optional<emmy::Checkpoint> Read(const std::string& bytes,
                                     const emmy::LoadedCase& loaded) {
  auto checkpoint = emmy::DecodeCheckpoint(bytes);
  if (!checkpoint.ok() ||
      !emmy::CheckSameCase(*checkpoint, loaded.description, loaded.state)
           .ok()) {
    return std::nullopt;
  }
  return *std::move(checkpoint);
}

// Whether a body that turns with ω is said to, by both polar angular
// velocities.
bool TurnsAsGiven() {
  const emmy::Vector3d omega(0.3, -0.2, 0.1);
  emmy::Matrix3d rates;
  rates << 0, -0.1, -0.2, 0.1, 0, -0.3, 0.2, 0.3, 0;
  const auto polar = emmy::DecomposePolar(emmy::Matrix3d::Identity());
  return polar.ok &&
         (emmy::PolarAngularVelocity(polar, rates) - omega).norm() < 1e-15 &&
         (emmy::ExactPolarAngularVelocity(polar, rates) - omega).norm() < 1e-15;
}

}  // namespace

// Runs ten steps of a case, and five of them again from a checkpoint: reading,
// building, stepping and measuring all come from the library.
int main(int argc, char** argv) {
  std::cout << "emmy " << emmy::GetBuildInfo().version << "\n";
  if (argc != 2 || !TurnsAsGiven()) return 2;
  auto loaded = emmy::LoadCaseFile(argv[1]);
  if (!loaded.ok()) return 1;
  const emmy::IntegratorOptions options = {
      .time_step = loaded->description.integrator.time_step};
  auto integrator =
      emmy::EnergyMomentumIntegrator::Create(loaded->model, options);
  if (!integrator.ok()) return 1;
  emmy::InvariantMonitor monitor(loaded->model, loaded->state);
  emmy::State state = loaded->state;
  if (!RunTo(5, *integrator, state, monitor)) return 1;

  emmy::Checkpoint checkpoint;
  checkpoint.case_name = loaded->description.name;
  checkpoint.case_checksum = emmy::CaseChecksum(loaded->description);
  checkpoint.build = emmy::CheckpointBuild();
  checkpoint.state = state;
  checkpoint.kept = integrator->Keep();
  checkpoint.extremes = monitor.extremes();
  const auto bytes = emmy::EncodeCheckpoint(checkpoint);
  if (!bytes.ok() || !RunTo(10, *integrator, state, monitor)) return 1;

  auto back = Read(*bytes, *loaded);
  auto other = emmy::EnergyMomentumIntegrator::Create(loaded->model, options);
  if (!back || !other.ok() || !other->Restore(back->kept).ok()) return 1;
  emmy::InvariantMonitor resumed(loaded->model, loaded->state);
  resumed.Resume(back->state, back->extremes);
  if (!RunTo(10, *other, back->state, resumed)) return 1;

  const bool same = back->state.position.value == state.position.value &&
                    back->state.velocity.value == state.velocity.value &&
                    resumed.energy().max_error == monitor.energy().max_error;
  return same && monitor.energy().max_relative_error() < 1e-14 ? 0 : 1;
}
