// Everything that changes from step to step.

#ifndef EMMY_MODEL_STATE_H_
#define EMMY_MODEL_STATE_H_

#include <cstdint>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/types.h"
#include "emmy/numerics/extrapolation.h"

namespace emmy {

// Layout: the Model's offsets. Positions are inertial: centre of mass and
// gradient vectors of an ANCF body [m, -]; centre of mass and quaternion
// (w, x, y, z) of a conventional body. Velocities are their rates, except the
// angular velocity of a conventional body, in body axes [rad/s].
struct State {
  int64_t step = 0;            // Steps taken since the start.
  CompensatedDouble time;      // [s]
  CompensatedVector position;  // Model::num_positions entries, as above.
  CompensatedVector velocity;  // Model::num_velocities entries, as above.
  CompensatedVector strain;    // Carried, never recomputed: (QS-1).
  // Velocities of elements' ends on conventional bodies [m/s]: advanced by
  // ½ (v₀ + v₁) = Δx/Δt like all others, but not linear in the body's.
  CompensatedVector end_velocity;
  CompensatedDouble load_work;  // Done by the loads since the start [J].

  // Velocity increments per second and joint forces [N] of the last steps: only
  // the start values of the next iteration, kept here so that a resumed run
  // repeats every bit.
  Extrapolation acceleration;  // One sequence a velocity [m/s², rad/s²].
  Extrapolation multiplier;    // Of Model::num_multipliers [N].
};

}  // namespace emmy

#endif  // EMMY_MODEL_STATE_H_
