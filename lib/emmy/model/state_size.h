// How many numbers a state holds: a model and its state have the same.

#ifndef EMMY_MODEL_STATE_SIZE_H_
#define EMMY_MODEL_STATE_SIZE_H_

#include <ostream>

#include "emmy/base/types.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

struct StateSize {
  Eigen::Index position = 0;
  Eigen::Index velocity = 0;
  Eigen::Index strain = 0;
  Eigen::Index end_velocity = 0;

  friend bool operator==(const StateSize&, const StateSize&) = default;
  friend std::ostream& operator<<(std::ostream& os, const StateSize& size) {
    return os << size.position << " positions, " << size.velocity
              << " velocities, " << size.strain << " strains, "
              << size.end_velocity << " velocities of ends";
  }
};

inline StateSize SizeOf(const Model& model) {
  return {.position = model.num_positions(),
          .velocity = model.num_velocities(),
          .strain = model.num_strains(),
          .end_velocity = model.num_end_velocities()};
}

inline StateSize SizeOf(const State& state) {
  return {.position = state.position.value.size(),
          .velocity = state.velocity.value.size(),
          .strain = state.strain.value.size(),
          .end_velocity = state.end_velocity.value.size()};
}

}  // namespace emmy

#endif  // EMMY_MODEL_STATE_SIZE_H_
