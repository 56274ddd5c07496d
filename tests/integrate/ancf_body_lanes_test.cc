#include "emmy/integrate/ancf_body_lanes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
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
      for (int k = 1; k < 4; ++k) {
        EXPECT_NEAR(fast.stretch[k], expected.stretch[k], kTimeStep * bound);
        EXPECT_NEAR(fast.shear[k], expected.shear[k], kTimeStep * bound);
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
    for (double& g : increment.gradients_low) {
      g = 1e-17 * random.Uniform(-1.0, 1.0);
    }
    for (double& r : increment.rates) r = random.Uniform(-1.0, 1.0);
    for (double& s : increment.stretch) s = 1e-9 * random.Uniform(-1.0, 1.0);
    for (double& s : increment.shear) s = 1e-9 * random.Uniform(-1.0, 1.0);
    CommitInLanes(increment, kTimeStep, CentreIncrement(kTimeStep, gravity),
                  body, fast);

    AddCentre(body, kTimeStep, gravity, plain);
    for (int i = 3; i < 12; ++i) {
      AddCompensated(increment.gradients[i], increment.gradients_low[i],
                     plain.position.value(q + i),
                     plain.position.compensation(q + i));
    }
    plain.strain.Add(body.strain_offset,
                     Eigen::Map<const Vector3d>(increment.stretch + 1));
    plain.strain.Add(body.strain_offset + 3,
                     Eigen::Map<const Vector3d>(increment.shear + 1));
    const Eigen::Map<const Vector9d> rates(increment.rates + 3);
    plain.velocity.Add(w + 3, rates);
    Extrapolation::Errors errors{};
    plain.acceleration.Add(w + 3, (1.0 / kTimeStep) * rates, &errors);
    plain.acceleration.Predict(w + 3, 9, Extrapolation::BestOrder(errors));
  }
  EXPECT_TRUE(SameState(fast, plain));
}

// From a start value that is off by 10⁻⁸ in any direction, one correction
// leaves what (LANE-3) says. Without D the strains would keep 2 τ of it,
// without the stress the rotation a sixth of σ.
TEST_P(LanesStartTest, OneCorrectionLeavesWhatTheBoundSays) {
  constexpr double kOff = 1e-8;
  TestRun run(Boxes(GetParam()), kTimeStep);
  ASSERT_TRUE(run.Advance(20));
  RandomSource random(7);
  const ModelBody& body = run.model().bodies()[0];
  const AncfRigidBody& ancf = *body.ancf();
  const AncfBodyLanes exact_lanes(ancf, kTimeStep, {});
  // What any correction satisfies.
  const AncfBodyLanes one_correction(ancf, kTimeStep, {.tolerance = 0.99});
  AncfLanesIncrement exact;
  State state = run.state();
  ASSERT_EQ(SolveInLanes(exact_lanes, body, state, &exact).termination,
            Termination::kConverged);
  const Eigen::Map<const Matrix3d> dw(exact.rates + 3);
  const Eigen::Map<const Matrix3d> w(state.velocity.value.data() +
                                     body.velocity_offset + 3);
  const Eigen::Map<const Matrix3d> e(state.position.value.data() +
                                     body.position_offset + 3);
  const Matrix3d mean_rate = w + 0.5 * dw;
  const Matrix3d mean = e + 0.5 * kTimeStep * mean_rate;
  const double turn =
      (0.5 * kTimeStep * mean.transpose() * mean_rate).cwiseAbs().maxCoeff();
  const double strain =
      state.strain.value.segment<6>(body.strain_offset).cwiseAbs().maxCoeff();
  for (int i = 0; i < 20; ++i) {
    const auto off = random.Entries<Matrix3d>(kOff);
    const Matrix3d guess = (dw + off) / kTimeStep;
    state.acceleration.next.segment<9>(body.velocity_offset + 3) =
        Eigen::Map<const Vector9d>(guess.data());
    AncfLanesIncrement corrected;
    const BodyStepResult result =
        SolveInLanes(one_correction, body, state, &corrected);
    ASSERT_EQ(result.termination, Termination::kConverged);
    ASSERT_EQ(result.iterations, 1);
    const Matrix3d left = Eigen::Map<const Matrix3d>(corrected.rates + 3) - dw;
    // Strains of twice those of the start, for their increments.
    const double metric = 2.0 * turn * turn + 4.0 * strain;
    const double stiffening = exact_lanes.stiffening * kTimeStep *
                              ancf.penalty_stiffness().maxCoeff() * 2.0 *
                              strain;
    const double size = std::sqrt(3.0) * kOff;
    const double quadratic = exact_lanes.second_order * size;
    const double noise = RoundoffBound(32, w.cwiseAbs().maxCoeff());
    EXPECT_LE(
        left.cwiseAbs().maxCoeff(),
        std::sqrt(3.0) *
                (16.0 * turn * turn + 6.0 * metric + stiffening + quadratic) *
                size +
            noise);
    Vector3d moment = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      moment += ancf.second_moment()(k, k) * mean.col(k).cross(left.col(k));
    }
    // Of residuals as small as Δw.
    EXPECT_LE(moment.cwiseAbs().maxCoeff() / exact_lanes.smallest_moment_sum,
              (stiffening * (4.0 * turn + stiffening) + 4.0 * metric * metric +
               quadratic) *
                      size +
                  RoundoffBound(32, dw.cwiseAbs().maxCoeff()));
  }
}

