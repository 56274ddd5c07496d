// Models of many free bodies, no two alike, for tests of BodyBatch.

#ifndef EMMY_TESTS_INTEGRATE_BATCH_RUN_H_
#define EMMY_TESTS_INTEGRATE_BATCH_RUN_H_

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "emmy/diagnostics/invariants.h"
#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/body_batch.h"
#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "verification/models/body_state.h"

namespace emmy {

// `count` boxes of several sizes, speeds and attitudes. `penalty` [Pa]; 0: one
// of 1e6 … 1e14 for each body.
inline ModelDescription MixedBodies(int count, Formulation formulation,
                                    double penalty = 0.0,
                                    Start start = Start::kUndeformed) {
  RandomSource random(20250321);
  ModelDescription description;
  for (int i = 0; i < count; ++i) {
    const double alpha =
        penalty > 0.0 ? penalty : std::pow(10.0, 6 + 2 * (i % 5));
    RigidBodyDescription body = PaperBox(formulation, alpha);
    body.name = "body_" + std::to_string(i);
    body.inertia =
        BoxInertia{.size = Vector3d(3.0, 2.0, 1.0) + random.Vector(0.5),
                   .density = 2700.0};
    body.orientation = RotationVector{random.Vector(1.0)};
    body.position = random.Vector(1.0);
    body.velocity = random.Vector(0.3);
    body.angular_velocity = random.Vector(1.0);
    if (formulation == Formulation::kAncf) body.start = start;
    description.rigid_bodies.push_back(body);
  }
  return description;
}

// Both kinds, and one of each whose body axes are not principal ones.
inline ModelDescription AllKinds() {
  ModelDescription description = MixedBodies(19, Formulation::kAncf);
  for (RigidBodyDescription& body :
       MixedBodies(kBatchLanes + 3, Formulation::kConventional).rigid_bodies) {
    body.name = "conventional_" + body.name;
    description.rigid_bodies.push_back(std::move(body));
  }
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    RigidBodyDescription tilted = PaperBox(formulation);
    tilted.name = formulation == Formulation::kAncf ? "tilted_ancf" : "tilted";
    Matrix3d tensor;
    tensor << 3000.0, 200.0, -100.0,  //
        200.0, 4000.0, 300.0,         //
        -100.0, 300.0, 5000.0;
    tilted.inertia =
        TensorInertia{.mass = 1000.0, .tensor = tensor, .volume = 0.5};
    description.rigid_bodies.push_back(tilted);
  }
  return description;
}

inline BodyBatch MakeBatch(const BuiltModel& built,
                           const BodyBatchOptions& options) {
  BodyBatch batch = BodyBatch::Create(built.model, options).value();
  batch.Load(built.state);
  return batch;
}

// The state after `num_steps` steps in calls of `steps_per_call` each.
inline State StateAfter(const BuiltModel& built, int num_steps,
                        const BodyBatchOptions& options,
                        int steps_per_call = 0) {
  BodyBatch batch = MakeBatch(built, options);
  const int call = steps_per_call > 0 ? steps_per_call : num_steps;
  for (int i = 0; i < num_steps; i += call) {
    const BatchReport report = batch.Step(call);
    for (const BatchFailure& failure : report.failures) {
      ADD_FAILURE() << failure.message;
    }
  }
  State state = built.state;
  batch.Store(&state);
  return state;
}

inline DoubleDouble EnergyOfBody(const ModelDescription& description,
                                 const BuiltModel& all, size_t index,
                                 const State& state) {
  BuiltModel alone =
      BuildModel(ModelOf(description.rigid_bodies[index])).value();
  verification::CopyBody(all.model.bodies()[index], state, &alone.state);
  return MeasureInvariants(alone.model, alone.state).TotalEnergy();
}

}  // namespace emmy

#endif  // EMMY_TESTS_INTEGRATE_BATCH_RUN_H_
