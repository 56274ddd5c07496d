#include "emmy/diagnostics/body_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {
namespace {

class BodyMotionTest : public ::testing::TestWithParam<Formulation> {};

TEST_P(BodyMotionTest, GivesBackTheStart) {
  RandomSource random(20250521);
  for (int trial = 0; trial < 50; ++trial) {
    RigidBodyDescription body = PaperBox(GetParam());
    const Vector4d q = random.UnitQuaternion();
    body.orientation = Quaternion{q(0), q(1), q(2), q(3)};
    body.position = random.Vector(10.0);
    body.velocity = random.Vector(10.0);
    body.angular_velocity = random.Vector(3.0);
    const BuiltModel built = *BuildModel(ModelOf(body));
    const BodyMotion motion = ObserveBody(built.model, built.state, 0);
    EXPECT_EQ(motion.position, body.position);
    EXPECT_EQ(motion.velocity, body.velocity);
    EXPECT_GE(motion.quaternion(0), 0.0);
    // A quaternion and its negative are the same attitude.
    const Vector4d expected = q(0) < 0.0 ? Vector4d(-q) : q;
    EXPECT_LE((motion.quaternion - expected).norm(), RoundoffBound(60, 1.0));
    const double bound = RoundoffBound(300, body.angular_velocity.norm());
    EXPECT_LE((motion.omega_locked - body.angular_velocity).norm(), bound);
    EXPECT_LE((motion.omega_polar - body.angular_velocity).norm(), bound);
    EXPECT_LE((motion.omega_polar_exact - body.angular_velocity).norm(), bound);
  }
}

INSTANTIATE_TEST_SUITE_P(Formulations, BodyMotionTest,
                         ::testing::Values(Formulation::kAncf,
                                           Formulation::kConventional),
                         [](const auto& formulation) {
                           return formulation.param == Formulation::kAncf
                                      ? "Ancf"
                                      : "Conventional";
                         });

TEST(BodyMotionInsideOutTest, HasNoAttitudeButStillALockedOmega) {
  BuiltModel built = *BuildModel(ModelOf(PaperBox()));
  built.state.position.value.segment<3>(3) *= -1.0;
  const BodyMotion motion = ObserveBody(built.model, built.state, 0);
  EXPECT_TRUE(std::isnan(motion.quaternion(0)));
  EXPECT_TRUE(std::isnan(motion.quaternion(3)));
  EXPECT_TRUE(std::isnan(motion.omega_polar(1)));
  EXPECT_TRUE(std::isnan(motion.omega_polar_exact(2)));
  EXPECT_TRUE(motion.omega_locked.allFinite());
}

TEST(BodyMotionDeathTest, StopsAtABodyThatIsNotThere) {
  const BuiltModel built = *BuildModel(ModelOf(PaperBox()));
  EXPECT_DEATH(static_cast<void>(ObserveBody(built.model, built.state, 1)),
               "body 1 of 1");
}

}  // namespace
}  // namespace emmy
