// Every step of a run is observed: invariants, a table of one's own, an end.

#include <cstdio>
#include <vector>

#include "emmy/emmy.h"

int main() {
  // A conventional body, described by a finite rotation, spinning about its
  // middle axis and disturbed a little: it turns over again and again.
  emmy::RigidBodyDescription box;
  box.name = "box";
  box.formulation = emmy::Formulation::kConventional;
  box.inertia =
      emmy::TensorInertia{.mass = 6.0,
                          .tensor = emmy::Vector3d(2.0, 3.0, 4.0).asDiagonal(),
                          .volume = 1.0};
  box.angular_velocity = {1e-3, 5.0, 1e-3};
  emmy::ModelDescription description;
  description.rigid_bodies.push_back(box);
  auto built = emmy::BuildModel(description);
  if (!built.ok()) {
    std::fprintf(stderr, "%s\n", built.status().ToString().c_str());
    return 1;
  }
  auto integrator = emmy::EnergyMomentumIntegrator::Create(
      built->model, {.order = 4, .time_step = 0.01});
  if (!integrator.ok()) return 1;

  // Follows the largest errors over all steps, in extended precision.
  emmy::InvariantMonitor monitor(built->model, built->state);
  std::vector<double> times_of_turning;
  double before = 1.0;
  const emmy::SimulationReport report = emmy::Simulate(
      *integrator, built->state, 100000,
      [&](const emmy::State& state, const emmy::StepReport&) {
        monitor.Observe(state);
        const auto motion = emmy::ObserveBody(built->model, state, 0);
        // w² - x² + y² - z²: the second axis along or against where it was.
        const emmy::Vector4d& q = motion.quaternion;
        const double along =
            q(0) * q(0) - q(1) * q(1) + q(2) * q(2) - q(3) * q(3);
        if (along * before < 0.0) times_of_turning.push_back(state.time.value);
        before = along;
        return times_of_turning.size() < 3;  // False ends the run.
      });
  if (!report.ok()) {
    std::fprintf(stderr, "%s\n", report.message.c_str());
    return 1;
  }

  for (const double time : times_of_turning) {
    std::printf("turned over at  %.1f s\n", time);
  }
  const bool is_kept = monitor.energy().max_relative_error() < 1e-14 &&
                       monitor.angular_momentum().max_relative_error() < 1e-14;
  std::printf("laws to 1e-14   %s\n", is_kept ? "yes" : "no");
  return is_kept && report.stopped_by_observer ? 0 : 1;
}
