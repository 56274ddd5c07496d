// A model in code, stepped one by one: a box that turns about no axis for long.

#include <cmath>
#include <cstdio>

#include "emmy/emmy.h"

int main() {
  emmy::RigidBodyDescription box;
  box.name = "box";
  box.inertia = emmy::BoxInertia{.size = {3.0, 2.0, 1.0}, .density = 2700.0};
  box.penalty = 1e10;  // [Pa]
  box.angular_velocity = {0.3, 0.5, 0.8};
  emmy::ModelDescription description;
  description.rigid_bodies.push_back(box);

  const auto built = emmy::BuildModel(description);
  if (!built.ok()) {
    std::fprintf(stderr, "%s\n", built.status().ToString().c_str());
    return 1;
  }
  // The model is constant, the state changes. The integrator refers to the
  // model, which therefore has to stay where it is.
  const emmy::Model& model = built->model;
  emmy::State state = built->state;
  auto integrator = emmy::EnergyMomentumIntegrator::Create(
      model, {.order = 2, .time_step = 1e-3});
  if (!integrator.ok()) return 1;

  const double start =
      emmy::MeasureInvariants(model, state).TotalEnergy().ToDouble();
  for (int i = 0; i < 10000; ++i) {
    const emmy::StepReport report = integrator->Step(state);
    if (!report.ok()) {  // The state is as before the step.
      std::fprintf(stderr, "%s\n", report.message.c_str());
      return 1;
    }
  }

  // References into the state, not copies: valid as long as it is.
  const emmy::ModelBody& body = model.bodies()[0];
  const auto coordinates =
      state.position.value.segment<12>(body.position_offset);
  const auto centre = coordinates.head<3>();
  const auto first_axis = coordinates.segment<3>(3);
  const emmy::BodyMotion motion = emmy::ObserveBody(model, state, 0);
  const double energy =
      emmy::MeasureInvariants(model, state).TotalEnergy().ToDouble();

  std::printf("time            %.3f s\n", state.time.value);
  std::printf("centre          at %.3f m\n", centre.norm());
  std::printf("first axis      %.3f long\n", first_axis.norm());
  std::printf("omega_z         %.3f rad/s\n", motion.omega_locked.z());
  std::printf("energy          %.2f J\n", energy);
  const bool is_kept = std::abs(energy - start) <= 1e-14 * start;
  std::printf("kept to 1e-14   %s\n", is_kept ? "yes" : "no");
  return is_kept ? 0 : 1;
}
