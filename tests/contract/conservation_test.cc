// What a free body keeps, in either formulation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/contract/motions.h"
#include "tests/support/test_run.h"
#include "tests/support/variant_run.h"

namespace emmy {
namespace {

constexpr int64_t kNumSteps = 2000;

class ConservationTest : public ::testing::TestWithParam<Motion> {};

TEST_P(ConservationTest, EnergyIsKeptToRoundoff) {
  TestRun run(ModelOf(GetParam().body), GetParam().time_step);
  const EnergyRecord energy = run.Watch(kNumSteps).energy();
  EXPECT_LE(energy.max_error,
            RandomWalkBound(kNumSteps, GetParam().StepError()) * energy.scale);
}

TEST_P(ConservationTest, MomentumIsKeptInEveryBit) {
  TestRun run(ModelOf(GetParam().body), GetParam().time_step);
  EXPECT_EQ(run.Watch(kNumSteps).momentum().max_error, 0.0);
}

TEST_P(ConservationTest, AngularMomentumIsKeptToRoundoff) {
  TestRun run(ModelOf(GetParam().body), GetParam().time_step);
  const RigidBodyInertia& inertia = run.model().bodies()[0].inertia();
  const double spin =
      (inertia.tensor * GetParam().body.angular_velocity).norm();
  const double v = GetParam().body.velocity.norm();
  // A constant velocity is rounded alike in every step: x̄ errs by u |x̄ − x̄₀|
  // at most, which the momentum M v turns into a moment.
  const double orbit =
      RoundoffBound(4, inertia.mass * v * v * static_cast<double>(kNumSteps) *
                           GetParam().time_step);
  EXPECT_LE(
      run.Watch(kNumSteps).angular_momentum().max_error,
      RandomWalkBound(kNumSteps, GetParam().StepError()) * 3.0 * spin + orbit);
}

TEST_P(ConservationTest, CarriedStrainStaysThatOfTheVectors) {
  TestRun run(ModelOf(GetParam().body), GetParam().time_step);
  ASSERT_TRUE(run.Advance(kNumSteps));
  EXPECT_LE(StrainGap(run.model(), run.state()),
            RandomWalkBound(kNumSteps, GetParam().StepError()));
}

INSTANTIATE_TEST_SUITE_P(Motions, ConservationTest,
                         ::testing::ValuesIn(Motions()), MotionName);

// The energy check above, applied to steps of which one rule is broken: wrong
// arithmetic at a stiff penalty, a wrong strain at a soft one, where the
// fixed-point iteration of VariantRun converges.
class WrongVariantTest : public ::testing::TestWithParam<NamedVariant> {
 protected:
  // Largest error over the bound of EnergyIsKeptToRoundoff.
  static double ErrorOverBound(Variant variant) {
    const bool soft = variant == Variant::kEndPointStrain ||
                      variant == Variant::kStrainOfTheMean;
    const Motion motion{.name = "",
                        .body = PaperBox(Formulation::kAncf, soft ? 1e6 : 1e10),
                        .time_step = soft ? 0.01 : 1e-3};
    VariantRun run(variant, motion.body, motion.time_step);
    const DoubleDouble start = run.Energy();
    double largest = 0.0;
    for (int64_t i = 0; i < kNumSteps; ++i) {
      if (!run.Advance(1)) break;
      largest = std::max(largest, std::abs((run.Energy() - start).ToDouble()));
    }
    return largest /
           (RandomWalkBound(kNumSteps, motion.StepError()) * kPaperBoxEnergy);
  }
};

TEST_P(WrongVariantTest, IsRejectedByTheEnergyCheck) {
  EXPECT_GT(ErrorOverBound(GetParam().variant), 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, WrongVariantTest,
    ::testing::Values(
        NamedVariant{Variant::kUncompensated, "Uncompensated"},
        NamedVariant{Variant::kRecomputedStrain, "RecomputedStrain"},
        NamedVariant{Variant::kEndPointStrain, "EndPointStrain"},
        NamedVariant{Variant::kStrainOfTheMean, "StrainOfTheMean"},
        NamedVariant{Variant::kPositionUnknown, "PositionUnknown"}),
    [](const auto& variant) { return variant.param.name; });

class RightVariantTest : public WrongVariantTest {};

TEST_P(RightVariantTest, IsAcceptedByTheEnergyCheck) {
  EXPECT_LE(ErrorOverBound(GetParam().variant), 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, RightVariantTest,
    ::testing::Values(NamedVariant{Variant::kRight, "Right"}),
    [](const auto& variant) { return variant.param.name; });

}  // namespace
}  // namespace emmy
