// Where the numbers of a free body lie in a state, for the steps in lanes.

#ifndef EMMY_INTEGRATE_BODY_NUMBERS_H_
#define EMMY_INTEGRATE_BODY_NUMBERS_H_

#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/extrapolation.h"

namespace emmy {

// What a step starts from; `low` are compensations. Position: x̄ [m], e₁, e₂, e₃
// [1], or x̄ and the quaternion, 12 or 7 numbers; velocity: their rates [m/s,
// 1/s], or that of x̄ and the angular velocity in body axes [rad/s], 12 or 6;
// next: extrapolated velocity increments per second, as many; strain: six of an
// ANCF body, of a conventional one not to be read.
struct BodyStartNumbers {
  BodyStartNumbers(const ModelBody& body, const State& state)
      : position(state.position.value.data() + body.position_offset),
        position_low(state.position.compensation.data() + body.position_offset),
        velocity(state.velocity.value.data() + body.velocity_offset),
        velocity_low(state.velocity.compensation.data() + body.velocity_offset),
        strain(state.strain.value.data() + body.strain_offset),
        strain_low(state.strain.compensation.data() + body.strain_offset),
        next(state.acceleration.next.data() + body.velocity_offset) {}

  const double* position;
  const double* position_low;
  const double* velocity;
  const double* velocity_low;
  const double* strain;
  const double* strain_low;
  const double* next;
};

// Of a body's centre of mass in a step, Δt g [m/s], and zero, of the same Δt as
// the step's other constants. Made once: a vector of
// numbers that were just written one by one has to wait until all of them are
// in the cache.
struct CentreIncrement {
  CentreIncrement(double time_step, const Vector3d& gravity)
      : value{time_step * gravity(0), time_step * gravity(1),
              time_step * gravity(2), 0.0} {}

  alignas(32) double value[4];
};

// What it advances.
struct BodyNumbers {
  BodyNumbers(const ModelBody& body, State& state)
      : position(state.position.value.data() + body.position_offset),
        position_low(state.position.compensation.data() + body.position_offset),
        velocity(state.velocity.value.data() + body.velocity_offset),
        velocity_low(state.velocity.compensation.data() + body.velocity_offset),
        strain(state.strain.value.data() + body.strain_offset),
        strain_low(state.strain.compensation.data() + body.strain_offset),
        next(state.acceleration.next.data() + body.velocity_offset) {
    for (int j = 0; j < Extrapolation::kOrders; ++j) {
      differences[j] = &state.acceleration.differences(body.velocity_offset, j);
    }
  }

  double* position;
  double* position_low;
  double* velocity;
  double* velocity_low;
  double* strain;
  double* strain_low;
  double* next;
  double* differences[Extrapolation::kOrders];
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BODY_NUMBERS_H_
