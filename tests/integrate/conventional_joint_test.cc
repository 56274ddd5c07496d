// Conventional bodies joined at shared points: laws, gaps, and the motion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/integrate/conventional_structure_step.h"
#include "emmy/numerics/rotation.h"
#include "tests/integrate/allocation_counter.h"
#include "tests/support/joined_boxes.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"
#include "verification/models/large_models.h"

namespace emmy {
namespace {

using ::testing::HasSubstr;

// Of each law, relative. A step errs by the rounding of its increments, some
// 10⁻³ of the values, and 10³ steps of a few terms each add like their root.
constexpr double kKept = 1e-15;
constexpr double kTimeStep = 1e-3;

ModelDescription Chain(int n) {
  return Conventional(verification::BoxChain(n).model);
}

// A chain with a truss to a node on one box, and one between two others.
ModelDescription TrussedChain() {
  ModelDescription model = Chain(5);
  NodeDescription tip;
  tip.name = "tip";
  tip.mass = 10.0;
  tip.position = model.rigid_bodies[1].position + Vector3d(0.2, 1.0, 1.5);
  tip.velocity = MovesWith{"box_1"};
  model.nodes.push_back(tip);
  model.trusses.push_back(
      TestTruss("up", BodyPoint{"box_1", {0.0, 1.0, 0.5}}, NodePoint{"tip"}));
  model.trusses.push_back(TestTruss("along",
                                    BodyPoint{"box_2", {0.0, 1.0, 0.5}},
                                    BodyPoint{"box_4", {0.0, 1.0, 0.5}}));
  return model;
}

// The largest gap of a joint, along all directions, beyond a double [m].
double LargestGap(const TestRun& run) {
  double largest = 0.0;
  for (const ModelJoint& joint : run.model().joints()) {
    const Point& second = joint.points[1];
    DoubleDouble3 place = ExtendedPosition(run.model(), run.state(), second);
    if (second.is_ground()) {
      place += DoubleDouble3::FromDouble(joint.rest);
    } else {
      const std::array<DoubleDouble3, 3> frame = ExtendedFrame(
          run.model().bodies()[*second.conventional_body], run.state());
      for (int i = 0; i < 3; ++i) {
        place += DoubleDouble(joint.rest(i)) * frame[static_cast<size_t>(i)];
      }
    }
    const DoubleDouble3 gap =
        ExtendedPosition(run.model(), run.state(), joint.points[0]) - place;
    largest = std::max(largest, Norm(gap).ToDouble());
  }
  return largest;
}

// The largest speed of a joint's point [m/s].
double LargestSpeed(const TestRun& run) {
  double largest = 0.0;
  for (const ModelJoint& joint : run.model().joints()) {
    for (const Point& point : joint.points) {
      if (point.is_ground()) continue;
      const ModelBody& body = run.model().bodies()[*point.conventional_body];
      const VectorXd& w = run.state().velocity.value;
      largest =
          std::max(largest, w.segment<3>(body.velocity_offset).norm() +
                                w.segment<3>(body.velocity_offset + 3).norm() *
                                    point.xi.norm());
    }
  }
  return largest;
}

using Kind = JointKind;

class ConventionalJointTest : public ::testing::TestWithParam<Kind> {};

TEST_P(ConventionalJointTest, KeepsTheLaws) {
  TestRun run(GetParam().model(), kTimeStep);
  const InvariantMonitor monitor = run.Watch(1000);
  EXPECT_EQ(run.state().step, 1000);
  EXPECT_LE(monitor.energy().max_relative_error(), kKept);
  if (!GetParam().is_free) return;
  EXPECT_LE(monitor.momentum().max_relative_error(), kKept);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), kKept);
}

// What rounding leaves in a step is closed by the next: it does not add up.
TEST_P(ConventionalJointTest, JointsStayClosedToTheRoundingOfOneStep) {
  TestRun run(GetParam().model(), kTimeStep);
  EXPECT_LE(LargestGap(run), 1e-30);
  double largest = 0.0;
  double speed = 0.0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(run.Advance(1));
    largest = std::max(largest, LargestGap(run));
    speed = std::max(speed, LargestSpeed(run));
  }
  // Two bodies, each with a dozen roundings of its increment.
  EXPECT_LE(largest, 24.0 * 0x1p-53 * kTimeStep * speed);
}

TEST_P(ConventionalJointTest, RunsBackToTheStart) {
  ExpectRunsBack(GetParam().model(), kTimeStep, 100, 1e-3);
}

