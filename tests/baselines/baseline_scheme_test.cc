#include "verification/baselines/baseline_scheme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/baselines/elastic_system.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr double kSoft = 1e6;  // [Pa], so that vibrations are resolved.

VectorXd PositionAfter(const Scheme& scheme, double duration,
                       double time_step) {
  absl::StatusOr<verification::Run> run =
      verification::Run::Start(PaperBoxAncf(kSoft), time_step, scheme);
  EXPECT_TRUE(run.ok());
  EXPECT_TRUE(run->Advance(std::llround(duration / time_step)).ok());
  return run->state().position.value;
}

class BaselineSchemeTest : public ::testing::TestWithParam<Baseline> {};

// Ω Δt = 0.15, 0.075, 0.037: the ratio of differences is off by (Ω Δt)².
TEST_P(BaselineSchemeTest, ConvergesToTheMotionOfEnergyMomentum) {
  const Scheme scheme = BaselineScheme(GetParam());
  const VectorXd coarse = PositionAfter(scheme, 0.5, 2e-3);
  const VectorXd middle = PositionAfter(scheme, 0.5, 1e-3);
  const VectorXd fine = PositionAfter(scheme, 0.5, 5e-4);
  EXPECT_NEAR((coarse - middle).norm() / (middle - fine).norm(), 4.0, 0.2);
  const VectorXd limit = (4.0 * fine - middle) / 3.0;
  const VectorXd em_middle = PositionAfter(EnergyMomentumScheme, 0.5, 1e-3);
  const VectorXd em_fine = PositionAfter(EnergyMomentumScheme, 0.5, 5e-4);
  const VectorXd em_limit = (4.0 * em_fine - em_middle) / 3.0;
  EXPECT_LT((limit - em_limit).norm(), 0.02 * (middle - fine).norm());
}

TEST_P(BaselineSchemeTest, LeavesTheStrainOfTheCoordinates) {
  absl::StatusOr<verification::Run> run = verification::Run::Start(
      PaperTrussAncf(1e8), 1e-4, BaselineScheme(GetParam()));
  ASSERT_TRUE(run.ok());
  ASSERT_TRUE(run->Advance(50).ok());
  EXPECT_LT(StrainGap(run->model(), run->state()), 16 * kUnitRoundoff);
  EXPECT_EQ(run->state().step, 50);
  EXPECT_NEAR(run->state().time.value, 5e-3, 1e-17);
}

// Of the same number too: a step depends on the state it is given, not on the
// run before.
TEST_P(BaselineSchemeTest, StartsAnewFromAnotherState) {
  const IntegratorOptions options{.time_step = 1e-3};
  const BuiltModel built = *BuildModel(PaperBoxAncf(kSoft));
  const Scheme scheme = BaselineScheme(GetParam());
  const StepFunction used = *scheme(built.model, options);
  State state = built.state;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(used(state).ok());
  State other = built.state;
  other.step = state.step;
  other.velocity.value *= 2.0;
  State expected = other;
  ASSERT_TRUE(used(other).ok());
  ASSERT_TRUE((*scheme(built.model, options))(expected).ok());
  EXPECT_EQ(other.position.value, expected.position.value);
  EXPECT_EQ(other.velocity.value, expected.velocity.value);
}

INSTANTIATE_TEST_SUITE_P(All, BaselineSchemeTest,
                         ::testing::ValuesIn(AllBaselines()),
                         [](const auto& baseline) {
                           std::string name = BaselineName(baseline.param);
                           for (char& c : name) {
                             if (c == ' ') c = '_';
                           }
                           return name;
                         });

// L − ¼ Δt² Σ w × f(q): the trapezoidal rule is the midpoint rule in other
// coordinates.                                                       (BASE-9)
TEST(NewmarkSchemeTest, KeepsWhatTheMidpointRuleHasForAngularMomentum) {
  constexpr int kSteps = 1000;
  absl::StatusOr<verification::Run> run = verification::Run::Start(
      PaperBoxAncf(1e8), kPaperTimeStep, BaselineScheme(Baseline::kNewmark));
  ASSERT_TRUE(run.ok());
  const ElasticSystem system = *SystemOfModel(run->model());
  const auto kept = [&] {
    const VectorXd& q = run->state().position.value;
    const VectorXd& w = run->state().velocity.value;
    const VectorXd momentum = system.mass * w;
    const VectorXd force = InternalForce(system, q);
    Vector3d sum = Vector3d::Zero();
    for (Eigen::Index v = 0; v < q.size(); v += 3) {
      const Vector3d velocity = w.segment<3>(v);
      sum += Vector3d(q.segment<3>(v)).cross(Vector3d(momentum.segment<3>(v)));
      sum -= 0.25 * kPaperTimeStep * kPaperTimeStep *
             velocity.cross(Vector3d(force.segment<3>(v)));
    }
    return sum;
  };
  const Vector3d start = kept();
  for (int i = 1; i <= kSteps; ++i) {
    ASSERT_TRUE(run->Advance(1).ok());
    // At worst a few u a step.
    ASSERT_LT((kept() - start).norm(),
              (8 + 4 * i) * kUnitRoundoff * start.norm());
  }
}

TEST(BaselineSchemeNameTest, AllHaveOne) {
  EXPECT_EQ(BaselineName(Baseline::kNewmark), "Newmark");
  EXPECT_EQ(BaselineName(Baseline::kVerlet), "Verlet");
}

}  // namespace
}  // namespace emmy::verification
