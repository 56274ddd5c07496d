// Where the numbers of a free body lie in a state, for the steps in lanes.

#ifndef EMMY_INTEGRATE_BODY_NUMBERS_H_
#define EMMY_INTEGRATE_BODY_NUMBERS_H_

#include <type_traits>

#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/extrapolation.h"

namespace emmy {

// What a step starts from, or advances: `Number` is const double or double.
// `low` are compensations. Position: x̄ [m], e₁, e₂, e₃ [1], or x̄ and the
// quaternion, 12 or 7 numbers; velocity: their rates [m/s, 1/s], or that of x̄
// and the angular velocity in body axes [rad/s], 12 or 6; next: extrapolated
// velocity increments per second, as many; strain: six of an ANCF body, of a
// conventional one not to be read.
template <typename Number>
struct BodyNumbersOf {
  using StateOfNumbers =
      std::conditional_t<std::is_const_v<Number>, const State, State>;

  BodyNumbersOf(const ModelBody& body, StateOfNumbers& state)
      : position(state.position.value.data() + body.position_offset),
        position_low(state.position.compensation.data() + body.position_offset),
        velocity(state.velocity.value.data() + body.velocity_offset),
        velocity_low(state.velocity.compensation.data() + body.velocity_offset),
        strain(state.strain.value.data() + body.strain_offset),
        strain_low(state.strain.compensation.data() + body.strain_offset),
        next(state.acceleration.next.data() + body.velocity_offset) {}

  Number* position;
  Number* position_low;
  Number* velocity;
  Number* velocity_low;
  Number* strain;
  Number* strain_low;
  Number* next;
};

using BodyStartNumbers = BodyNumbersOf<const double>;

// As BodyNumbersOf, of a state that is written, with the differences of
// velocities for the next start.
struct BodyNumbers : BodyNumbersOf<double> {
  BodyNumbers(const ModelBody& body, State& state)
      : BodyNumbersOf(body, state) {
    for (int j = 0; j < Extrapolation::kOrders; ++j) {
      differences[j] = &state.acceleration.differences(body.velocity_offset, j);
    }
  }

  double* differences[Extrapolation::kOrders];
};

// Of a body's centre of mass in a step, Δt g [m/s], and zero, of the same Δt as
// the step's other constants. Made once: a vector of numbers that were just
// written one by one has to wait until all of them are in the cache.
struct CentreIncrement {
  CentreIncrement(double time_step, const Vector3d& gravity)
      : value{time_step * gravity(0), time_step * gravity(1),
              time_step * gravity(2), 0.0} {}

  alignas(32) double value[4];
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BODY_NUMBERS_H_