TEST_P(ConventionalJointTest, LargeStepsKeepTheEnergy) {
  TestRun run(GetParam().model(), 0.05);
  const InvariantMonitor monitor = run.Watch(10);
  EXPECT_EQ(run.state().step, 10);
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ConventionalJointTest,
    ::testing::Values(
        Kind{"Pair", [] { return Chain(2); }},
        Kind{"Chain", [] { return Chain(10); }},
        Kind{"LongChain", [] { return Chain(100); }},
        Kind{"HangingChain",
             [] { return Conventional(HangingChain(9, /*both_ends=*/false)); },
             false},
        Kind{"Pendulum",
             [] { return Conventional(HangingChain(1, /*both_ends=*/false)); },
             false},
        Kind{"LoadedChain", [] { return Loaded(Chain(10)); }, false},
        Kind{"TrussedChain", TrussedChain},
        Kind{"Tree",
             [] { return Conventional(verification::BoxTree(31).model); }},
        Kind{"Hinges", [] { return Conventional(Hinges(6)); }},
        Kind{"Loop", [] { return Conventional(BoxRhombus(false)); }},
        Kind{"HingedLoop", [] { return Conventional(BoxRhombus(true)); }}),
    [](const auto& kind) { return std::string(kind.param.name); });

// That the check of the laws can fail.
TEST(ConventionalJointAccuracyTest, ALooseIterationDoesNotKeepTheEnergy) {
  TestRun run(Chain(10),
              IntegratorOptions{.time_step = 0.05, .tolerance = 1e-2});
  EXPECT_GT(run.Watch(200).energy().max_relative_error(), 100.0 * kKept);
}

// A box released from the horizontal, about a fixed point of its short edge:
// the period of a physical pendulum is that of (PEN-4) with l = J/(m d).
class BoxPendulumTest : public ::testing::Test {
 protected:
  // The miss of the angle after a quarter of a period in n steps.
  static double Miss(int n, int order) {
    constexpr double kGravity = 9.81;
    constexpr double kArm = 1.5;
    ModelDescription model = Conventional(HangingChain(1, false));
    model.gravity = {0.0, 0.0, -kGravity};
    const RigidBodyInertia inertia = PaperBoxInertia();
    const double length = (inertia.tensor(1, 1) + inertia.mass * kArm * kArm) /
                          (inertia.mass * kArm);
    const double quarter =
        std::comp_ellint_1(std::sqrt(0.5)) * std::sqrt(length / kGravity);
    TestRun run(model,
                IntegratorOptions{.order = order, .time_step = quarter / n});
    EXPECT_TRUE(run.Advance(n));
    // From the pivot to the centre: straight down.
    const Vector3d pivot =
        model.rigid_bodies[0].position - Vector3d(kArm, 0.0, 0.0);
    const Vector3d arm = run.state().position.value.head<3>() - pivot;
    EXPECT_NEAR(arm.norm(), kArm, 1e-14);
    return std::atan2(arm(0), -arm(2));
  }
};

TEST_F(BoxPendulumTest, SwingsAsTheEllipticIntegralSays) {
  const double coarse = Miss(500, 2);
  const double fine = Miss(1000, 2);
  EXPECT_NEAR(coarse / fine, 4.0, 0.02);
  EXPECT_LE(std::abs(fine), 1e-5);
}

TEST_F(BoxPendulumTest, OfOrderFour) {
  const double coarse = Miss(25, 4);
  const double fine = Miss(50, 4);
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 4.0, 0.3);
}

// The limit of a stiff penalty: the ANCF chain's places approach those of the
// conventional one as 1/α.
TEST(ConventionalJointAgreementTest, TheAncfChainApproachesItByOneOverAlpha) {
  constexpr int kSteps = 2000;
  std::array<double, 3> misses{};
  for (size_t i = 0; i < misses.size(); ++i) {
    ModelDescription model = verification::BoxChain(3).model;
    for (RigidBodyDescription& box : model.rigid_bodies) {
      box.penalty = std::pow(10.0, 6.0 + static_cast<double>(i));
    }
    TestRun soft(model, kTimeStep);
    TestRun rigid(Chain(3), kTimeStep);
    for (int step = 0; step < kSteps; ++step) {
      ASSERT_TRUE(rigid.Advance(1));
      ASSERT_TRUE(soft.Advance(1));
      for (size_t b = 0; b < 3; ++b) {
        misses[i] = std::max(
            misses[i],
            (soft.Motion(b).position - rigid.Motion(b).position).norm());
      }
    }
  }
  for (size_t i = 0; i + 1 < misses.size(); ++i) {
    EXPECT_NEAR(std::log10(misses[i] / misses[i + 1]), 1.0, 0.15);
  }
}

