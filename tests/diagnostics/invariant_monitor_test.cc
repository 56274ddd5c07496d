#include "emmy/diagnostics/invariant_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"

namespace emmy {
namespace {

// A body that only moves along x: energy ½ M v², momentum M v, so that every
// record is known by hand.
class InvariantMonitorTest : public ::testing::Test {
 protected:
  InvariantMonitorTest() {
    RigidBodyDescription body = PaperBox();
    body.angular_velocity.setZero();
    body.velocity = {1.0, 0.0, 0.0};
    body.position = {0.0, 2.0, 0.0};
    built_ = *BuildModel(ModelOf(body));
  }

  State WithVelocity(double v) const {
    State state = built_.state;
    state.velocity.value(0) = v;
    return state;
  }

  BuiltModel built_;
};

TEST_F(InvariantMonitorTest, StartsWithoutError) {
  const InvariantMonitor monitor(built_.model, built_.state);
  EXPECT_EQ(monitor.energy().initial, 8100.0);
  EXPECT_EQ(monitor.energy().final, 8100.0);
  EXPECT_EQ(monitor.energy().scale, 8100.0);
  EXPECT_EQ(monitor.energy().max_error, 0.0);
  EXPECT_EQ(monitor.energy().max_relative_error(), 0.0);
  EXPECT_EQ(monitor.momentum().initial, Vector3d(16200.0, 0.0, 0.0));
  EXPECT_EQ(monitor.angular_momentum().initial, Vector3d(0.0, 0.0, -32400.0));
}

TEST_F(InvariantMonitorTest, AStateThatIsNotFiniteIsNotForgotten) {
  InvariantMonitor monitor(built_.model, built_.state);
  monitor.Observe(WithVelocity(std::numeric_limits<double>::quiet_NaN()));
  monitor.Observe(WithVelocity(1.0));
  EXPECT_TRUE(std::isnan(monitor.energy().max_relative_error()));
  EXPECT_TRUE(std::isnan(monitor.momentum().max_relative_error()));
  EXPECT_TRUE(std::isnan(monitor.angular_momentum().max_relative_error()));
}

// Their squares are not doubles.
TEST_F(InvariantMonitorTest, MeasuresMomentaOfAnySize) {
  for (const double mass : {1e200, 1e-85}) {
    RigidBodyDescription body = PaperBox();
    body.angular_velocity.setZero();
    const double speed = mass < 1.0 ? 1e-85 : 1.0;
    body.velocity = {3.0 * speed, 4.0 * speed, 0.0};
    body.inertia = TensorInertia{
        .mass = mass, .tensor = mass * Matrix3d::Identity(), .volume = 1.0};
    BuiltModel built = BuildModel(ModelOf(body)).value();
    InvariantMonitor monitor(built.model, built.state);
    EXPECT_NEAR(monitor.momentum().scale / (5.0 * mass * speed), 1.0, 1e-15);
    built.state.velocity.value(0) *= 2.0;
    monitor.Observe(built.state);
    EXPECT_NEAR(monitor.momentum().max_relative_error(), 3.0 / std::sqrt(52.0),
                1e-15);
  }
}

TEST_F(InvariantMonitorTest, AStateOfAnotherModelStopsTheProgram) {
  InvariantMonitor monitor(built_.model, built_.state);
  EXPECT_DEATH(monitor.Observe(State{}),
               "a state of 0 positions, 0 velocities.* for a model of 12");
}

TEST_F(InvariantMonitorTest, GoesOnAsIfItHadNeverStopped) {
  InvariantMonitor whole(built_.model, built_.state);
  whole.Observe(WithVelocity(3.0));
  whole.Observe(WithVelocity(2.0));
  const InvariantExtremes extremes = whole.extremes();
  InvariantMonitor resumed(built_.model, built_.state);
  resumed.Resume(WithVelocity(2.0), extremes);
  for (InvariantMonitor* monitor : {&whole, &resumed}) {
    monitor->Observe(WithVelocity(1.5));
  }
  // Of v = 3 m/s, which it has not seen: ½ M (9 − 1) and M (3 − 1).
  EXPECT_EQ(resumed.energy().max_error, 64800.0);
  EXPECT_EQ(resumed.momentum().max_error, 32400.0);
  EXPECT_EQ(resumed.energy().final, whole.energy().final);
  EXPECT_EQ(resumed.extremes().max_error, whole.extremes().max_error);
  EXPECT_EQ(resumed.extremes().scale, whole.extremes().scale);
}

TEST_F(InvariantMonitorTest, KeepsTheLargestErrorAndTheLatestValue) {
  InvariantMonitor monitor(built_.model, built_.state);
  monitor.Observe(WithVelocity(3.0));
  monitor.Observe(WithVelocity(2.0));
  EXPECT_EQ(monitor.energy().max_error, 8.0 * 8100.0);
  EXPECT_EQ(monitor.energy().final, 4.0 * 8100.0);
  EXPECT_EQ(monitor.energy().scale, 9.0 * 8100.0);
  EXPECT_EQ(monitor.energy().max_relative_error(), 8.0 / 9.0);
  EXPECT_EQ(monitor.momentum().max_error, 2.0 * 16200.0);
  EXPECT_EQ(monitor.momentum().final, Vector3d(32400.0, 0.0, 0.0));
  EXPECT_EQ(monitor.momentum().scale, 3.0 * 16200.0);
  EXPECT_EQ(monitor.angular_momentum().max_error, 2.0 * 32400.0);
  EXPECT_EQ(monitor.latest().kinetic_energy.ToDouble(), 4.0 * 8100.0);
}

TEST_F(InvariantMonitorTest, AnErrorOfEitherSignCounts) {
  InvariantMonitor monitor(built_.model, built_.state);
  monitor.Observe(WithVelocity(-0.5));
  EXPECT_EQ(monitor.energy().max_error, 0.75 * 8100.0);
  EXPECT_EQ(monitor.momentum().max_error, 1.5 * 16200.0);
}

// Differences are taken before rounding: an error of 1e-20 is seen.
TEST_F(InvariantMonitorTest, SeesErrorsFarBelowTheRoundingOfTheEnergy) {
  InvariantMonitor monitor(built_.model, built_.state);
  State state = built_.state;
  state.velocity.compensation(0) = 1e-20;
  monitor.Observe(state);
  EXPECT_NEAR(monitor.energy().max_error, 16200.0 * 1e-20, 1e-26);
  EXPECT_NEAR(monitor.momentum().max_error, 16200.0 * 1e-20, 1e-26);
}

TEST_F(InvariantMonitorTest, ABodyAtRestHasNoErrorInsteadOfNotANumber) {
  const State rest = WithVelocity(0.0);
  InvariantMonitor monitor(built_.model, rest);
  monitor.Observe(rest);
  EXPECT_EQ(monitor.energy().max_relative_error(), 0.0);
  EXPECT_EQ(monitor.momentum().max_relative_error(), 0.0);
}

TEST_F(InvariantMonitorTest, WithoutGravityAllIsConserved) {
  const ConservedQuantities conserved = QuantitiesConservedBy(built_.model);
  EXPECT_TRUE(conserved.energy);
  EXPECT_TRUE(conserved.momentum);
  EXPECT_TRUE(conserved.angular_momentum);
}

TEST_F(InvariantMonitorTest, GravityLeavesOnlyTheEnergy) {
  ModelDescription description = ModelOf(PaperBox());
  description.gravity = {0.0, 0.0, -9.81};
  const BuiltModel built = *BuildModel(description);
  const InvariantMonitor monitor(built.model, built.state);
  EXPECT_TRUE(monitor.energy().conserved);
  EXPECT_FALSE(monitor.momentum().conserved);
  EXPECT_FALSE(monitor.angular_momentum().conserved);
}

}  // namespace
}  // namespace emmy
