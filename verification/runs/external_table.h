// Motions that others have published, as tables over time:
// reference_data/external/<name>.json.

#ifndef EMMY_VERIFICATION_RUNS_EXTERNAL_TABLE_H_
#define EMMY_VERIFICATION_RUNS_EXTERNAL_TABLE_H_

#include <string>

#include "absl/status/statusor.h"
#include "emmy/base/types.h"
#include "emmy/model/model_description.h"

namespace emmy::verification {

struct ExternalTable {
  VectorXd time;    // [s]
  MatrixXd values;  // One row a time; columns and units as in the file.
};

absl::StatusOr<ExternalTable> ReadExternalTable(const std::string& name);

// The model of examples/<name>.json.
absl::StatusOr<ModelDescription> ReadExample(const std::string& name);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_EXTERNAL_TABLE_H_
