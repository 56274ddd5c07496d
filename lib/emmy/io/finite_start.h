// What of a case makes energy or momentum at the start overflow.

#ifndef EMMY_IO_FINITE_START_H_
#define EMMY_IO_FINITE_START_H_

#include "absl/status/status.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model.h"
#include "emmy/model/model_description.h"
#include "emmy/model/state.h"

namespace emmy {

// Fails with kInvalidArgument unless energy, momentum and angular momentum of
// `state`, the start of `model`, are finite numbers. The message names the
// first field that by itself, or with those before it, is too large.
absl::Status CheckFiniteStart(const ModelDescription& description,
                              const Model& model, const State& state);

}  // namespace emmy

#endif  // EMMY_IO_FINITE_START_H_
