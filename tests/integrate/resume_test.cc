// A run that is taken up by another integrator, from its state and from what
// was kept, repeats every bit of one that never stopped.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_builder.h"
#include "tests/support/joined_boxes.h"
#include "tests/support/structures.h"
#include "tests/support/test_run.h"
#include "verification/models/large_models.h"

namespace emmy {
namespace {

struct Kind {
  const char* name;
  std::function<ModelDescription()> model;
  double time_step;
  int order = 2;
  // Forgetting the factorisation changes the bits, so that the test can fail.
  // Not where each step renews it: long steps of a stiff model.
  bool depends_on_factor = true;
  friend void PrintTo(const Kind& kind, std::ostream* os) { *os << kind.name; }
};

class ResumeTest : public ::testing::TestWithParam<Kind> {
 protected:
  static constexpr int kSteps = 120;

  ResumeTest() : built_(BuildModel(GetParam().model()).value()) {}

  EnergyMomentumIntegrator Integrator() const {
    return EnergyMomentumIntegrator::Create(
               built_.model,
               {.order = GetParam().order, .time_step = GetParam().time_step})
        .value();
  }

  // The end of a run taken up after every `every` steps, with or without what
  // was kept.
  State Run(int every, bool with_kept) const {
    State state = built_.state;
    EnergyMomentumIntegrator integrator = Integrator();
    for (int i = 0; i < kSteps; ++i) {
      if (i > 0 && i % every == 0) {
        const std::vector<KeptTangent> kept = integrator.Keep();
        integrator = Integrator();
        if (with_kept) {
          EXPECT_TRUE(integrator.Restore(kept).ok());
        }
      }
      const StepReport report = integrator.Step(state);
      EXPECT_TRUE(report.ok()) << report.message;
      if (!report.ok()) break;
    }
    return state;
  }

  BuiltModel built_;
};

TEST_P(ResumeTest, RepeatsEveryBit) {
  const State expected = Run(kSteps, true);
  for (const int every : {1, 7, 50}) {
    EXPECT_TRUE(SameState(Run(every, true), expected)) << every;
  }
}

TEST_P(ResumeTest, WouldNotWithoutTheFactorisation) {
  if (!GetParam().depends_on_factor) return;
  EXPECT_FALSE(SameState(Run(7, false), Run(kSteps, true)));
}

std::string Name(const ::testing::TestParamInfo<Kind>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Models, ResumeTest,
    ::testing::Values(
        Kind{"FreeBox", [] { return ModelOf(PaperBox()); }, 1e-3, 2, false},
        Kind{"FreeBoxOrderSix", [] { return ModelOf(PaperBox()); }, 1e-2, 6,
             false},
        Kind{"ConventionalBox",
             [] { return ModelOf(PaperBox(Formulation::kConventional)); }, 1e-3,
             2, false},
        // Small: renewed in every step.
        Kind{"BoxWithTruss", [] { return BoxWithTruss(); }, 1e-3, 2, false},
        Kind{"BoxWithTrussOrderFour", [] { return BoxWithTruss(); }, 1e-2, 4,
             false},
        Kind{"ConventionalWithTruss",
             [] { return BoxWithTruss(Formulation::kConventional); }, 1e-3, 2,
             false},
        Kind{"Tangle", Tangle, 1e-3, 2, false},
        Kind{"TangleInLongSteps", Tangle, 0.05, 2, false},
        // Factorised once in every step; trees and grids keep theirs.
        Kind{"Chain", [] { return verification::BoxChain(8).model; }, 1e-2, 2,
             false},
        Kind{"ConventionalChain",
             [] { return Conventional(verification::BoxChain(8).model); }, 1e-2,
             2, false},
        Kind{"ConventionalLinkageOrderFour",
             [] { return Conventional(BoxRhombus(/*hinged=*/true)); }, 1e-2, 4,
             false},
        Kind{"Tree", [] { return verification::BoxTree(15).model; }, 1e-2},
        Kind{"Grid", [] { return verification::BoxGrid(4).model; }, 1e-2},
        Kind{"Net", [] { return verification::SpinningNet(8).model; }, 1e-2},
        Kind{"CableNet", [] { return verification::SlackCableNet(6).model; },
             1e-3},
        Kind{"TrussedBoxes", [] { return verification::TrussedBoxes(8).model; },
             1e-2}),
    Name);

TEST(RestoreTest, RefusesWhatBelongsToAnotherModel) {
  const BuiltModel built = BuildModel(Tangle()).value();
  EnergyMomentumIntegrator integrator =
      EnergyMomentumIntegrator::Create(built.model, {.time_step = 1e-3})
          .value();
  State state = built.state;
  ASSERT_TRUE(integrator.Step(state).ok());
  std::vector<KeptTangent> kept = integrator.Keep();
  ASSERT_FALSE(kept.empty());
  ASSERT_GT(kept[0].matrix.size(), 0);
  EXPECT_TRUE(integrator.Restore(kept).ok());

  std::vector<KeptTangent> wrong = kept;
  wrong.emplace_back();
  EXPECT_FALSE(integrator.Restore(wrong).ok());
  wrong = kept;
  wrong.pop_back();
  EXPECT_FALSE(integrator.Restore(wrong).ok());
  wrong = kept;
  wrong[0].matrix.conservativeResize(kept[0].matrix.size() - 1);
  EXPECT_FALSE(integrator.Restore(wrong).ok());
  wrong = kept;
  wrong[0].positions.conservativeResize(3, 1);
  EXPECT_FALSE(integrator.Restore(wrong).ok());
  wrong = kept;
  wrong[0].matrix.setZero();  // Has no factors.
  EXPECT_FALSE(integrator.Restore(wrong).ok());
  // Having forgotten its factorisations it steps as from the start.
  EXPECT_TRUE(integrator.Step(state).ok());
}

}  // namespace
}  // namespace emmy
