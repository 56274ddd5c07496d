// Parts joined in code, and what a mistake looks like.

#include <cstdio>

#include "emmy/emmy.h"

namespace {

// A box on a spherical joint, with a cable from its far end to a free weight.
emmy::ModelDescription Pendulum(double weight) {
  emmy::RigidBodyDescription rod;
  rod.name = "rod";
  rod.inertia = emmy::BoxInertia{.size = {1.0, 0.1, 0.1}, .density = 1000.0};
  rod.penalty = 1e8;  // [Pa]
  rod.position = {0.5, 0.0, 0.0};

  emmy::NodeDescription end;
  end.name = "end";
  end.mass = weight;  // [kg]
  end.position = {1.0, 0.0, -0.5};

  emmy::TrussDescription cable;
  cable.name = "cable";
  cable.ends = {emmy::BodyPoint{"rod", {0.5, 0.0, 0.0}},
                emmy::NodePoint{"end"}};
  cable.area = 1e-5;          // [m²]
  cable.young_modulus = 1e9;  // [Pa]
  cable.tension_only = true;

  emmy::ModelDescription description;
  description.gravity = {0.0, 0.0, -9.81};
  description.rigid_bodies.push_back(rod);
  description.nodes.push_back(end);
  description.trusses.push_back(cable);
  description.shared_points.push_back(
      {emmy::BodyPoint{"rod", {-0.5, 0.0, 0.0}}, emmy::GroundPoint{}});
  return description;
}

}  // namespace

int main() {
  // Bad input is a status that names the place as a case file would.
  const auto wrong = emmy::BuildModel(Pendulum(-1.0));
  std::printf("%s\n", wrong.status().ToString().c_str());

  auto built = emmy::BuildModel(Pendulum(5.0));
  if (!built.ok()) return 1;
  auto integrator =
      emmy::EnergyMomentumIntegrator::Create(built->model, {.time_step = 1e-3});
  if (!integrator.ok()) return 1;
  emmy::InvariantMonitor monitor(built->model, built->state);
  double largest_force = 0.0;
  const auto report = emmy::Simulate(
      *integrator, built->state, 2000,
      [&](const emmy::State& state, const emmy::StepReport&) {
        monitor.Observe(state);
        const double force = emmy::ObserveLine(built->model, state, 0).force;
        if (force > largest_force) largest_force = force;
        return true;
      });
  if (!report.ok()) return 1;

  const auto end = emmy::ObserveNode(built->model, built->state, 0);
  std::printf("weight at       (%.2f, %.2f, %.2f) m\n", end.position.x(),
              end.position.y(), end.position.z());
  std::printf("largest force   %.0f N\n", largest_force);
  // Gravity and the ground take momentum; energy is kept.
  const auto conserved = emmy::QuantitiesConservedBy(built->model);
  std::printf("momentum kept   %s\n", conserved.momentum ? "yes" : "no");
  const bool is_kept =
      monitor.energy().max_error < 1e-12 * monitor.energy().scale;
  std::printf("energy kept     %s\n", is_kept ? "yes" : "no");
  return is_kept && !wrong.ok() ? 0 : 1;
}
