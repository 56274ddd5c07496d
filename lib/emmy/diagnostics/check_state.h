// Whether a state may count as a result.

#ifndef EMMY_DIAGNOSTICS_CHECK_STATE_H_
#define EMMY_DIAGNOSTICS_CHECK_STATE_H_

#include "absl/status/status.h"
#include "emmy/base/export.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// Fails with the reason
//   where energy, momentum or angular momentum is not finite, or
//   where an ANCF body has turned inside out, det [e₁ e₂ e₃] <= 0: its strain
//   energy knows no difference between a frame and its mirror image, so that a
//   penalty too soft for the step lets it through; such a body has no attitude.
// `invariants` are those of `state`. A step does not look for this itself, a
// WatchedRun does.
EMMY_EXPORT absl::Status CheckState(const Model& model, const State& state,
                                    const Invariants& invariants);

}  // namespace emmy

#endif  // EMMY_DIAGNOSTICS_CHECK_STATE_H_
