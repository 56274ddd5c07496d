// A million steps: label `slow`.

#include <gtest/gtest.h>

#include <ostream>

#include "tests/contract/roundoff_growth.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

constexpr int64_t kMillion = 1000000;

struct Stiffness {
  const char* name;
  Formulation formulation;
  double penalty;       // [Pa]
  double energy_bound;  // Relative, over all observed steps.
  friend void PrintTo(const Stiffness& s, std::ostream* os) { *os << s.name; }
};

class MillionStepsTest : public ::testing::TestWithParam<Stiffness> {};

// Bounds: the promise of the method, ten roundings of the energy whatever the
// stiffness; the softest body vibrates within the reach of the step, its
// increments are larger, and it is allowed more.
TEST_P(MillionStepsTest, KeepEnergyAndAngularMomentum) {
  TestRun run(ModelOf(PaperBox(GetParam().formulation, GetParam().penalty)),
              1e-3);
  const InvariantMonitor monitor = run.Watch(kMillion, 10);
  EXPECT_LE(monitor.energy().max_relative_error(), GetParam().energy_bound);
  EXPECT_LE(monitor.angular_momentum().max_relative_error(), 1e-15);
  EXPECT_EQ(monitor.momentum().max_error, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    PaperBox, MillionStepsTest,
    ::testing::Values(Stiffness{"Ancf1e4", Formulation::kAncf, 1e4, 2e-14},
                      Stiffness{"Ancf1e6", Formulation::kAncf, 1e6, 1e-15},
                      Stiffness{"Ancf1e8", Formulation::kAncf, 1e8, 1e-15},
                      Stiffness{"Ancf1e10", Formulation::kAncf, 1e10, 1e-15},
                      Stiffness{"Ancf1e12", Formulation::kAncf, 1e12, 1e-15},
                      Stiffness{"Ancf1e14", Formulation::kAncf, 1e14, 1e-15},
                      Stiffness{"Conventional", Formulation::kConventional, 0.0,
                                1e-15}),
    [](const auto& stiffness) { return stiffness.param.name; });

class MillionStepsGrowthTest : public ::testing::TestWithParam<Stiffness> {};

// Of the conventional body by Newton's method: its step in principal axes errs
// by less than a double can show, see below.
TEST_P(MillionStepsGrowthTest, EnergyErrorIsARandomWalk) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        const Stiffness& stiffness = GetParam();
        return TestRun(ModelOf(ShiftedBox(stiffness.formulation,
                                          stiffness.penalty, index)),
                       IntegratorOptions{
                           .time_step = 1e-3,
                           .always_full_newton = stiffness.formulation ==
                                                 Formulation::kConventional});
      },
      kMillion);
  EXPECT_TRUE(law.IsRandomWalk()) << law;
}

INSTANTIATE_TEST_SUITE_P(
    PaperBox, MillionStepsGrowthTest,
    ::testing::Values(Stiffness{"Ancf1e6", Formulation::kAncf, 1e6, 1e-15},
                      Stiffness{"Ancf1e10", Formulation::kAncf, 1e10, 1e-15},
                      Stiffness{"Ancf1e14", Formulation::kAncf, 1e14, 1e-15},
                      Stiffness{"Conventional", Formulation::kConventional, 0.0,
                                1e-15}),
    [](const auto& stiffness) { return stiffness.param.name; });

// As exact as (CRBL-2) says: 10⁶ steps of one sign may leave twice
// 2⁻²⁰ u |ω| Δt each.
TEST(MillionStepsConventionalTest, EnergyIsKeptBeyondADouble) {
  const GrowthLaw law = MeasureGrowth(
      [](int index) {
        return TestRun(
            ModelOf(ShiftedBox(Formulation::kConventional, 0.0, index)), 1e-3);
      },
      kMillion);
  EXPECT_LT(law.sizes.back(), 2.2e-19);
}

}  // namespace
}  // namespace emmy
