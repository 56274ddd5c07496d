// One value of a JSON document replaced from outside: what `emmy run --set
// /integrator/time_step=1e-4` does before the case is read.

#ifndef EMMY_IO_JSON_OVERRIDE_H_
#define EMMY_IO_JSON_OVERRIDE_H_

#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace emmy {

struct JsonOverride {
  nlohmann::json::json_pointer pointer;
  nlohmann::json value;
};

// "/json/pointer=value". The value is JSON, or else a string: names need no
// quotation marks. Fails with kInvalidArgument.
absl::StatusOr<JsonOverride> ParseOverride(absl::string_view setting);

// Puts the value at its place. Array elements must exist; a key that does not
// is added, since most keys are optional, and reading the document decides
// whether it is allowed.
absl::Status ApplyOverride(const JsonOverride& change, nlohmann::json* root);

}  // namespace emmy

#endif  // EMMY_IO_JSON_OVERRIDE_H_
