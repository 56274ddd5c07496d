// From a description to a model: the only place that validates.

#ifndef EMMY_MODEL_MODEL_BUILDER_H_
#define EMMY_MODEL_MODEL_BUILDER_H_

#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/model/model.h"
#include "emmy/model/model_description.h"
#include "emmy/model/state.h"

namespace emmy {

// What a description describes.
struct BuiltModel {
  Model model;  // What stays.
  State state;  // At time 0.
};

// Fails with kInvalidArgument at the first field at fault. The message begins
// with the field's JSON pointer and gives expectation, unit and value:
//   /rigid_bodies/0/box/density: must be a finite number > 0 [kg/m^3],
//   got -2700
EMMY_EXPORT absl::StatusOr<BuiltModel> BuildModel(
    const ModelDescription& description);

}  // namespace emmy

#endif  // EMMY_MODEL_MODEL_BUILDER_H_
