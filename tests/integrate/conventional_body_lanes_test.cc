#include "emmy/integrate/conventional_body_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "emmy/base/double_double.h"
#include "emmy/model/model_builder.h"
#include "tests/integrate/lanes_run.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;

class ConventionalBodyLanesTest : public LanesTest {
 protected:
  static ModelDescription Boxes() {
    return TwoBoxes(Formulation::kConventional);
  }
};

TEST_F(ConventionalBodyLanesTest, BitsAreTheSameWithEveryInstructionSet) {
  ExpectSameBitsWithEveryInstructionSet(Boxes(), kTimeStep, 200);
}

// From states along a motion, with compensations made so large that one which
// is forgotten shows. Both finish in double-double arithmetic: what is left of
// a step is 2⁻²⁰ u of its increment here, and there what Newton's method with
// J alone leaves of a rounding error, |W| Δt u of it.
TEST_F(ConventionalBodyLanesTest, TheStepIsThatOfTheGeneralCode) {
  TestRun run(Boxes(), kTimeStep);
  RandomSource random(5);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(run.Advance(1));
    State state = run.state();
    constexpr double kLarge = 1e-9;
    for (Eigen::Index k = 0; k < state.velocity.value.size(); ++k) {
      state.velocity.compensation(k) += kLarge * random.Uniform(-1.0, 1.0);
    }
    for (const ModelBody& body : run.model().bodies()) {
      const ConventionalBodyLanes lanes(*body.conventional(), kTimeStep, {});
      ConventionalLanesIncrement fast;
      const BodyStepResult result = SolveInLanes(lanes, body, state, &fast);
      ASSERT_EQ(result.termination, Termination::kConverged);

      const Eigen::Index q = body.position_offset + 3;
      const Eigen::Index w = body.velocity_offset + 3;
      const ConventionalBodyStart start{
          .quaternion = state.position.value.segment<4>(q),
          .quaternion_compensation = state.position.compensation.segment<4>(q),
          .angular_velocity = state.velocity.value.segment<3>(w),
          .angular_velocity_compensation =
              state.velocity.compensation.segment<3>(w)};
      ConventionalBodyIncrement general;
      ASSERT_EQ(ConventionalBodyStep(*body.conventional(), kTimeStep, {})
                    .Solve(start, Vector3d::Zero(), &general)
                    .termination,
                Termination::kConverged);

      const double size = general.angular_velocity.cwiseAbs().maxCoeff();
      for (int k = 0; k < 3; ++k) {
        const double difference =
            (fast.angular_velocity[1 + k] - general.angular_velocity(k)) +
            (fast.angular_velocity_low[1 + k] -
             general.angular_velocity_low(k));
        EXPECT_LE(std::abs(difference), kTimeStep * RoundoffBound(16, size));
      }
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(fast.quaternion[k], general.quaternion(k),
                    RoundoffBound(16, kTimeStep));
      }
    }
  }
}

// Against the plain loops of CompensatedVector and Extrapolation.
TEST_F(ConventionalBodyLanesTest, AdvancesTheStateBitForBit) {
  TestRun run(Boxes(), kTimeStep);
  ASSERT_TRUE(run.Advance(7));
  RandomSource random(6);
  const Vector3d gravity = run.model().gravity();
  State fast = run.state();
  State plain = run.state();
  for (const ModelBody& body : run.model().bodies()) {
    const Eigen::Index q = body.position_offset;
    const Eigen::Index w = body.velocity_offset;
    ConventionalLanesIncrement increment;
    for (double& x : increment.quaternion) x = random.Uniform(-1.0, 1.0);
    for (double& x : increment.angular_velocity) x = random.Uniform(-1.0, 1.0);
    for (double& x : increment.angular_velocity_low) {
      x = 1e-17 * random.Uniform(-1.0, 1.0);
    }
    CommitInLanes(increment, kTimeStep, CentreIncrement(kTimeStep, gravity),
                  body, fast);

    plain.position.Add(q + 3, Eigen::Map<const Vector4d>(increment.quaternion));
    AddCentre(body, kTimeStep, gravity, plain);
    for (int i = 0; i < 3; ++i) {
      AddCompensated(increment.angular_velocity[1 + i],
                     increment.angular_velocity_low[1 + i],
                     plain.velocity.value(w + 3 + i),
                     plain.velocity.compensation(w + 3 + i));
    }
    const Vector3d rates =
        Eigen::Map<const Vector3d>(increment.angular_velocity + 1);
    Extrapolation::Errors errors{};
    plain.acceleration.Add(w + 3, (1.0 / kTimeStep) * rates, &errors);
    plain.acceleration.Predict(w + 3, 3, Extrapolation::BestOrder(errors));
  }
  EXPECT_TRUE(SameState(fast, plain));
}

