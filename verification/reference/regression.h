// Runs whose numbers are stored, to show when they change.

#ifndef EMMY_VERIFICATION_REFERENCE_REGRESSION_H_
#define EMMY_VERIFICATION_REFERENCE_REGRESSION_H_

#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "verification/reference/reference_table.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

struct RegressionRun {
  std::string name;  // Stored as reference_data/regression/<name>.json.
  std::function<absl::StatusOr<ReferenceTable>(const Scheme&)> compute;
};

const std::vector<RegressionRun>& RegressionRuns();

// <root>/reference_data/regression/<name>.json
std::string RegressionPath(const std::string& root, const std::string& name);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_REGRESSION_H_
