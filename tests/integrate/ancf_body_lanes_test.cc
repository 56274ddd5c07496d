#include "emmy/integrate/ancf_body_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "emmy/model/model_builder.h"
#include "tests/integrate/lanes_run.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;

class AncfBodyLanesTest : public LanesTest {
 protected:
  static ModelDescription Boxes(double penalty = 1e10) {
    return TwoBoxes(Formulation::kAncf, penalty);
  }
};

TEST_F(AncfBodyLanesTest, BitsAreTheSameWithEveryInstructionSet) {
  ExpectSameBitsWithEveryInstructionSet(Boxes(), kTimeStep, 200);
}

class LanesStartTest : public AncfBodyLanesTest,
                       public ::testing::WithParamInterface<double> {};

// From states along a motion, with compensations made so large that one which
// is forgotten shows. Both solve the same equations to round-off, which defines
// a velocity to some u |ω| (see tangent_test.cc).
TEST_P(LanesStartTest, TheStepIsThatOfTheGeneralCode) {
  TestRun run(Boxes(GetParam()), kTimeStep);
  RandomSource random(5);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(run.Advance(1));
    State state = run.state();
    constexpr double kLarge = 1e-9;
    for (CompensatedVector* v :
         {&state.position, &state.velocity, &state.strain}) {
      for (Eigen::Index k = 0; k < v->value.size(); ++k) {
        const double low = kLarge * random.Uniform(-1.0, 1.0) *
                           (v == &state.strain ? kTimeStep : 1.0);
        v->compensation(k) += low;
      }
    }
    for (const ModelBody& body : run.model().bodies()) {
      const AncfBodyLanes lanes(*body.ancf(), kTimeStep, {});
      AncfLanesIncrement fast;
      const BodyStepResult result = SolveInLanes(lanes, body, state, &fast);
      ASSERT_EQ(result.termination, Termination::kConverged);

      const auto columns = [&](const VectorXd& v, Eigen::Index offset) {
        return Matrix3d(Eigen::Map<const Matrix3d>(v.data() + offset + 3));
      };
      const AncfBodyStart start{
          .gradients = columns(state.position.value, body.position_offset),
          .gradients_compensation =
              columns(state.position.compensation, body.position_offset),
          .rates = columns(state.velocity.value, body.velocity_offset),
          .rates_compensation =
              columns(state.velocity.compensation, body.velocity_offset),
          .strain = state.strain.value.segment<6>(body.strain_offset),
          .strain_compensation =
              state.strain.compensation.segment<6>(body.strain_offset)};
      AncfBodyIncrement increment;
      const BodyStepResult general =
          AncfBodyStep(*body.ancf(), kTimeStep, {})
              .Solve(start, Matrix3d::Zero(), &increment);
      ASSERT_EQ(general.termination, Termination::kConverged);
      AncfLanesIncrement expected;
      expected.Set(increment);

      const double bound = RoundoffBound(32, start.rates.cwiseAbs().maxCoeff());
      for (int k = 3; k < 12; ++k) {
        EXPECT_NEAR(fast.rates[k], expected.rates[k], bound) << k;
        EXPECT_NEAR(fast.gradients[k], expected.gradients[k], kTimeStep * bound)
            << k;
      }
      for (int k = 1; k < 7; ++k) {
        EXPECT_NEAR(fast.strain[k], expected.strain[k], kTimeStep * bound) << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Penalties, LanesStartTest,
                         ::testing::Values(1e6, 1e8, 1e10, 1e12, 1e14));

// Against the plain loops of CompensatedVector and Extrapolation.
TEST_F(AncfBodyLanesTest, AdvancesTheStateBitForBit) {
  TestRun run(Boxes(), kTimeStep);
  ASSERT_TRUE(run.Advance(7));
  RandomSource random(6);
  const Vector3d gravity = run.model().gravity();
  State fast = run.state();
  State plain = run.state();
  for (const ModelBody& body : run.model().bodies()) {
    const Eigen::Index q = body.position_offset;
    const Eigen::Index w = body.velocity_offset;
    AncfLanesIncrement increment;
    for (double& g : increment.gradients) g = random.Uniform(-1.0, 1.0);
    for (double& r : increment.rates) r = random.Uniform(-1.0, 1.0);
    for (double& s : increment.strain) s = 1e-9 * random.Uniform(-1.0, 1.0);
    CommitInLanes(increment, kTimeStep, gravity, body, fast);

    const Eigen::Map<const Vector9d> rates(increment.rates + 3);
    plain.position.Add(q + 3,
                       Eigen::Map<const Vector9d>(increment.gradients + 3));
    plain.strain.Add(body.strain_offset,
                     Eigen::Map<const Vector6d>(increment.strain + 1));
    const Vector3d change = kTimeStep * gravity;
    for (int i = 0; i < 3; ++i) {
      const double mean =
          plain.velocity.value(w + i) +
          (plain.velocity.compensation(w + i) + 0.5 * change(i));
      const SumAndError product = TwoProduct(kTimeStep, mean);
      AddCompensated(product.sum, product.error, plain.position.value(q + i),
                     plain.position.compensation(q + i));
    }
    plain.velocity.Add(w, change);
    plain.velocity.Add(w + 3, rates);
    Extrapolation::Errors errors{};
    plain.acceleration.Add(w + 3, (1.0 / kTimeStep) * rates, &errors);
    plain.acceleration.Predict(w + 3, 9, Extrapolation::BestOrder(errors));
  }
  for (Eigen::Index i = 0; i < fast.position.value.size(); ++i) {
    // e₁'s first number shares its vector with the centre, whose sum keeps the
    // rounding of increment plus compensation.
    const double slack = i % 12 == 3 ? RoundoffBound(1, 1.0) : 0.0;
    EXPECT_NEAR(fast.position.value(i) - plain.position.value(i),
                plain.position.compensation(i) - fast.position.compensation(i),
                slack)
        << i;
  }
  EXPECT_EQ(fast.velocity.value, plain.velocity.value);
  EXPECT_EQ(fast.velocity.compensation, plain.velocity.compensation);
  EXPECT_EQ(fast.strain.value, plain.strain.value);
  EXPECT_EQ(fast.strain.compensation, plain.strain.compensation);
  EXPECT_EQ(fast.acceleration.next, plain.acceleration.next);
  EXPECT_EQ(fast.acceleration.differences, plain.acceleration.differences);
}

TEST_F(AncfBodyLanesTest, ALargeStepIsLeftToTheGeneralCode) {
  constexpr double kLarge = 0.5;
  TestRun run(Boxes(), kLarge);
  const ModelBody& body = run.model().bodies()[0];
  AncfLanesIncrement increment;
  const AncfBodyLanes lanes(*body.ancf(), kLarge, {});
  EXPECT_NE(SolveInLanes(lanes, body, run.state(), &increment).termination,
            Termination::kConverged);
  EXPECT_TRUE(run.Advance(1));
}

TEST_F(AncfBodyLanesTest, NothingThatIsNotFiniteConverges) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (const Eigen::Index entry : {3, 7, 11}) {
      TestRun run(Boxes(), kTimeStep);
      const ModelBody& body = run.model().bodies()[0];
      State state = run.state();
      state.velocity.value(entry) = bad;
      AncfLanesIncrement increment;
      const AncfBodyLanes lanes(*body.ancf(), kTimeStep, {});
      EXPECT_NE(SolveInLanes(lanes, body, state, &increment).termination,
                Termination::kConverged)
          << bad << " at " << entry;
    }
  }
}

TEST_F(AncfBodyLanesTest, NeedsPrincipalAxes) {
  EXPECT_TRUE(AncfBodyLanes::Fits(PaperBoxElement()));
  RigidBodyInertia inertia = PaperBoxInertia();
  inertia.second_moment(0, 1) = inertia.second_moment(1, 0) = 1.0;
  EXPECT_FALSE(AncfBodyLanes::Fits(
      *AncfRigidBody::Create(inertia, Vector6d::Constant(1e10))));
}

}  // namespace
}  // namespace emmy
