// What must not matter: where the observer stands, how he moves, how the axes
// are named, in which direction time goes, and what else is in the model.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <variant>

#include "emmy/numerics/rotation.h"
#include "tests/contract/motions.h"
#include "tests/support/random_source.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr int64_t kNumSteps = 500;

class SymmetryTest : public ::testing::TestWithParam<Motion> {
 protected:
  TestRun Run(const RigidBodyDescription& body) const {
    return {ModelOf(body), GetParam().time_step};
  }

  double Time() const {
    return static_cast<double>(kNumSteps) * GetParam().time_step;
  }
  double Speed() const { return GetParam().body.angular_velocity.norm(); }

  // How far the attitudes of two runs may part whose starts differ by a few
  // roundings: errors of ω relative to |ω| turn the body for all the time.
  double AttitudeBound() const {
    const double omega_error =
        RoundoffBound(16, 1.0) +
        RandomWalkBound(kNumSteps, GetParam().StepError());
    return 4.0 * omega_error * (1.0 + Speed() * Time());
  }

  static Vector4d QuaternionOf(const RigidBodyDescription& body) {
    if (const auto* q = std::get_if<Quaternion>(&body.orientation)) {
      return {q->w, q->x, q->y, q->z};
    }
    return RotationVectorToQuaternion(
        std::get<RotationVector>(body.orientation).vector);
  }
  static void SetQuaternion(const Vector4d& q, RigidBodyDescription* body) {
    body->orientation = Quaternion{q(0), q(1), q(2), q(3)};
  }

  // The whole start turned by the quaternion `turn`.
  static RigidBodyDescription Turned(const RigidBodyDescription& body,
                                     const Vector4d& turn) {
    const Matrix3d rotation = QuaternionToMatrix(turn);
    RigidBodyDescription turned = body;
    SetQuaternion(QuaternionProduct(turn, QuaternionOf(body)), &turned);
    turned.position = rotation * body.position;
    turned.velocity = rotation * body.velocity;
    turned.angular_velocity = rotation * body.angular_velocity;
    return turned;
  }

  void ExpectSameMotion(const BodyMotion& actual, const BodyMotion& expected,
                        const Matrix3d& turn) const {
    const Matrix3d attitude = turn * QuaternionToMatrix(expected.quaternion);
    EXPECT_LE((QuaternionToMatrix(actual.quaternion) - attitude)
                  .cwiseAbs()
                  .maxCoeff(),
              AttitudeBound());
    EXPECT_LE((actual.omega_locked - turn * expected.omega_locked).norm(),
              AttitudeBound() * Speed());
    EXPECT_LE((actual.position - turn * expected.position).norm(),
              RoundoffBound(32, GetParam().body.position.norm() +
                                    GetParam().body.velocity.norm() * Time()));
  }
};

TEST_P(SymmetryTest, ARotatedStartGivesTheRotatedMotion) {
  RandomSource random(20250601);
  TestRun run = Run(GetParam().body);
  ASSERT_TRUE(run.Advance(kNumSteps));
  for (int trial = 0; trial < 5; ++trial) {
    const Vector4d turn = random.UnitQuaternion();
    TestRun turned = Run(Turned(GetParam().body, turn));
    ASSERT_TRUE(turned.Advance(kNumSteps));
    ExpectSameMotion(turned.Motion(), run.Motion(), QuaternionToMatrix(turn));
  }
}

// The check above sees a start of which ω was not turned along.
TEST_P(SymmetryTest, AStartRotatedInPartDoesNotGiveTheRotatedMotion) {
  const Vector4d turn(0.8, 0.0, 0.6, 0.0);
  RigidBodyDescription wrong = Turned(GetParam().body, turn);
  wrong.angular_velocity = GetParam().body.angular_velocity;
  TestRun run = Run(GetParam().body);
  TestRun turned = Run(wrong);
  ASSERT_TRUE(run.Advance(kNumSteps));
  ASSERT_TRUE(turned.Advance(kNumSteps));
  const Matrix3d rotation = QuaternionToMatrix(turn);
  EXPECT_GT(
      (turned.Motion().omega_locked - rotation * run.Motion().omega_locked)
          .norm(),
      1e6 * AttitudeBound() * Speed());
}

