// Energy errors grow like the square root of the number of steps, up to 10⁵.

#include "tests/contract/roundoff_growth.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"
#include "tests/support/test_run.h"
#include "tests/support/variant_run.h"

namespace emmy {
namespace {

constexpr double kTimeStep = 1e-3;

// Relative, at the 90th percentile after 10⁵ steps: 1.65 σ of a random walk of
// steps of 4 u |ω|Δt, rounded up.
constexpr double kLargest = 2.5e-16;

TEST(RoundoffGrowthTest, AncfEnergyErrorIsARandomWalk) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        return TestRun(ModelOf(ShiftedBox(Formulation::kAncf, 1e10, index)),
                       kTimeStep);
      },
      100000);
  EXPECT_TRUE(law.IsRandomWalk()) << law;
  EXPECT_LT(law.sizes.back(), kLargest);
}

TEST(RoundoffGrowthTest, ConventionalEnergyErrorIsARandomWalk) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        return TestRun(
            ModelOf(ShiftedBox(Formulation::kConventional, 0.0, index)),
            IntegratorOptions{.time_step = kTimeStep,
                              .always_full_newton = true});
      },
      100000);
  EXPECT_TRUE(law.IsRandomWalk()) << law;
  EXPECT_LT(law.sizes.back(), kLargest);
}

// In principal axes each step is as exact as (CRBL-2) says: 10⁵ of one sign may
// leave twice 2⁻²⁰ u |ω| Δt each.
TEST(RoundoffGrowthTest, ConventionalEnergyIsKeptBeyondADouble) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        return TestRun(
            ModelOf(ShiftedBox(Formulation::kConventional, 0.0, index)),
            kTimeStep);
      },
      100000);
  EXPECT_LT(law.sizes.back(), 2.2e-20);
}

// The velocity from rounded positions: 2/Δt multiplies a rounding that is not
// of mean zero.
TEST(RoundoffGrowthTest, VelocityFromPositionsIsNotARandomWalk) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        return VariantRun(Variant::kPositionUnknown,
                          ShiftedBox(Formulation::kAncf, 1e6, index), 0.01);
      },
      10000, 16);
  EXPECT_FALSE(law.IsRandomWalk()) << law;
}

// Plain additions, or strain taken from the vectors, whose rounding b
// multiplies, give a random walk as well, but of roundings of the state
// instead of those of its increment: it is the size that tells.
TEST(RoundoffGrowthTest, UncompensatedSumAndRecomputedStrainAreTooLarge) {
  for (const Variant variant :
       {Variant::kUncompensated, Variant::kRecomputedStrain}) {
    const GrowthLaw law = MeasureGrowth(
        [variant](int index) {
          return VariantRun(
              variant, ShiftedBox(Formulation::kAncf, 1e10, index), kTimeStep);
        },
        10000, 16);
    EXPECT_GT(law.sizes.back(), 10.0 * kLargest) << law;
  }
}

// The fit itself: 32 random walks, and the same with a drift that is a
// twentieth of one step's error.
class GrowthLawTest : public ::testing::Test {
 protected:
  static GrowthLaw Fit(double drift) {
    const std::vector<int64_t> steps = NumbersOfSteps(100000);
    std::vector<std::vector<double>> errors(steps.size());
    RandomSource random(20250611);
    for (int run = 0; run < 32; ++run) {
      double sum = 0.0;
      int64_t done = 0;
      for (size_t k = 0; k < steps.size(); ++k) {
        for (; done < steps[k]; ++done) {
          sum += random.Uniform(-1.0, 1.0) + drift;
        }
        errors[k].push_back(sum);
      }
    }
    return FitGrowthLaw(steps, errors);
  }
};

TEST_F(GrowthLawTest, AcceptsARandomWalk) {
  const GrowthLaw law = Fit(0.0);
  EXPECT_TRUE(law.IsRandomWalk()) << law;
}

TEST_F(GrowthLawTest, RejectsADriftOfATwentiethOfAStepsError) {
  const GrowthLaw law = Fit(0.05);
  EXPECT_FALSE(law.IsRandomWalk()) << law;
}

TEST_F(GrowthLawTest, RejectsErrorsThatDoNotGrow) {
  const std::vector<int64_t> steps = NumbersOfSteps(100000);
  const GrowthLaw law = FitGrowthLaw(
      steps, std::vector<std::vector<double>>(steps.size(), {1e-16, 1e-16}));
  EXPECT_FALSE(law.IsRandomWalk()) << law;
}

}  // namespace
}  // namespace emmy
