// Conventional bodies with springs, trusses and loads: when a step has
// converged, and what many of them cost.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "emmy/model/model_description.h"
#include "tests/support/paper_box.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;

// A box that does not turn, pulled by a spring along a line that lies along no
// axis.
ModelDescription BoxOnASpring(const Vector3d& velocity) {
  RigidBodyDescription box = PaperBox(Formulation::kConventional);
  // A mass whose products with neighbouring doubles leave gaps between them:
  // the residual has no exact zero.
  box.inertia = BoxInertia{.size = {3.0, 2.0, 1.0}, .density = 1930.0};
  box.angular_velocity.setZero();
  box.velocity = velocity;
  ModelDescription model = ModelOf(box);
  model.springs.push_back({"spring",
                           {BodyPoint{"box", {0.0, 0.0, 0.0}},
                            GroundPoint{Vector3d(1.1, 0.7, -0.3)}},
                           2e4,
                           0.5});
  return model;
}

// Where the velocity turns back in mid-step, the mean velocity vanishes, and
// with it what a floor of its rounding alone would be.
TEST(ConventionalStructureTest, AStepInWhichTheMotionTurnsBackConverges) {
  TestRun rest(BoxOnASpring(Vector3d::Zero()), kTimeStep);
  ASSERT_TRUE(rest.Advance(1));
  const Vector3d gained = rest.Motion().velocity;
  ASSERT_GT(gained.norm(), 1e-4);
  for (int k = -200; k <= 200; ++k) {
    TestRun run(BoxOnASpring((-0.5 + 1e-11 * k * k * k) * gained), kTimeStep);
    const StepReport report = run.Step();
    ASSERT_TRUE(report.ok()) << k << ": " << report.message;
    ASSERT_LE(report.iterations, 6) << k;
  }
}

// The same motion at a millionth of the size: what has converged does not
// depend on the unit of length.
TEST(ConventionalStructureTest, LawsHoldAtEverySize) {
  for (const double size : {1.0, 1e-6, 1e6}) {
    ModelDescription model = BoxWithTruss(Formulation::kConventional);
    RigidBodyDescription& box = model.rigid_bodies.front();
    box.inertia =
        BoxInertia{.size = Vector3d(3.0, 2.0, 1.0) * size, .density = 2700.0};
    model.nodes.front().position = Vector3d(1.5, 1.0, 1.3) * size;
    TrussDescription& arm = model.trusses.front();
    arm.ends[0] = BodyPoint{"box", Vector3d(1.5, 1.0, 0.5) * size};
    arm.area *= size * size;
    // Stress and inertia stay in proportion.
    arm.young_modulus *= size * size;
    TestRun run(model, kTimeStep);
    const InvariantMonitor monitor = run.Watch(1000);
    EXPECT_LE(monitor.energy().max_relative_error(), 1e-15) << size;
    EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-15) << size;
  }
}

// A torque on each of 3000 bodies, which do not touch: a dense matrix of all
// would take 2.6 GB.
TEST(ConventionalStructureTest, BodiesThatDoNotTouchAreSolvedApart) {
  ModelDescription model;
  for (int i = 0; i < 3000; ++i) {
    RigidBodyDescription box = PaperBox(Formulation::kConventional);
    box.name = "box_" + std::to_string(i);
    model.rigid_bodies.push_back(box);
    model.loads.push_back(TorqueLoad{box.name, {300.0, -200.0, 100.0}});
  }
  TestRun many(model, kTimeStep);
  model.rigid_bodies.resize(1);
  model.loads.resize(1);
  TestRun one(model, kTimeStep);
  ASSERT_TRUE(many.Advance(3));
  ASSERT_TRUE(one.Advance(3));
  // Rounding of ω in three steps.
  EXPECT_LE(
      (many.state().velocity.value.tail(6) - one.state().velocity.value.tail(6))
          .cwiseAbs()
          .maxCoeff(),
      0x1p-51);
}

}  // namespace
}  // namespace emmy
