#include "emmy/integrate/body_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/energy_momentum.h"
#include "tests/contract/roundoff_growth.h"
#include "tests/integrate/batch_run.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 1e-3;

// One body's part of a state, compared bit for bit.
void ExpectSameBody(const ModelBody& a, const State& state_a,
                    const ModelBody& b, const State& state_b) {
  const Eigen::Index positions = a.ancf() != nullptr ? 12 : 7;
  const Eigen::Index velocities = a.ancf() != nullptr ? 12 : 6;
  EXPECT_EQ(state_a.position.value.segment(a.position_offset, positions),
            state_b.position.value.segment(b.position_offset, positions))
      << b.name;
  EXPECT_EQ(state_a.position.compensation.segment(a.position_offset, positions),
            state_b.position.compensation.segment(b.position_offset, positions))
      << b.name;
  EXPECT_EQ(state_a.velocity.value.segment(a.velocity_offset, velocities),
            state_b.velocity.value.segment(b.velocity_offset, velocities))
      << b.name;
  EXPECT_EQ(
      state_a.velocity.compensation.segment(a.velocity_offset, velocities),
      state_b.velocity.compensation.segment(b.velocity_offset, velocities))
      << b.name;
}

constexpr int64_t kWithoutFusedMultiplyAdd =
    HWY_SSE4 | HWY_SSSE3 | HWY_EMU128 | HWY_SCALAR | HWY_WASM;

std::vector<int64_t> TargetsWhere(bool fused) {
  std::vector<int64_t> targets;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (((target & kWithoutFusedMultiplyAdd) == 0) == fused) {
      targets.push_back(target);
    }
  }
  return targets;
}

std::vector<int64_t> FusedTargets() { return TargetsWhere(true); }
std::vector<int64_t> OtherTargets() { return TargetsWhere(false); }

class BodyBatchTest : public InstructionSetTest {};

// Of those that round a product before they add to it, and of the others.
TEST_F(BodyBatchTest, EveryInstructionSetGivesTheSameBits) {
  const BuiltModel built = BuildModel(AllKinds()).value();
  for (const std::vector<int64_t>& targets : {FusedTargets(), OtherTargets()}) {
    if (targets.empty()) continue;
    ChooseInstructionSet(targets[0]);
    const State expected = StateAfter(built, 300, {.time_step = kStep});
    for (const int64_t target : targets) {
      ChooseInstructionSet(target);
      EXPECT_TRUE(
          SameState(StateAfter(built, 300, {.time_step = kStep}), expected))
          << hwy::TargetName(target);
    }
    ChooseInstructionSet(0);
  }
}

TEST_F(BodyBatchTest, AnyNumberOfThreadsGivesTheSameBits) {
  const BuiltModel built = BuildModel(AllKinds()).value();
  const State expected = StateAfter(built, 100, {.time_step = kStep});
  for (const int threads : {2, 3, 40}) {
    EXPECT_TRUE(SameState(
        StateAfter(built, 100, {.time_step = kStep, .num_threads = threads}),
        expected))
        << threads;
  }
}

TEST_F(BodyBatchTest, AnyDivisionIntoCallsGivesTheSameBits) {
  const BuiltModel built = BuildModel(AllKinds()).value();
  const State expected = StateAfter(built, 100, {.time_step = kStep});
  for (const int steps_per_call : {1, 4, 50}) {
    EXPECT_TRUE(SameState(
        StateAfter(built, 100, {.time_step = kStep}, steps_per_call), expected))
        << steps_per_call;
  }
}

TEST_F(BodyBatchTest, AStoredAndLoadedStateGoesOnWithTheSameBits) {
  const BuiltModel built = BuildModel(AllKinds()).value();
  const State expected = StateAfter(built, 100, {.time_step = kStep});
  const BuiltModel middle = {built.model,
                             StateAfter(built, 60, {.time_step = kStep})};
  EXPECT_TRUE(
      SameState(StateAfter(middle, 40, {.time_step = kStep}), expected));
}