// Whether Δe is Δt w̄ of the very Δw that is committed: what is missing would be
// angular momentum Δe × w̄ and work without a force. In long double, which must
// have more digits than the bound.
TEST_P(LanesStartTest, MovesByTheMeanRateToTheLastBitOfAPair) {
  using Long = long double;
  static_assert(std::numeric_limits<Long>::digits >= 64);
  const auto wide = [](double x) { return static_cast<Long>(x); };
  TestRun run(Boxes(GetParam()), kTimeStep);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(run.Advance(1));
    const State& state = run.state();
    for (const ModelBody& body : run.model().bodies()) {
      const AncfBodyLanes lanes(*body.ancf(), kTimeStep, {});
      AncfLanesIncrement increment;
      ASSERT_EQ(SolveInLanes(lanes, body, state, &increment).termination,
                Termination::kConverged);
      for (int k = 3; k < 12; ++k) {
        const Eigen::Index entry = body.velocity_offset + k;
        const Long w0 = wide(state.velocity.value(entry));
        const Long low = wide(state.velocity.compensation(entry));
        const Long rate = wide(increment.rates[k]);
        const Long expected = wide(kTimeStep) * (w0 + (low + 0.5L * rate));
        const Long moved =
            wide(increment.gradients[k]) + wide(increment.gradients_low[k]);
        // Four roundings to 64 bits each way, and one of w_low + ½ Δw to 53.
        const Long bound = wide(kTimeStep) * (0x1p-61L * std::abs(w0) +
                                              0x1p-53L * std::abs(rate));
        EXPECT_LE(std::abs(moved - expected), bound) << k;
      }
    }
  }
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

// A start value far away, with vectors that are all parallel: their volume is
// zero, and so is a correction that is taken along their normals.
TEST_F(AncfBodyLanesTest, AFlatBodyIsNotAccepted) {
  constexpr double kLarge = 0.5;
  TestRun run(Boxes(1e14), kLarge);
  const ModelBody& body = run.model().bodies()[0];
  for (const NewtonOptions& options :
       {NewtonOptions{}, NewtonOptions{.tolerance = 1e-6}}) {
    const AncfBodyLanes lanes(*body.ancf(), kLarge, options);
    State state = run.state();
    // Of powers of two, so that all products are exact.
    state.acceleration.next.segment<9>(body.velocity_offset + 3) =
        0x1p200 * (Vector9d() << 1, 2, 4, 2, 4, 8, -1, -2, -4).finished();
    AncfLanesIncrement increment;
    EXPECT_NE(SolveInLanes(lanes, body, state, &increment).termination,
              Termination::kConverged);
  }
}

TEST_F(AncfBodyLanesTest, NothingThatIsNotFiniteConverges) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (const Eigen::Index entry : {3, 7, 11}) {
      SCOPED_TRACE(absl::StrCat(bad, " at ", entry));
      ExpectNotConverged<AncfBodyLanes, AncfLanesIncrement>(
          Boxes(), kTimeStep, &ModelBody::ancf,
          [&](State& state) { state.velocity.value(entry) = bad; });
    }
  }
}

TEST_F(AncfBodyLanesTest, AdvancesAsItSolvesAndCommits) {
  ExpectOneCallIsTwo<AncfBodyLanes, AncfLanesIncrement>(Boxes(), kTimeStep,
                                                        &ModelBody::ancf);
}

TEST_F(AncfBodyLanesTest, AFailedStepLeavesTheState) {
  ExpectFailureLeavesTheState<AncfBodyLanes>(Boxes(), kTimeStep,
                                             &ModelBody::ancf);
}

TEST_F(AncfBodyLanesTest, ABodyAloneMovesAsInCompany) {
  ExpectABodyAloneMovesAsInCompany(Boxes(), kTimeStep, 50);
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
