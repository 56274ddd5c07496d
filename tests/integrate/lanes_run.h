// What the tests of the steps in lanes share.

#ifndef EMMY_TESTS_INTEGRATE_LANES_RUN_H_
#define EMMY_TESTS_INTEGRATE_LANES_RUN_H_

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

#include "tests/support/instruction_sets.h"
#include "tests/support/paper_box.h"
#include "tests/support/test_run.h"

namespace emmy {

// Two boxes, so that a body has neighbours on both sides or none.
inline ModelDescription TwoBoxes(Formulation formulation,
                                 double penalty = 1e10) {
  ModelDescription model = ModelOf(PaperBox(formulation, penalty));
  RigidBodyDescription other = PaperBox(formulation, penalty);
  other.name = "other";
  other.position = {100.0, -20.0, 3.0};
  other.velocity = {1.0, -2.0, 0.5};
  other.angular_velocity = {-0.7, 0.2, 0.4};
  model.rigid_bodies.push_back(other);
  model.gravity = {0.1, 0.2, -9.81};
  return model;
}

class LanesTest : public InstructionSetTest {
 protected:
  static void ExpectSameBitsWithEveryInstructionSet(
      const ModelDescription& model, double time_step, int64_t num_steps) {
    TestRun reference(model, time_step);
    ASSERT_TRUE(reference.Advance(num_steps));
    for (const int64_t target : InstructionSets()) {
      ChooseInstructionSet(target);
      TestRun run(model, time_step);
      ASSERT_TRUE(run.Advance(num_steps));
      EXPECT_TRUE(SameState(run.state(), reference.state()))
          << hwy::TargetName(target);
    }
  }
};

}  // namespace emmy

#endif  // EMMY_TESTS_INTEGRATE_LANES_RUN_H_