TEST_P(SymmetryTest, ABoostChangesNothingButThePosition) {
  const Vector3d boost(3.0, -5.0, 7.0);
  RigidBodyDescription moving = GetParam().body;
  moving.velocity += boost;
  TestRun run = Run(GetParam().body);
  TestRun boosted = Run(moving);
  ASSERT_TRUE(run.Advance(kNumSteps));
  ASSERT_TRUE(boosted.Advance(kNumSteps));
  EXPECT_EQ(boosted.Motion().quaternion, run.Motion().quaternion);
  EXPECT_EQ(boosted.Motion().omega_locked, run.Motion().omega_locked);
  const Vector3d path = boosted.Motion().position - run.Motion().position;
  EXPECT_LE((path - Time() * boost).norm(),
            RoundoffBound(16, GetParam().body.position.norm() +
                                  2.0 * boost.norm() * Time()));
}

// The body axes e₁, e₂, e₃ renamed e₂, e₃, e₁: the same body.
TEST_P(SymmetryTest, RenamedBodyAxesGiveTheSameMotion) {
  const Vector4d renaming(0.5, 0.5, 0.5, 0.5);
  const Matrix3d p = QuaternionToMatrix(renaming);
  RigidBodyDescription renamed = GetParam().body;
  SetQuaternion(QuaternionProduct(QuaternionOf(renamed), renaming), &renamed);
  if (auto* box = std::get_if<BoxInertia>(&renamed.inertia)) {
    box->size = (p.transpose() * box->size).eval();
  } else {
    auto& tensor = std::get<TensorInertia>(renamed.inertia).tensor;
    tensor = (p.transpose() * tensor * p).eval();
  }
  TestRun run = Run(GetParam().body);
  TestRun other = Run(renamed);
  ASSERT_TRUE(run.Advance(kNumSteps));
  ASSERT_TRUE(other.Advance(kNumSteps));
  BodyMotion motion = other.Motion();
  motion.quaternion =
      QuaternionProduct(motion.quaternion, Vector4d(0.5, -0.5, -0.5, -0.5));
  ExpectSameMotion(motion, run.Motion(), Matrix3d::Identity());
}

// Back with a negative step: the scheme is symmetric, so that only rounding
// keeps the body from its start.
TEST_P(SymmetryTest, TimeTurnedBackLeadsToTheStart) {
  TestRun run = Run(GetParam().body);
  const BodyMotion start = run.Motion();
  ASSERT_TRUE(run.Advance(kNumSteps));
  run.SetOptions({.time_step = -GetParam().time_step});
  ASSERT_TRUE(run.Advance(kNumSteps));
  ExpectSameMotion(run.Motion(), start, Matrix3d::Identity());
  EXPECT_EQ(run.state().time.value, 0.0);
}

// The same by reversed velocities, which needs no negative step.
TEST_P(SymmetryTest, ReversedVelocitiesLeadToTheStart) {
  TestRun run = Run(GetParam().body);
  const BodyMotion start = run.Motion();
  ASSERT_TRUE(run.Advance(kNumSteps));
  run.state().velocity.value *= -1.0;
  run.state().velocity.compensation *= -1.0;
  ASSERT_TRUE(run.Advance(kNumSteps));
  BodyMotion end = run.Motion();
  end.omega_locked *= -1.0;
  ExpectSameMotion(end, start, Matrix3d::Identity());
}

