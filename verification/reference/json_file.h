// JSON files of the project: reference data and what others have published.

#ifndef EMMY_VERIFICATION_REFERENCE_JSON_FILE_H_
#define EMMY_VERIFICATION_REFERENCE_JSON_FILE_H_

#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"

namespace emmy::verification {

// Fails with kNotFound if the file cannot be read, with kDataLoss if it is not
// JSON. Messages begin with `path`.
absl::StatusOr<nlohmann::json> ReadJsonFile(const std::string& path);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_JSON_FILE_H_
