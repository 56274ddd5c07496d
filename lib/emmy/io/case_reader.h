// A case from its JSON value.
//
// Checks the structure: keys, types, lengths, names of choices; and the ranges
// of what is not part of the model. Everything about the model itself is
// checked in one place, BuildModel.

#ifndef EMMY_IO_CASE_READER_H_
#define EMMY_IO_CASE_READER_H_

#include <nlohmann/json.hpp>

#include "absl/status/statusor.h"
#include "emmy/io/case.h"

namespace emmy {

inline constexpr char kCaseFormat[] = "emmy-case/1";

// Fails with kInvalidArgument, "/pointer: must be ..., got ...".
absl::StatusOr<Case> CaseFromJson(const nlohmann::json& json);

}  // namespace emmy

#endif  // EMMY_IO_CASE_READER_H_
