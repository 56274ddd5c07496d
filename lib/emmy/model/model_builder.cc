#include "emmy/model/model_builder.h"

#include "emmy/model/model_assembler.h"

namespace emmy {

absl::StatusOr<BuiltModel> BuildModel(const ModelDescription& description) {
  return ModelAssembler(description).Assemble();
}

}  // namespace emmy
