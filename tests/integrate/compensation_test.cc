// The low-order parts of a state count as much as the values: a step from
// (value, compensation) is the step from their sum. Compensations are made
// large here, so that a forgotten one shows.

#include <gtest/gtest.h>

#include <cmath>

#include "emmy/base/double_double.h"
#include "emmy/diagnostics/extended_state.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;
constexpr double kLarge = 1e-7;  // Of a compensation; u would be rounding.

// Sums are rounded to u of their values, strains times b / M Δt to as much of
// the velocities: far below kLarge.
constexpr double kRounding = 1e-12;

class AncfCompensationTest : public ::testing::Test {
 protected:
  AncfCompensationTest() : built_(*BuildModel(ModelOf(PaperBox()))) {
    RandomSource random(8);
    start_.gradients = Matrix3d::Identity();
    start_.rates = random.Entries<Matrix3d>(1.0);
    start_.rates = 0.5 * (start_.rates - start_.rates.transpose()).eval();
    start_.strain.setZero();
    start_.gradients_compensation.setZero();
    start_.rates_compensation.setZero();
    start_.strain_compensation.setZero();
  }

  AncfBodyIncrement Solve(const AncfBodyStart& start) const {
    const AncfBodyStep step(*built_.model.bodies()[0].ancf(), kTimeStep, {});
    AncfBodyIncrement increment;
    const BodyStepResult result =
        step.Solve(start, Matrix3d::Zero(), &increment);
    EXPECT_EQ(result.termination, Termination::kConverged);
    return increment;
  }

  // Of this part of a body's start.
  template <typename Entries>
  void ExpectCompensationCounts(Entries AncfBodyStart::*value,
                                Entries AncfBodyStart::*compensation) const {
    AncfBodyStart split = start_;
    split.*compensation = RandomSource(1).Entries<Entries>(kLarge);
    AncfBodyStart whole = start_;
    whole.*value += split.*compensation;
    const AncfBodyIncrement a = Solve(split);
    const AncfBodyIncrement b = Solve(whole);
    EXPECT_LE((a.rates - b.rates).cwiseAbs().maxCoeff(), kRounding);
    EXPECT_LE((a.gradients - b.gradients).cwiseAbs().maxCoeff(),
              kTimeStep * kRounding);
    EXPECT_LE((a.strain - b.strain).cwiseAbs().maxCoeff(),
              kTimeStep * kRounding);
  }

  BuiltModel built_;
  AncfBodyStart start_;
};

TEST_F(AncfCompensationTest, ThoseOfTheVectorsCount) {
  ExpectCompensationCounts(&AncfBodyStart::gradients,
                           &AncfBodyStart::gradients_compensation);
}

TEST_F(AncfCompensationTest, ThoseOfTheRatesCount) {
  ExpectCompensationCounts(&AncfBodyStart::rates,
                           &AncfBodyStart::rates_compensation);
}

TEST_F(AncfCompensationTest, ThoseOfTheStrainCount) {
  ExpectCompensationCounts(&AncfBodyStart::strain,
                           &AncfBodyStart::strain_compensation);
}

TEST(ConventionalCompensationTest, ThoseOfTheAngularVelocityCount) {
  const BuiltModel built =
      *BuildModel(ModelOf(PaperBox(Formulation::kConventional)));
  const ConventionalBodyStep step(*built.model.bodies()[0].conventional(),
                                  kTimeStep, {});
  ConventionalBodyStart split{
      .quaternion = {1.0, 0.0, 0.0, 0.0},
      .quaternion_compensation = Vector4d::Zero(),
      .angular_velocity = {0.3, 0.5, 0.8},
      .angular_velocity_compensation = RandomSource(4).Vector(kLarge)};
  ConventionalBodyStart whole = split;
  whole.angular_velocity += split.angular_velocity_compensation;
  whole.angular_velocity_compensation.setZero();
  ConventionalBodyIncrement a;
  ConventionalBodyIncrement b;
  ASSERT_EQ(step.Solve(split, Vector3d::Zero(), &a).termination,
            Termination::kConverged);
  ASSERT_EQ(step.Solve(whole, Vector3d::Zero(), &b).termination,
            Termination::kConverged);
  EXPECT_LE((a.angular_velocity - b.angular_velocity).norm(),
            kTimeStep * kRounding);
  EXPECT_LE((a.quaternion - b.quaternion).norm(), kTimeStep * kRounding);
}

// A free body moves by the same Δt v in every step. Rounded alike each time,
// its product would drift: 1e5 steps by 1e5 half units of 1e-4 m, 5e-16 m.
TEST(CentreOfMassTest, MovesByExactlyTheSumOfItsSteps) {
  constexpr int kSteps = 100000;
  RigidBodyDescription box = PaperBox();
  box.velocity = {0.1, -0.3, 0.7};
  TestRun run(ModelOf(box), kTimeStep);
  ASSERT_TRUE(run.Advance(kSteps));
  const DoubleDouble3 position = Extended3(run.state().position, 0);
  for (int i = 0; i < 3; ++i) {
    const DoubleDouble expected =
        DoubleDouble(TwoProduct(kTimeStep, box.velocity(i))) *
        DoubleDouble(static_cast<double>(kSteps));
    const double error = std::abs((position[i] - expected).ToDouble());
    // Only the compensation is rounded, to u of half a unit of 70 m.
    EXPECT_LE(error, RoundoffBound(kSteps, kUnitRoundoff * 70.0)) << i;
  }
}

}  // namespace
}  // namespace emmy
