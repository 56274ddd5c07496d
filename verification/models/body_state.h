// One body of a model, as a model of this body alone has it.

#ifndef EMMY_VERIFICATION_MODELS_BODY_STATE_H_
#define EMMY_VERIFICATION_MODELS_BODY_STATE_H_

#include "emmy/base/compensated_sum.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy::verification {

// The part of `body` in `state`, as the state of a model of this body alone.
inline void CopyBody(const ModelBody& body, const State& state, State* alone) {
  const auto copy = [](const CompensatedVector& from, Eigen::Index offset,
                       CompensatedVector* to) {
    to->value = from.value.segment(offset, to->value.size());
    to->compensation =
        from.compensation.segment(offset, to->compensation.size());
  };
  copy(state.position, body.position_offset, &alone->position);
  copy(state.velocity, body.velocity_offset, &alone->velocity);
  if (alone->strain.value.size() == 0) return;
  copy(state.strain, body.strain_offset, &alone->strain);
}

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_MODELS_BODY_STATE_H_
