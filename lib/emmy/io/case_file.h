// Case files: from a path to a model that is ready to run.
//
// Every message has the form "<file>: <pointer>: must be <expectation>
// [<unit>], got <value>", with the file as the caller named it; syntax errors
// have "line L, column C" in place of the pointer.

#ifndef EMMY_IO_CASE_FILE_H_
#define EMMY_IO_CASE_FILE_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "emmy/base/export.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/io/case.h"
#include "emmy/model/model_builder.h"

namespace emmy {

// The case written in `text` (JSON, emmy-case/1), after replacing values by
// `overrides`, each "/json/pointer=value". Checks the structure only;
// BuildModel checks the rest. Messages begin with the JSON pointer.
EMMY_EXPORT absl::StatusOr<Case> ParseCase(
    absl::string_view text, const std::vector<std::string>& overrides = {});

// The same from a file; messages begin with `path`, and end in "(from --set)"
// if the place at fault was overridden.
EMMY_EXPORT absl::StatusOr<Case> ReadCaseFile(
    const std::string& path, const std::vector<std::string>& overrides = {});

// A case, and what is made of it.
struct LoadedCase {
  Case description;  // As read.
  Model model;       // As built from it.
  State state;       // At time 0.
};

// Builds the model of a case; energy and momentum at the start must be finite.
// Messages begin with the JSON pointer.
EMMY_EXPORT absl::StatusOr<LoadedCase> BuildCase(Case description);

// Reads the file and builds its model. What can be wrong with a case is
// reported here.
EMMY_EXPORT absl::StatusOr<LoadedCase> LoadCaseFile(
    const std::string& path, const std::vector<std::string>& overrides = {});

// The message of `status`, which begins with a JSON pointer, as the user of
// the file should see it: for checks that are made after loading.
EMMY_EXPORT absl::Status CaseFileError(
    const std::string& path, const std::vector<std::string>& overrides,
    const absl::Status& status);

}  // namespace emmy

#endif  // EMMY_IO_CASE_FILE_H_
