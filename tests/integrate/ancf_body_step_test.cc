#include "emmy/integrate/ancf_body_step.h"

#include <gtest/gtest.h>

#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"

namespace emmy {
namespace {

// A box that stretches along its axes and does not turn: its moment is zero
// to the bit, and the strain alone says when the iteration ends. Solved again
// from its result, the step may change by the rounding of a strain increment,
// which a correction of 4 u |w| undoes (EM-5), once in each of the two, and by
// that of Δw itself.
TEST(AncfBodyStepTest, LeavesNothingButTheRoundingOfTheStrain) {
  RandomSource random(20261122);
  for (const double penalty : {1e6, 1e8, 1e10}) {
    const BuiltModel built =
        BuildModel(ModelOf(PaperBox(Formulation::kAncf, penalty))).value();
    const AncfRigidBody& body = *built.model.bodies()[0].ancf();
    const AncfBodyStep step(body, 0.01, NewtonOptions{});
    for (int i = 0; i < 100; ++i) {
      const AncfBodyStart start = {.gradients = Matrix3d::Identity(),
                                   .gradients_compensation = Matrix3d::Zero(),
                                   .rates = random.Vector(1.0).asDiagonal(),
                                   .rates_compensation = Matrix3d::Zero(),
                                   .strain = Vector6d::Zero(),
                                   .strain_compensation = Vector6d::Zero()};
      AncfBodyIncrement first;
      AncfBodyIncrement second;
      ASSERT_EQ(step.Solve(start, Matrix3d::Zero(), &first).termination,
                Termination::kConverged);
      ASSERT_EQ(step.Solve(start, first.rates, &second).termination,
                Termination::kConverged);
      const Matrix3d mean = start.rates + 0.5 * first.rates;
      EXPECT_LE((second.rates - first.rates).cwiseAbs().maxCoeff(),
                2.0 * kUnitRoundoff *
                    (4.0 * mean.cwiseAbs().maxCoeff() +
                     first.rates.cwiseAbs().maxCoeff()))
          << penalty << ", start " << i;
    }
  }
}

}  // namespace
}  // namespace emmy
