// Structures whose equations are hard to solve to round-off: parts of very
// different stiffness or mass, joints that are not quite closed. Found by
// random search; each lost a law, or a step, before.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/support/test_run.h"

namespace emmy {
namespace {

RigidBodyDescription Box(size_t index, const Vector3d& size, double density) {
  return {.name = "b" + std::to_string(index),
          .inertia = BoxInertia{size, density}};
}

// Shares the point of body i at `first` with that of body j at `second`.
void Share(size_t i, const Vector3d& first, size_t j, const Vector3d& second,
           ModelDescription* model) {
  model->shared_points.push_back({BodyPoint{"b" + std::to_string(i), first},
                                  BodyPoint{"b" + std::to_string(j), second}});
}

// Four boxes in a ring of hinges, two of them a million times stiffer, turning
// as one. Rounding lets the kept tangent's corrections wander at a hundred
// times their floor, and the laws with them: they held at different iterates,
// none at the one that was accepted (angular momentum 1.7e-13 to 4.8e-13).
class RingTest : public ::testing::TestWithParam<double> {};

TEST_P(RingTest, KeepsAllLawsAtOnce) {
  const std::array<Vector3d, 4> sizes = {
      Vector3d(0.9, 0.4, 0.9), Vector3d(0.4, 0.9, 0.5), Vector3d(0.4, 0.6, 0.5),
      Vector3d(0.8, 0.8, 0.8)};
  const std::array<double, 4> penalties = {1.2e7, 1.8e7, 5.3e13, 5.8e14};
  const std::array<Vector3d, 4> centres = {
      Vector3d(0.0, 0.0, 0.0), Vector3d(1.0, 0.0, 0.0), Vector3d(1.0, 1.0, 0.0),
      Vector3d(0.0, 1.0, 0.0)};
  const Vector3d omega(-1.3, -15.7, -2.1);
  ModelDescription model;
  for (size_t i = 0; i < 4; ++i) {
    RigidBodyDescription body = Box(i, sizes[i], 100.0);
    body.penalty = penalties[i];
    body.position = centres[i];
    body.velocity = omega.cross(centres[i]);
    body.angular_velocity = omega;
    model.rigid_bodies.push_back(body);
    const size_t next = (i + 1) % 4;
    const Vector3d way = 0.5 * (centres[next] - centres[i]);
    for (const double z : {-0.2, 0.2}) {
      const Vector3d height(0.0, 0.0, z);
      Share(i, height + way, next, height - way, &model);
    }
  }
  TestRun run(model, GetParam());
  const InvariantMonitor monitor = run.Watch(200);
  EXPECT_EQ(run.state().step, 200);
  EXPECT_LE(monitor.energy().max_relative_error(), 5e-14);
  EXPECT_LE(monitor.momentum().max_relative_error(), 5e-14);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), 5e-14);
}

INSTANTIATE_TEST_SUITE_P(TimeSteps, RingTest, ::testing::Values(0.0145, 0.0175),
                         [](const auto& time_step) {
                           return time_step.param < 0.015 ? "Short" : "Long";
                         });

