// Ten thousand free boxes, several at a time by SIMD and on two threads.

#include <cmath>
#include <cstdio>
#include <string>

#include "emmy/emmy.h"

int main() {
  emmy::ModelDescription description;
  for (int i = 0; i < 10000; ++i) {
    emmy::RigidBodyDescription box;
    box.name = "box_" + std::to_string(i);
    box.inertia = emmy::BoxInertia{.size = {3.0, 2.0, 1.0}, .density = 2700.0};
    box.penalty = 1e10;  // [Pa]
    box.position = {5.0 * (i % 100), 5.0 * (i / 100), 0.0};
    box.angular_velocity = {0.3, std::cos(i), std::sin(i)};
    description.rigid_bodies.push_back(box);
  }
  auto built = emmy::BuildModel(description);
  if (!built.ok()) {
    std::fprintf(stderr, "%s\n", built.status().ToString().c_str());
    return 1;
  }
  auto batch = emmy::BodyBatch::Create(built->model,
                                       {.time_step = 1e-3, .num_threads = 2});
  if (!batch.ok()) {
    std::fprintf(stderr, "%s\n", batch.status().ToString().c_str());
    return 1;
  }

  emmy::InvariantMonitor monitor(built->model, built->state);
  // The batch keeps a state of its own, in the order that suits it.
  batch->Load(built->state);
  for (int i = 0; i < 10; ++i) {
    const emmy::BatchReport report = batch->Step(100);
    for (const emmy::BatchFailure& failure : report.failures) {
      std::fprintf(stderr, "%s\n", failure.message.c_str());
    }
    if (!report.ok()) return 1;
    batch->Store(&built->state);
    monitor.Observe(built->state);
  }

  const bool is_kept = monitor.energy().max_relative_error() < 1e-14 &&
                       monitor.angular_momentum().max_relative_error() < 1e-14;
  std::printf("time           %.1f s\n", built->state.time.value);
  std::printf("laws to 1e-14  %s\n", is_kept ? "yes" : "no");
  return is_kept ? 0 : 1;
}
