// Every claim can be refuted: a deliberately wrong variant of the method fails
// it. A claim without such a variant fails here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_replace.h"
#include "tests/verification/wrong_schemes.h"
#include "verification/registry.h"

namespace emmy::verification {
namespace {

struct Tooth {
  const char* claim;
  const char* variant;
  Scheme scheme;
  double fault = 0.0;  // See ClaimSetting.
  BaselineSource baseline = BaselineScheme;
  friend void PrintTo(const Tooth& tooth, std::ostream* os) {
    *os << tooth.claim << " by " << tooth.variant;
  }
};

// One method in the place of every baseline.
BaselineSource Always(Baseline baseline) {
  return [baseline](Baseline) { return BaselineScheme(baseline); };
}
Scheme AlwaysEnergyMomentum(Baseline) { return EnergyMomentumScheme; }

const std::vector<Tooth>& Teeth() {
  const Scheme plain = PlainArithmeticScheme;
  const Scheme own = EnergyMomentumScheme;  // Right; something else is wrong.
  static const std::vector<Tooth>* const teeth = new std::vector<Tooth>{
      {"kinematics/points", "Fault", own, 1e-14},
      {"kinematics/constant_mass", "Fault", own, 2.3e-16},
      {"kinematics/momenta", "Fault", own, 1e-14},
      {"kinematics/attitude", "Fault", own, 1e-13},
      {"laws/force_gradient", "Fault", own, 1e-13},
      {"laws/exact_motion", "Fault", own, 1e-14},
      {"laws/residual_work", "WrongClock", WrongClock(1e-12)},
      {"laws/residual_work", "StrainKick", StrainKick(1e-10)},
      {"laws/joint_work", "PlainArithmetic", plain},
      {"symmetry/time_reversal", "BiasedRounding", BiasedRounding(1e-16)},
      {"symmetry/objectivity", "PreferredAxis", PreferredAxis(1e-16)},
      {"symmetry/permutation", "StrainKick", StrainKick(1e-13)},
      {"vibration/frequency", "WrongClock", WrongClock(1e-6)},
      {"vibration/amplitude", "StrainKick", StrainKick(1e-7)},
      {"vibration/relaxed_exponent", "StrainKick", StrainKick(1e-6)},
      {"agreement/box_attitude", "WrongClock", WrongClock(1e-5, true)},
      {"agreement/truss_attitude", "WrongClock", WrongClock(1e-5, true)},
      {"conservation/energy", "PlainArithmetic", plain},
      {"conservation/energy", "LooseNewton", LooseNewton(1e-6)},
      {"conservation/angular_momentum", "PlainArithmetic", plain},
      {"conservation/angular_momentum", "LooseNewton", LooseNewton(1e-6)},
      {"conservation/soft_penalty", "LooseNewton", LooseNewton(1e-8)},
      {"conservation/soft_penalty", "BiasedRounding", BiasedRounding(1e-18)},
      {"conservation/moving_body", "PlainArithmetic", plain},
      {"conservation/moving_body", "BiasedRounding", BiasedRounding(1e-18)},
      {"conservation/conventional_body", "PlainArithmetic", plain},
      {"conservation/conventional_body", "BiasedRounding",
       BiasedRounding(1e-18)},
      {"conservation/conventional_energy", "BiasedRounding",
       BiasedRounding(1e-22)},
      {"conservation/penalty_independence", "StrainKick", StrainKick(1e-6)},
      {"growth/ancf_body", "BiasedRounding", BiasedRounding(1e-20)},
      {"growth/conventional_body", "BiasedRounding", BiasedRounding(1e-20)},
      {"large_steps/hundredth_second", "BiasedRounding", BiasedRounding(1e-18)},
      {"large_steps/tenth_second", "BiasedRounding", BiasedRounding(1e-17)},
      {"large_steps/half_second", "FewIterations", FewIterations(4)},
      {"large_steps/never_silent", "LooseNewton", LooseNewton(0.1)},
      {"large_steps/never_silent", "SilentFailure", SilentFailure},
      {"penalty/locked_exponent", "WrongClock", WrongClock(1e-5, true)},
      {"penalty/locked_error", "WrongClock", WrongClock(1e-6, true)},
      {"penalty/polar_exponent", "WrongClock", WrongClock(1e-5, true)},
      {"penalty/relaxed_error", "WrongClock", WrongClock(1e-6, true)},
      {"order/ancf_body", "FirstOrderClock", FirstOrderClock(1e-2)},
      {"order/conventional_body", "FirstOrderClock", FirstOrderClock(1e-2)},
      {"order/penalty_floor", "StrainKick", StrainKick(1e-6)},
      {"composition/conventional_order_4", "OtherOrder", OtherOrder(2)},
      {"composition/conventional_order_6", "OtherOrder", OtherOrder(4)},
      {"composition/ancf_order_4", "OtherOrder", OtherOrder(2)},
      {"composition/ancf_order_6", "UnpairedComposition", UnpairedComposition},
      {"composition/soft_order_4", "OtherOrder", OtherOrder(2)},
      {"composition/soft_order_6", "OtherOrder", OtherOrder(4)},
      {"composition/floors", "BiasedRounding", BiasedRounding(1e-17)},
      {"composition/between", "StrainKick", StrainKick(1e-5)},
      {"composition/conservation", "BiasedRounding", BiasedRounding(1e-17)},
      {"composition/conservation", "LooseNewton", LooseNewton(1e-6)},
      {"external/flip_times", "WrongClock", WrongClock(1e-5)},
      {"external/motion", "WrongClock", WrongClock(1e-5)},
      {"external/positions", "WrongClock", WrongClock(1e-12)},
      {"external/andrews_angles", "WrongClock", WrongClock(1e-5)},
      {"external/four_particles", "WrongClock", WrongClock(1e-5)},
      {"external/pendulum_phase", "WrongClock", WrongClock(1e-5)},
      {"structures/truss_conservation", "PlainArithmetic", plain},
      {"structures/truss_million_steps", "LooseNewton", LooseNewton(1e-6)},
      {"structures/locked_exponent", "WrongClock", WrongClock(1e-5, true)},
      {"structures/locked_error", "WrongClock", WrongClock(1e-6, true)},
      {"structures/omega_after_ten_seconds", "WrongClock", WrongClock(1e-4)},
      {"structures/net_energy", "LooseNewton", LooseNewton(1e-3)},
      {"structures/chain_conservation", "LooseNewton", LooseNewton(1e-3)},
      {"structures/chain_joints", "PlainArithmetic", plain},
      {"structures/conventional_chain_conservation", "LooseNewton",
       LooseNewton(1e-3)},
      {"structures/conventional_chain_joints", "PlainArithmetic", plain},
      {"structures/chain_exponent", "WrongClock", WrongClock(1e-5, true)},
      {"structures/slack_energy", "LooseNewton", LooseNewton(1e-2)},
      {"structures/slack_changes", "StandingClock", WrongClock(-1.0 + 1e-6)},
      {"angular_velocity/extrapolation_relaxed", "StrainKick",
       StrainKick(1e-6)},
      {"angular_velocity/extrapolation_undeformed", "StrainKick",
       StrainKick(1e-4)},
      {"angular_velocity/time_step_floor", "WrongClock",
       WrongClock(1e-6, true)},
      {"angular_velocity/extrapolated_in_both", "WrongClock", WrongClock(1e-6)},
      {"baselines/box_energy", "LooseNewton", LooseNewton(1e-3)},
      {"baselines/box_energy", "SameMethod", own, 0.0, AlwaysEnergyMomentum},
      {"baselines/truss_energy", "LooseNewton", LooseNewton(1e-3)},
      {"baselines/truss_energy", "SameMethod", own, 0.0, AlwaysEnergyMomentum},
      {"baselines/energy_map", "SameMethod", own, 0.0, AlwaysEnergyMomentum},
      {"baselines/kept_angular_momentum", "Newmark", own, 0.0,
       Always(Baseline::kNewmark)},
      {"baselines/newmark_angular_momentum", "Midpoint", own, 0.0,
       Always(Baseline::kMidpoint)},
      {"baselines/midpoint_energy", "Newmark", own, 0.0,
       Always(Baseline::kNewmark)},
      {"baselines/verlet_limit", "Midpoint", own, 0.0,
       Always(Baseline::kMidpoint)},
      {"baselines/large_steps", "GeneralizedAlpha", own, 0.0,
       Always(Baseline::kGeneralizedAlpha)},
      {"baselines/generalized_alpha_damping", "Newmark", own, 0.0,
       Always(Baseline::kNewmark)},
      {"figures/paper_8", "WrongClock", WrongClock(1e-3, true)},
      {"figures/paper_9", "BiasedRounding", BiasedRounding(1e-16)},
      {"figures/paper_5", "WrongClock", WrongClock(1e-3, true)},
      {"figures/paper_6", "BiasedRounding", BiasedRounding(1e-16)},
      {"figures/energy_error", "PlainArithmetic", plain},
  };
  return *teeth;
}

class TeethTest : public ::testing::TestWithParam<Tooth> {};

TEST_P(TeethTest, RefutesTheClaim) {
  const Claim* claim = FindClaim(GetParam().claim);
  ASSERT_NE(claim, nullptr) << GetParam().claim;
  ClaimSetting setting;
  setting.scheme = GetParam().scheme;
  setting.baseline = GetParam().baseline;
  setting.fault = GetParam().fault;
  const Outcome outcome = RunClaim(*claim, setting);
  EXPECT_FALSE(outcome.pass);
  // By a measured value, not by something that went wrong on the way.
  EXPECT_FALSE(outcome.result.values.empty()) << outcome.failure;
  EXPECT_THAT(outcome.failure, ::testing::HasSubstr("bound"));
}

INSTANTIATE_TEST_SUITE_P(Claims, TeethTest, ::testing::ValuesIn(Teeth()),
                         [](const auto& tooth) {
                           return absl::StrReplaceAll(tooth.param.claim,
                                                      {{"/", "_"}}) +
                                  "_by_" + tooth.param.variant;
                         });

TEST(TeethCompletenessTest, EveryClaimHasAVariantThatRefutesIt) {
  for (const Claim& claim : AllClaims()) {
    EXPECT_TRUE(std::any_of(
        Teeth().begin(), Teeth().end(),
        [&claim](const Tooth& tooth) { return tooth.claim == claim.id; }))
        << claim.id;
  }
}

}  // namespace
}  // namespace emmy::verification