// Six boxes in a chain, soft and stiff by turns: a step gains no more than a
// factor of 0.6 an iteration, was begun again after sixty, and lost.
TEST(SlowChainTest, GoesOnFromWhereTheKeptTangentLeads) {
  struct Part {
    Vector3d size;
    double density;
    double penalty;
    Vector3d omega;
    Vector3d hinge;  // To the part before, from the middle of both.
  };
  const std::vector<Part> parts = {
      {{0.8, 0.4, 0.7}, 17.0, 7.6e5, {0.53, 1.9, -2.5}, {0.0, 0.0, 0.0}},
      {{0.7, 0.7, 0.5}, 590.0, 1.5e6, {1.45, -3.8, 3.0}, {0.0, -0.05, -0.18}},
      {{0.6, 0.4, 0.8}, 16.0, 2.4e4, {1.45, -3.8, 3.0}, {0.0, -0.25, 0.1}},
      {{0.3, 0.8, 0.6}, 700.0, 8.7e3, {0.4, -0.74, 4.1}, {0.0, -0.2, 0.1}},
      {{0.4, 0.4, 0.5}, 61.0, 1.5e5, {1.2, 1.8, 1.5}, {0.0, 0.14, -0.3}},
      {{0.7, 0.8, 0.7}, 41.0, 7.1e7, {-1.8, 0.34, 0.96}, {0.0, 0.28, 0.07}}};
  const Vector3d half(0.5, 0.0, 0.0);
  ModelDescription model;
  for (size_t i = 0; i < parts.size(); ++i) {
    RigidBodyDescription body = Box(i, parts[i].size, parts[i].density);
    body.penalty = parts[i].penalty;
    body.position = 2.0 * static_cast<double>(i) * half;
    body.angular_velocity = parts[i].omega;
    if (i > 0) {
      const Vector3d& hinge = parts[i].hinge;
      body.velocity = model.rigid_bodies.back().velocity +
                      parts[i - 1].omega.cross(hinge + half) -
                      parts[i].omega.cross(hinge - half);
      Share(i - 1, hinge + half, i, hinge - half, &model);
    }
    model.rigid_bodies.push_back(body);
  }
  TestRun run(model, 0.05);
  const InvariantMonitor monitor = run.Watch(150);
  EXPECT_EQ(run.state().step, 150);
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-14);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-14);
}

// A box of 15 g hung between some of up to 2400 t: its velocity is rounded by
// their impulses. The floor of the velocities knew nothing of them, and the
// first step from rest was said not to converge.
TEST(MassRatioTest, ALightBodyBetweenHeavyOnesIsNotAskedForMoreThanRounding) {
  const std::array<double, 4> densities = {1e6, 1e7, 0.06, 4e4};
  ModelDescription model;
  model.gravity = {1.0, 1.7, 0.2};
  for (size_t i = 0; i < densities.size(); ++i) {
    const double x = static_cast<double>(i);
    RigidBodyDescription body = Box(i, {0.8, 0.6, 0.5}, densities[i]);
    body.formulation = Formulation::kConventional;
    body.position = {x, 0.0, 0.0};
    model.rigid_bodies.push_back(body);
    if (i == 0) continue;
    const double side = -0.1 * (x - 1.0);
    Share(i - 1, {0.5, side, side}, i, {-0.5, side, side}, &model);
  }
  model.shared_points.push_back(
      {BodyPoint{"b0", Vector3d::Zero()}, GroundPoint{Vector3d::Zero()}});
  for (const double time_step : {0.006, 1e-5}) {
    TestRun run(model, time_step);
    const InvariantMonitor monitor = run.Watch(200);
    EXPECT_EQ(run.state().step, 200);
    EXPECT_LE(monitor.energy().max_relative_error(), 1e-14);
  }
}

// From the relaxed start a shared point is as far from itself as the bodies are
// strained, and as 1e-9 of the model allows. The joint's force through such a
// gap is a moment: 2e-13 of the angular momentum a step.
TEST(GapTest, AJointOfRelaxedBodiesExertsNoMoment) {
  ModelDescription model;
  const Vector3d omega(0.3, -0.4, 0.9);
  for (size_t i = 0; i < 2; ++i) {
    RigidBodyDescription body = Box(i, {1.0, 0.5, 0.4}, 1000.0);
    body.penalty = i == 0 ? 2e11 : 1e11;
    body.start = Start::kRelaxed;
    body.position = {static_cast<double>(i), 0.0, 0.0};
    body.velocity = omega.cross(body.position);
    body.angular_velocity = omega;
    model.rigid_bodies.push_back(body);
  }
  Share(0, {0.5, 0.1, 0.0}, 1, {-0.5, 0.1, 0.0}, &model);
  TestRun run(model, 1e-3);
  const InvariantMonitor monitor = run.Watch(2000);
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-15);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-15);
}

}  // namespace
}  // namespace emmy