// From no start value, at |W| Δt = 0.1: each correction squares the error, 4
// make it 10⁻¹⁶ of what it was. A Jacobian that is off by (½ |W| Δt)² = 2·10⁻³
// gains three digits a correction instead.
TEST_F(ConventionalBodyLanesTest, ConvergesAsNewtonsMethodDoes) {
  constexpr double kLargeStep = 0.1;
  TestRun run(Boxes(), kLargeStep);
  for (const ModelBody& body : run.model().bodies()) {
    const ConventionalBodyLanes lanes(*body.conventional(), kLargeStep, {});
    ConventionalLanesIncrement increment;
    EXPECT_EQ(SolveInLanes(lanes, body, run.state(), &increment).termination,
              Termination::kConverged)
        << body.name;
  }
}

// A start value that is off by 10⁻⁸ is corrected once, and what (CRBL-2) says
// is left: an inexact Jacobian, here by some (½ |W| Δt)², would leave 10⁻¹².
TEST_F(ConventionalBodyLanesTest, OneCorrectionLeavesWhatTheBoundSays) {
  constexpr double kLargeStep = 0.1;
  TestRun run(Boxes(), kLargeStep);
  const ModelBody& body = run.model().bodies()[0];
  const ConventionalBodyLanes lanes(*body.conventional(), kLargeStep, {});
  ConventionalLanesIncrement exact;
  State state = run.state();
  ASSERT_EQ(SolveInLanes(lanes, body, state, &exact).termination,
            Termination::kConverged);
  const Eigen::Map<const Vector3d> dw(exact.angular_velocity + 1);
  state.acceleration.next.segment<3>(body.velocity_offset + 3) =
      (1.0 + 1e-10) / kLargeStep * dw;
  ConventionalLanesIncrement corrected;
  const BodyStepResult result = SolveInLanes(lanes, body, state, &corrected);
  ASSERT_EQ(result.termination, Termination::kConverged);
  EXPECT_EQ(result.iterations, 1);
  for (int k = 1; k < 4; ++k) {
    EXPECT_LE(
        std::abs((corrected.angular_velocity[k] - exact.angular_velocity[k]) +
                 (corrected.angular_velocity_low[k] -
                  exact.angular_velocity_low[k])),
        0x1p-19 * RoundoffBound(1, dw.cwiseAbs().maxCoeff()));
  }
}

TEST_F(ConventionalBodyLanesTest, ABodyThatTurnsAboutAnAxisKeepsItsVelocity) {
  RigidBodyDescription box = PaperBox(Formulation::kConventional);
  box.angular_velocity = {0.0, 0.0, 2.0};
  TestRun run(ModelOf(box), 0.1);
  ASSERT_TRUE(run.Advance(1000));
  EXPECT_EQ(run.state().velocity.value.segment<3>(3), Vector3d(0.0, 0.0, 2.0));
}

TEST_F(ConventionalBodyLanesTest, NothingThatIsNotFiniteConverges) {
  const auto expect_not_converged = [](const auto& spoil) {
    ExpectNotConverged<ConventionalBodyLanes, ConventionalLanesIncrement>(
        Boxes(), kTimeStep, &ModelBody::conventional, spoil);
  };
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (const Eigen::Index entry : {3, 4, 5}) {
      SCOPED_TRACE(absl::StrCat(bad, " at ", entry));
      expect_not_converged(
          [&](State& state) { state.velocity.value(entry) = bad; });
    }
    SCOPED_TRACE(absl::StrCat(bad, " in the attitude"));
    expect_not_converged([&](State& state) { state.position.value(4) = bad; });
  }
}

TEST_F(ConventionalBodyLanesTest, AdvancesAsItSolvesAndCommits) {
  ExpectOneCallIsTwo<ConventionalBodyLanes, ConventionalLanesIncrement>(
      Boxes(), kTimeStep, &ModelBody::conventional);
}

TEST_F(ConventionalBodyLanesTest, AFailedStepLeavesTheState) {
  ExpectFailureLeavesTheState<ConventionalBodyLanes>(Boxes(), kTimeStep,
                                                     &ModelBody::conventional);
}

TEST_F(ConventionalBodyLanesTest, ABodyAloneMovesAsInCompany) {
  ExpectABodyAloneMovesAsInCompany(Boxes(), kTimeStep, 50);
}

TEST_F(ConventionalBodyLanesTest, NeedsPrincipalAxes) {
  RigidBodyInertia inertia = PaperBoxInertia();
  EXPECT_TRUE(ConventionalBodyLanes::Fits(ConventionalRigidBody(inertia)));
  inertia.tensor(0, 1) = inertia.tensor(1, 0) = 1.0;
  EXPECT_FALSE(ConventionalBodyLanes::Fits(ConventionalRigidBody(inertia)));
}

}  // namespace
}  // namespace emmy
