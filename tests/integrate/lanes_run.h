// What the tests of the steps in lanes share.

#ifndef EMMY_TESTS_INTEGRATE_LANES_RUN_H_
#define EMMY_TESTS_INTEGRATE_LANES_RUN_H_

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <functional>

#include "emmy/base/compensated_sum.h"
#include "emmy/integrate/body_numbers.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
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

  // In one call as in two, with every instruction set. `element`: ancf() or
  // conventional() of a body.
  template <typename LanesType, typename IncrementType, typename Element>
  static void ExpectOneCallIsTwo(const ModelDescription& model,
                                 double time_step,
                                 const Element* (ModelBody::*element)() const) {
    TestRun run(model, time_step);
    ASSERT_TRUE(run.Advance(7));
    const CentreIncrement centre(time_step, run.model().gravity());
    for (const int64_t target : InstructionSets()) {
      ChooseInstructionSet(target);
      State once = run.state();
      State twice = run.state();
      for (const ModelBody& body : run.model().bodies()) {
        const LanesType lanes(*(body.*element)(), time_step, {});
        IncrementType increment;
        const BodyStepResult solved =
            SolveInLanes(lanes, body, twice, &increment);
        CommitInLanes(increment, time_step, centre, body, twice);
        const BodyStepResult advanced =
            AdvanceInLanes(lanes, centre, body, once);
        EXPECT_EQ(advanced.termination, Termination::kConverged);
        EXPECT_EQ(advanced.iterations, solved.iterations);
        EXPECT_EQ(advanced.correction, solved.correction);
      }
      EXPECT_TRUE(SameState(once, twice)) << hwy::TargetName(target);
    }
  }

  // From the start of the first body, after `spoil` has changed the state.
  template <typename LanesType, typename IncrementType, typename Element>
  static void ExpectNotConverged(const ModelDescription& model,
                                 double time_step,
                                 const Element* (ModelBody::*element)() const,
                                 const std::function<void(State&)>& spoil) {
    TestRun run(model, time_step);
    const ModelBody& body = run.model().bodies()[0];
    State state = run.state();
    spoil(state);
    IncrementType increment;
    const LanesType lanes(*(body.*element)(), time_step, {});
    EXPECT_NE(SolveInLanes(lanes, body, state, &increment).termination,
              Termination::kConverged);
  }

  // Moves the centre of a body as CommitInLanes does, by the plain loops of
  // CompensatedVector.
  static void AddCentre(const ModelBody& body, double time_step,
                        const Vector3d& gravity, State& state) {
    const Eigen::Index q = body.position_offset;
    const Eigen::Index w = body.velocity_offset;
    const Vector3d change = time_step * gravity;
    for (int i = 0; i < 3; ++i) {
      const double mean =
          state.velocity.value(w + i) +
          (state.velocity.compensation(w + i) + 0.5 * change(i));
      const SumAndError product = TwoProduct(time_step, mean);
      AddCompensated(product.sum, product.error, state.position.value(q + i),
                     state.position.compensation(q + i));
    }
    state.velocity.Add(w, change);
  }

  // What does not converge leaves the state, in one call too.
  template <typename LanesType, typename Element>
  static void ExpectFailureLeavesTheState(const ModelDescription& model,
                                          double time_step,
                                          const Element* (ModelBody::*element)()
                                              const) {
    TestRun run(model, time_step);
    const ModelBody& body = run.model().bodies()[0];
    State state = run.state();
    state.velocity.value(body.velocity_offset + 4) = 1e300;
    State after = state;
    const LanesType lanes(*(body.*element)(), time_step, {});
    const CentreIncrement centre(time_step, Vector3d::Zero());
    EXPECT_NE(AdvanceInLanes(lanes, centre, body, after).termination,
              Termination::kConverged);
    EXPECT_TRUE(SameState(after, state));
  }

  // A model of one body takes a way of its own.
  static void ExpectABodyAloneMovesAsInCompany(const ModelDescription& both,
                                               double time_step,
                                               int64_t num_steps) {
    ModelDescription one = both;
    one.rigid_bodies.pop_back();
    TestRun together(both, time_step);
    TestRun alone(one, time_step);
    ASSERT_TRUE(together.Advance(num_steps));
    ASSERT_TRUE(alone.Advance(num_steps));
    const Eigen::Index q = alone.state().position.value.size();
    const Eigen::Index w = alone.state().velocity.value.size();
    EXPECT_EQ(alone.state().position.value,
              together.state().position.value.head(q));
    EXPECT_EQ(alone.state().position.compensation,
              together.state().position.compensation.head(q));
    EXPECT_EQ(alone.state().velocity.value,
              together.state().velocity.value.head(w));
    EXPECT_EQ(alone.state().velocity.compensation,
              together.state().velocity.compensation.head(w));
  }
};

}  // namespace emmy

#endif  // EMMY_TESTS_INTEGRATE_LANES_RUN_H_
