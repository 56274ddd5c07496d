// How many numbers a state holds: a model and its state have the same.

#ifndef EMMY_MODEL_STATE_SIZE_H_
#define EMMY_MODEL_STATE_SIZE_H_

#include <ostream>

#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// Entries of the vectors of a State.
struct StateSize {
  Eigen::Index position = 0;      // Of State::position,
  Eigen::Index velocity = 0;      // State::velocity,
  Eigen::Index strain = 0;        // State::strain
  Eigen::Index end_velocity = 0;  // and State::end_velocity.

  // Whether all are the same.
  friend bool operator==(const StateSize&, const StateSize&) = default;
  // For messages.
  friend std::ostream& operator<<(std::ostream& os, const StateSize& size) {
    return os << size.position << " positions, " << size.velocity
              << " velocities, " << size.strain << " strains, "
              << size.end_velocity << " velocities of ends";
  }
};

// What a state of `model` has.
inline StateSize SizeOf(const Model& model) {
  return {.position = model.num_positions(),
          .velocity = model.num_velocities(),
          .strain = model.num_strains(),
          .end_velocity = model.num_end_velocities()};
}

// What `state` has.
inline StateSize SizeOf(const State& state) {
  return {.position = state.position.value.size(),
          .velocity = state.velocity.value.size(),
          .strain = state.strain.value.size(),
          .end_velocity = state.end_velocity.value.size()};
}

}  // namespace emmy

#endif  // EMMY_MODEL_STATE_SIZE_H_