// Every body of `all` moves as it does alone, with the same iterations.
void ExpectMovesAsAlone(const ModelDescription& all, int64_t iterations,
                        const State& state, int num_steps) {
  const BuiltModel together = BuildModel(all).value();
  int64_t iterations_alone = 0;
  for (size_t i = 0; i < all.rigid_bodies.size(); ++i) {
    const BuiltModel alone = BuildModel(ModelOf(all.rigid_bodies[i])).value();
    BodyBatch batch = MakeBatch(alone, {.time_step = kStep});
    iterations_alone += batch.Step(num_steps).iterations;
    State state_alone = alone.state;
    batch.Store(&state_alone);
    ExpectSameBody(alone.model.bodies()[0], state_alone,
                   together.model.bodies()[i], state);
  }
  EXPECT_EQ(iterations, iterations_alone);
}

// Every number of lanes left over, and every place in a vector: alone, a body
// is with lanes that are not alive.
TEST_F(BodyBatchTest, ABodyMovesAsIfItWereAlone) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    const ModelDescription all = MixedBodies(kBatchLanes + 1, formulation);
    const BuiltModel together = BuildModel(all).value();
    BodyBatch batch = MakeBatch(together, {.time_step = kStep});
    const int64_t iterations = batch.Step(50).iterations;
    State state = together.state;
    batch.Store(&state);
    ExpectMovesAsAlone(all, iterations, state, 50);
  }
}

// Where one round is enough in all lanes, a step is made without a loop.
TEST_F(BodyBatchTest, AStepOfOneRoundIsThatOfABodyAlone) {
  for (const bool ancf : {true, false}) {
    const ModelDescription all =
        ancf ? MixedBodies(2 * kBatchLanes, Formulation::kAncf, 1e10,
                           Start::kRelaxed)
             : MixedBodies(2 * kBatchLanes, Formulation::kConventional);
    const BuiltModel together = BuildModel(all).value();
    BodyBatch batch = MakeBatch(together, {.time_step = kStep});
    const int64_t start = batch.Step(20).iterations;
    const int64_t rest = batch.Step(30).iterations;
    EXPECT_EQ(rest, (ancf ? 2 : 1) * 2 * kBatchLanes * 30);
    State state = together.state;
    batch.Store(&state);
    ExpectMovesAsAlone(all, start + rest, state, 50);
  }
}

// One lane of the last pack needs more, and no other; after Load one round is
// tried.
TEST_F(BodyBatchTest, AStepOfOneRoundWaitsForEveryPack) {
  ModelDescription all = MixedBodies(kBatchLanes, Formulation::kConventional);
  all.rigid_bodies.back().angular_velocity *= 100.0;
  const BuiltModel together = BuildModel(all).value();
  BodyBatch batch = MakeBatch(together, {.time_step = kStep});
  State state = together.state;
  int64_t iterations = 0;
  for (int i = 0; i < 50; ++i) {
    batch.Load(state);
    const int64_t now = batch.Step(1).iterations;
    if (i >= 20) {
      EXPECT_GT(now, kBatchLanes);
      EXPECT_LE(now, kBatchLanes + 3);
    }
    iterations += now;
    batch.Store(&state);
  }
  ExpectMovesAsAlone(all, iterations, state, 50);
}