// The velocities of a joint's points agree to second order, and turn round.
TEST(ConventionalJointAlternationTest, VelocitiesAgreeToSecondOrder) {
  const auto largest = [](double time_step) {
    TestRun run(Chain(3), time_step);
    double gap = 0.0;
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(run.Advance(1));
      std::array<Vector3d, 2> velocities;
      const ModelJoint& joint = run.model().joints()[0];
      for (size_t e = 0; e < 2; ++e) {
        const BodyMotion motion =
            run.Motion(*joint.points[e].conventional_body);
        velocities[e] =
            motion.velocity +
            motion.omega_locked.cross(QuaternionToMatrix(motion.quaternion) *
                                      joint.points[e].xi);
      }
      gap = std::max(gap, (velocities[0] - velocities[1]).norm());
    }
    return gap;
  };
  const double coarse = largest(1e-2);
  EXPECT_NEAR(coarse / largest(5e-3), 4.0, 1.0);
  EXPECT_LE(coarse, 1e-5);
}

// Straight between two fixed points: bodies that other joints hold only there.
TEST(ConventionalJointFailureTest, ASingularPositionIsReported) {
  TestRun run(Conventional(HangingChain(3, /*both_ends=*/true)), kTimeStep);
  EXPECT_EQ(run.model().joints().back().num_held, 2);
  State start = run.state();
  StepReport report;
  for (int i = 0; i < 100 && report.message.empty(); ++i) {
    start = run.state();
    report = run.Step();
  }
  EXPECT_EQ(report.termination, Termination::kSingularTangent);
  EXPECT_THAT(report.message, HasSubstr("/shared_points/3, which opens"));
  EXPECT_TRUE(SameState(run.state(), start));
}

TEST(ConventionalJointAllocationTest, AStepAllocatesNothing) {
  TestRun run(Chain(20), kTimeStep);
  ASSERT_TRUE(run.Advance(3));
  ExpectStepsAllocateNothing(run, 20);
}

// Two plates held apart by `legs` rods with a ball at each end: the joints of a
// rod are linked by it alone, which no order of elimination may forget.
ModelDescription Platform(int legs) {
  const Vector3d omega(0.1, -0.2, 0.3);
  ModelDescription model;
  const auto add = [&](const std::string& name, const Vector3d& position) {
    RigidBodyDescription body = PaperBox(Formulation::kConventional);
    body.name = name;
    body.position = position;
    body.angular_velocity = omega;
    body.velocity = omega.cross(position);
    model.rigid_bodies.push_back(body);
  };
  const Vector3d height(0.0, 0.0, 3.0);
  add("base", Vector3d::Zero());
  add("plate", height);
  for (int i = 0; i < legs; ++i) {
    const auto on_circle = [](double turn) {
      const double angle = 2.0 * M_PI * turn;
      return Vector3d(std::cos(angle), std::sin(angle), 0.0);
    };
    // In pairs, so that the plate cannot turn against the base.
    const double turn = static_cast<double>(i) / legs;
    const Vector3d foot = on_circle(turn);
    const Vector3d head = on_circle(turn + (i % 2 == 0 ? 0.08 : -0.08));
    const Vector3d half = 0.5 * (height + head - foot);
    const std::string name = absl::StrCat("leg_", i);
    add(name, foot + half);
    model.shared_points.push_back(
        {BodyPoint{"base", foot}, BodyPoint{name, -half}});
    model.shared_points.push_back(
        {BodyPoint{name, half}, BodyPoint{"plate", head}});
  }
  return model;
}

TEST(ConventionalJointTest, KeepsTheLawsOfAPlatformOnLegs) {
  for (const int legs : {1, 2, 3, 4, 5, 6}) {
    TestRun run(Platform(legs), kTimeStep);
    const InvariantMonitor monitor = run.Watch(100);
    EXPECT_EQ(run.state().step, 100) << legs;
    EXPECT_LE(monitor.energy().max_relative_error(), kKept) << legs;
    EXPECT_LE(monitor.angular_momentum().max_relative_error(), kKept) << legs;
  }
}

}  // namespace
}  // namespace emmy