TEST_P(SymmetryTest, ABodyAtRestStaysInEveryBit) {
  RigidBodyDescription body = GetParam().body;
  body.velocity.setZero();
  body.angular_velocity.setZero();
  TestRun run = Run(body);
  const State start = run.state();
  ASSERT_TRUE(run.Advance(kNumSteps));
  EXPECT_TRUE(SameMotion(run.state(), start));
}

// Each body of a model moves, bit for bit, as if it were alone.
TEST_P(SymmetryTest, OtherBodiesInTheModelChangeNoBit) {
  TestRun alone = Run(GetParam().body);
  ASSERT_TRUE(alone.Advance(kNumSteps));
  RigidBodyDescription before = PaperBox(Formulation::kAncf, 1e7);
  before.name = "before";
  before.angular_velocity = {-0.3, 0.2, 1.0};
  RigidBodyDescription after = PaperBox(Formulation::kConventional);
  after.name = "after";
  for (const bool first : {true, false}) {
    ModelDescription description = ModelOf(before);
    description.rigid_bodies.push_back(after);
    const auto place = first ? description.rigid_bodies.begin()
                             : description.rigid_bodies.end();
    description.rigid_bodies.insert(place, GetParam().body);
    TestRun run(description, GetParam().time_step);
    ASSERT_TRUE(run.Advance(kNumSteps));
    const BodyMotion motion = run.Motion(first ? 0 : 2);
    EXPECT_EQ(motion.position, alone.Motion().position);
    EXPECT_EQ(motion.velocity, alone.Motion().velocity);
    EXPECT_EQ(motion.quaternion, alone.Motion().quaternion);
    EXPECT_EQ(motion.omega_locked, alone.Motion().omega_locked);
    EXPECT_EQ(motion.omega_polar, alone.Motion().omega_polar);
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, SymmetryTest, ::testing::ValuesIn(Motions()),
                         MotionName);

// Half turns about the axes change signs alone, and so no rounding.
TEST(HalfTurnTest, OfAnAncfBodyIsExactInEveryBit) {
  RigidBodyDescription body = PaperBox();
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d signs = Vector3d::Constant(-1.0);
    signs(axis) = 1.0;
    RigidBodyDescription turned = body;
    Vector4d q = Vector4d::Unit(1 + axis);
    turned.orientation = Quaternion{q(0), q(1), q(2), q(3)};
    turned.angular_velocity = signs.cwiseProduct(body.angular_velocity);
    TestRun run(ModelOf(body), 0.1);
    TestRun other(ModelOf(turned), 0.1);
    ASSERT_TRUE(run.Advance(kNumSteps));
    ASSERT_TRUE(other.Advance(kNumSteps));
    for (Eigen::Index i = 3; i < 12; ++i) {
      EXPECT_EQ(other.state().position.value(i),
                signs(i % 3) * run.state().position.value(i));
      EXPECT_EQ(other.state().velocity.compensation(i),
                signs(i % 3) * run.state().velocity.compensation(i));
    }
    EXPECT_EQ(other.state().strain.value, run.state().strain.value);
  }
}

// In body axes a free conventional body does not know its attitude.
TEST(AnyTurnTest, LeavesTheBodyVelocitiesOfAConventionalBodyInEveryBit) {
  RigidBodyDescription body = PaperBox(Formulation::kConventional);
  body.angular_velocity_in_body_axes = true;
  TestRun run(ModelOf(body), 0.1);
  ASSERT_TRUE(run.Advance(kNumSteps));
  RandomSource random(20250602);
  for (int trial = 0; trial < 5; ++trial) {
    const Vector4d q = random.UnitQuaternion();
    body.orientation = Quaternion{q(0), q(1), q(2), q(3)};
    TestRun turned(ModelOf(body), 0.1);
    ASSERT_TRUE(turned.Advance(kNumSteps));
    EXPECT_EQ(turned.state().velocity.value, run.state().velocity.value);
    EXPECT_EQ(turned.state().velocity.compensation,
              run.state().velocity.compensation);
  }
}

}  // namespace
}  // namespace emmy