// Δe is Δt w̄ of the very rates that are committed: what is missing would be
// angular momentum Δe × w̄. In long double, with Δt exact.
TEST_F(BodyBatchTest, AncfBodiesMoveByTheMeanRateToTheLastBitOfAPair) {
  using Long = long double;
  static_assert(std::numeric_limits<Long>::digits >= 64);
  const auto wide = [](double x) { return static_cast<Long>(x); };
  const BuiltModel built =
      BuildModel(MixedBodies(16, Formulation::kAncf, 1e10, Start::kRelaxed))
          .value();
  BodyBatch batch = MakeBatch(built, {.time_step = kStep});
  State before = built.state;
  State after = built.state;
  for (int i = 0; i < 20; ++i) {
    const BatchReport report = batch.Step(1);
    ASSERT_TRUE(report.ok());
    ASSERT_EQ(report.ordinary_steps, 0);
    batch.Store(&after);
    const auto change = [&wide](const CompensatedVector& from,
                                const CompensatedVector& to, Eigen::Index k) {
      return (wide(to.value(k)) - wide(from.value(k))) +
             (wide(to.compensation(k)) - wide(from.compensation(k)));
    };
    for (const ModelBody& body : built.model.bodies()) {
      for (Eigen::Index k = 3; k < 12; ++k) {
        const Eigen::Index q = body.position_offset + k;
        const Eigen::Index w = body.velocity_offset + k;
        const Long rate = change(before.velocity, after.velocity, w);
        const Long mean = wide(before.velocity.value(w)) +
                          (wide(before.velocity.compensation(w)) + 0.5L * rate);
        // A few roundings to 64 bits, and two of Δw to 53.
        const Long bound = wide(kStep) * (0x1p-60L * std::abs(mean) +
                                          0x1p-52L * std::abs(rate));
        EXPECT_LE(std::abs(change(before.position, after.position, q) -
                           wide(kStep) * mean),
                  bound)
            << body.name << " " << k;
      }
    }
    before = after;
  }
}

struct Agreement {
  std::string name;
  ModelDescription description;
  double time_step;
  friend void PrintTo(const Agreement& a, std::ostream* os) { *os << a.name; }
};

std::vector<Agreement> Agreements() {
  std::vector<Agreement> cases;
  for (const int exponent : {4, 6, 8, 10, 12, 14}) {
    const double penalty = std::pow(10.0, exponent);
    const std::string suffix = "1e" + std::to_string(exponent);
    const ModelDescription bodies = MixedBodies(9, Formulation::kAncf, penalty);
    cases.push_back({"Ancf" + suffix, bodies, kStep});
    cases.push_back({"AncfLargeStep" + suffix, bodies, 0.1});
    cases.push_back(
        {"AncfRelaxed" + suffix,
         MixedBodies(9, Formulation::kAncf, penalty,
                     exponent > 6 ? Start::kRelaxed : Start::kUndeformed),
         kStep});
  }
  const ModelDescription bodies = MixedBodies(9, Formulation::kConventional);
  cases.push_back({"Conventional", bodies, kStep});
  cases.push_back({"ConventionalLargeStep", bodies, 0.1});
  cases.push_back({"ConventionalHugeStep", bodies, 2.0});
  cases.push_back({"AllKinds", AllKinds(), kStep});
  ModelDescription falling = AllKinds();
  falling.gravity = {0.1, -0.2, -9.81};
  cases.push_back({"Falling", falling, kStep});
  return cases;
}

class BatchAgreementTest : public ::testing::TestWithParam<Agreement> {};

