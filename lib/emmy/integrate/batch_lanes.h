// One lane of a block: to and from the model's state, and its step by the
// ordinary step of one body.

#ifndef EMMY_INTEGRATE_BATCH_LANES_H_
#define EMMY_INTEGRATE_BATCH_LANES_H_

#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// The constants of a body, which is in principal axes, and of a step.
void SetConstants(const AncfRigidBody& body, double time_step, int lane,
                  AncfBlock* block);
void SetConstants(const ConventionalRigidBody& body, double time_step, int lane,
                  ConventionalBlock* block);

void LoadLane(const ModelBody& body, const State& state, int lane,
              AncfBlock* block);
void LoadLane(const ModelBody& body, const State& state, int lane,
              ConventionalBlock* block);

void StoreLane(const AncfBlock& block, int lane, const ModelBody& body,
               State* state);
void StoreLane(const ConventionalBlock& block, int lane, const ModelBody& body,
               State* state);

// Leaves the lane as it is unless the result is kConverged.
BodyStepResult TakeOrdinaryStep(const AncfBodyStep& body_step,
                                const BatchStep& step, int lane,
                                AncfBlock* block);
BodyStepResult TakeOrdinaryStep(const ConventionalBodyStep& body_step,
                                const BatchStep& step, int lane,
                                ConventionalBlock* block);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BATCH_LANES_H_