// Largest distance of velocities, of any body relative to its largest, after
// one step from the same state, along a motion of the ordinary step.
double LargestDifference(const Agreement& agreement) {
  constexpr int kNumSteps = 100;
  TestRun run(agreement.description,
              IntegratorOptions{.time_step = agreement.time_step});
  BodyBatch batch =
      BodyBatch::Create(run.model(), {.time_step = agreement.time_step})
          .value();
  State state = run.state();
  double largest = 0.0;
  for (int i = 0; i < kNumSteps; ++i) {
    batch.Load(run.state());
    if (!run.Advance(1) || !batch.Step(1).ok()) {
      ADD_FAILURE() << "step " << i;
      break;
    }
    batch.Store(&state);
    const CompensatedVector& v = run.state().velocity;
    const CompensatedVector& w = state.velocity;
    const VectorXd difference =
        (v.value - w.value) + (v.compensation - w.compensation);
    for (const ModelBody& body : run.model().bodies()) {
      const Eigen::Index first = body.velocity_offset;
      const Eigen::Index size = body.ancf() != nullptr ? 12 : 6;
      largest = std::max(
          largest,
          difference.segment(first, size).cwiseAbs().maxCoeff() /
              v.value.segment(first + 3, size - 3).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_EQ(state.step, run.state().step);
  EXPECT_EQ(state.time.value, run.state().time.value);
  return largest;
}

// As sharply as the equations define the velocity: see tangent_test.cc.
TEST_P(BatchAgreementTest, LeadsToTheStepOfOneBody) {
  EXPECT_LE(LargestDifference(GetParam()), RoundoffBound(32, 1.0));
}

TEST_P(BatchAgreementTest, LeadsToItWithoutFusedMultiplyAddToo) {
  const std::vector<int64_t> targets = OtherTargets();
  if (targets.empty()) GTEST_SKIP() << "not on this processor";
  ChooseInstructionSet(targets[0]);
  EXPECT_LE(LargestDifference(GetParam()), RoundoffBound(32, 1.0));
  ChooseInstructionSet(0);
}

INSTANTIATE_TEST_SUITE_P(Cases, BatchAgreementTest,
                         ::testing::ValuesIn(Agreements()),
                         [](const auto& c) { return c.param.name; });

class BatchInvariantsTest : public ::testing::TestWithParam<int> {};

// The bound of one body in a million steps, for the worst of eleven.
void ExpectKept(const ModelDescription& description, int64_t num_steps) {
  const BuiltModel built = BuildModel(description).value();
  BodyBatch batch = MakeBatch(built, {.time_step = kStep});
  // Each body by itself: in a sum their errors would cancel.
  std::vector<BuiltModel> alone;
  std::vector<InvariantMonitor> monitors;
  for (const RigidBodyDescription& body : description.rigid_bodies) {
    alone.push_back(BuildModel(ModelOf(body)).value());
  }
  for (const BuiltModel& one : alone) {
    monitors.emplace_back(one.model, one.state);
  }
  State state = built.state;
  for (int64_t i = 0; i < num_steps; i += 1000) {
    ASSERT_TRUE(batch.Step(1000).ok());
    batch.Store(&state);
    for (size_t k = 0; k < alone.size(); ++k) {
      State& one = alone[k].state;
      verification::CopyBody(built.model.bodies()[k], state, &one);
      monitors[k].Observe(one);
    }
  }
  for (size_t k = 0; k < alone.size(); ++k) {
    const std::string& name = built.model.bodies()[k].name;
    EXPECT_LE(monitors[k].energy().max_relative_error(), 1e-15) << name;
    EXPECT_LE(monitors[k].momentum().max_relative_error(), 1e-15) << name;
    EXPECT_LE(monitors[k].angular_momentum().max_relative_error(), 1e-15)
        << name;
  }
}

TEST_P(BatchInvariantsTest, OfAncfBodiesAreKeptOverAHundredThousandSteps) {
  ExpectKept(MixedBodies(11, Formulation::kAncf, std::pow(10.0, GetParam())),
             100000);
}

INSTANTIATE_TEST_SUITE_P(Exponents, BatchInvariantsTest,
                         ::testing::Values(6, 8, 10, 12, 14),
                         ::testing::PrintToStringParamName());

TEST_F(BodyBatchTest, KeepsInvariantsOfRelaxedAncfBodies) {
  ExpectKept(MixedBodies(11, Formulation::kAncf, 1e10, Start::kRelaxed),
             100000);
}

TEST_F(BodyBatchTest, KeepsInvariantsOfConventionalBodies) {
  ExpectKept(MixedBodies(11, Formulation::kConventional), 100000);
}

// Energy errors of 32 boxes that differ in the last place of their angular
// velocity: a random walk, as of the ordinary step (roundoff_growth_test.cc).
GrowthLaw GrowthOf(Formulation formulation, double penalty, Start start) {
  constexpr int kBodies = 32;
  ModelDescription description;
  for (int i = 0; i < kBodies; ++i) {
    RigidBodyDescription box = ShiftedBox(formulation, penalty, i);
    box.name = "box_" + std::to_string(i);
    if (formulation == Formulation::kAncf) box.start = start;
    description.rigid_bodies.push_back(box);
  }
  const BuiltModel built = BuildModel(description).value();
  BodyBatch batch = MakeBatch(built, {.time_step = kStep});
  State state = built.state;
  std::vector<DoubleDouble> start_energies;
  for (size_t i = 0; i < kBodies; ++i) {
    start_energies.push_back(EnergyOfBody(description, built, i, state));
  }
  const std::vector<int64_t> steps = NumbersOfSteps(100000);
  std::vector<std::vector<double>> errors(steps.size());
  int64_t done = 0;
  for (size_t k = 0; k < steps.size(); ++k) {
    EXPECT_TRUE(batch.Step(steps[k] - done).ok());
    done = steps[k];
    batch.Store(&state);
    for (size_t i = 0; i < kBodies; ++i) {
      const DoubleDouble energy = EnergyOfBody(description, built, i, state);
      errors[k].push_back((energy - start_energies[i]).ToDouble() /
                          start_energies[i].ToDouble());
    }
  }
  return FitGrowthLaw(steps, errors);
}

TEST_F(BodyBatchTest, EnergyErrorsOfAncfBodiesAreRandomWalks) {
  for (const Start start : {Start::kUndeformed, Start::kRelaxed}) {
    const GrowthLaw law = GrowthOf(Formulation::kAncf, 1e10, start);
    EXPECT_TRUE(law.IsRandomWalk()) << law;
    EXPECT_LT(law.sizes.back(), 2.5e-16);  // As roundoff_growth_test.cc.
  }
}

// Here the increments are pairs, and errors a thousandth of a rounding of ΔW:
// the bound is what the rule of (BATCH-4) leaves, 2⁻¹⁰ u |ΔW|, always of one
// sign. It is a tenth of what a random walk of roundings of ΔW comes to.
TEST_F(BodyBatchTest, EnergyErrorsOfConventionalBodiesAreBelowRounding) {
  const GrowthLaw law =
      GrowthOf(Formulation::kConventional, 0.0, Start::kUndeformed);
  constexpr double kPerStep = 2.0 * 0x1p-10 * 0x1p-53 * kStep;  // |ω| ≤ 1.
  EXPECT_LE(law.sizes.back(), 100000 * kPerStep) << law;
}

TEST_F(BodyBatchTest, KeepsTheEnergyOfFallingBodies) {
  ModelDescription description = AllKinds();
  description.gravity = {0.1, -0.2, -9.81};
  const BuiltModel built = BuildModel(description).value();
  InvariantMonitor monitor(built.model, built.state);
  monitor.Observe(StateAfter(built, 10000, {.time_step = kStep}));
  EXPECT_LE(monitor.energy().max_relative_error(), 1e-15);
}

TEST_F(BodyBatchTest, BodiesInPrincipalAxesTakeTheFastPath) {
  const BuiltModel built =
      BuildModel(MixedBodies(16, Formulation::kAncf, 1e10)).value();
  BodyBatch batch = MakeBatch(built, {.time_step = kStep});
  const BatchReport report = batch.Step(100);
  EXPECT_EQ(report.ordinary_steps, 0);
  EXPECT_LE(report.iterations, 4 * 16 * 100);
}

TEST_F(BodyBatchTest, OtherBodiesAndHardStepsAreTakenByTheOrdinaryStep) {
  const BuiltModel tilted = BuildModel(AllKinds()).value();
  BodyBatch batch = MakeBatch(tilted, {.time_step = kStep});
  EXPECT_GE(batch.Step(10).ordinary_steps, 2 * 10);
  const BuiltModel fast =
      BuildModel(MixedBodies(9, Formulation::kConventional)).value();
  BodyBatch large_steps = MakeBatch(fast, {.time_step = 2.0});
  const BatchReport report = large_steps.Step(10);
  EXPECT_TRUE(report.ok());
  EXPECT_GT(report.ordinary_steps, 0);
}

// A body that is not a number, and one that runs away.
TEST_F(BodyBatchTest, AFailingBodyIsNamedAndTouchesNoOther) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    const BuiltModel built = BuildModel(AllKinds()).value();
    const State expected = StateAfter(built, 20, {.time_step = kStep});
    BodyBatch batch =
        BodyBatch::Create(built.model, {.time_step = kStep}).value();
    State broken = built.state;
    constexpr size_t kBroken[2] = {5, 22};
    for (const size_t i : kBroken) {
      broken.velocity.value(built.model.bodies()[i].velocity_offset + 4) =
          value;
    }
    batch.Load(broken);
    const BatchReport report = batch.Step(20);
    ASSERT_EQ(report.failures.size(), 2U);
    for (size_t k = 0; k < 2; ++k) {
      const std::string& name = built.model.bodies()[kBroken[k]].name;
      EXPECT_EQ(report.failures[k].body, name);
      // A huge spin about a principal axis may pass a first step.
      EXPECT_LE(report.failures[k].step, std::isnan(value) ? 1 : 2);
      EXPECT_THAT(report.failures[k].message, HasSubstr(name));
    }
    EXPECT_TRUE(batch.Step(0).ok());
    State state = built.state;
    batch.Store(&state);
    for (size_t i = 0; i < built.model.bodies().size(); ++i) {
      const ModelBody& body = built.model.bodies()[i];
      if (i == kBroken[0] || i == kBroken[1]) {
        // Where it was.
        if (std::isnan(value)) {
          EXPECT_EQ(
              state.position.value.segment<3>(body.position_offset),
              built.state.position.value.segment<3>(body.position_offset));
        }
        continue;
      }
      ExpectSameBody(body, expected, body, state);
    }
  }
}

TEST_F(BodyBatchTest, RefusesWhatItDoesNotCover) {
  const BuiltModel built = BuildModel(AllKinds()).value();
  EXPECT_THAT(
      BodyBatch::Create(built.model, {.time_step = 0.0}).status().message(),
      HasSubstr("time_step"));
  EXPECT_THAT(
      BodyBatch::Create(built.model, {.time_step = kStep, .num_threads = 0})
          .status()
          .message(),
      HasSubstr("num_threads"));
  ModelDescription loaded = AllKinds();
  loaded.loads.emplace_back(TorqueLoad{"body_0", {1.0, 0.0, 0.0}});
  const BuiltModel with_load = BuildModel(loaded).value();
  EXPECT_THAT(BodyBatch::Create(with_load.model, {.time_step = kStep})
                  .status()
                  .message(),
              HasSubstr("free rigid bodies"));
}

// A caller's mistakes, which would read and write beside the state.
TEST_F(BodyBatchTest, AStateOfAnotherModelStopsTheProgram) {
  const BuiltModel built = BuildModel(ModelOf(PaperBox())).value();
  BodyBatch batch =
      BodyBatch::Create(built.model, {.time_step = kStep}).value();
  EXPECT_DEATH(batch.Step(1).ok(), "Load before Step");
  State other =
      BuildModel(ModelOf(PaperBox(Formulation::kConventional)))->state;
  constexpr char kOther[] =
      "a state of 7 positions, .* for a model of 12 positions";
  EXPECT_DEATH(batch.Load(other), kOther);
  batch.Load(built.state);
  EXPECT_DEATH(batch.Store(&other), kOther);
  EXPECT_DEATH(batch.Step(-1).ok(), "-1");
  BodyBatch moved = std::move(batch);
  EXPECT_TRUE(moved.Step(1).ok());
  // NOLINTNEXTLINE(bugprone-use-after-move): what is tested.
  EXPECT_DEATH(batch.Step(1).ok(), "a batch that was moved from");
}

}  // namespace
}  // namespace emmy
