// Text to the two output streams of the program.

#ifndef EMMY_TOOLS_CLI_PRINT_H_
#define EMMY_TOOLS_CLI_PRINT_H_

#include <string>

#include "absl/status/status.h"
#include "tools/cli/exit_status.h"

namespace emmy {

// Results, to standard output.
void Print(const std::string& text);

// The message of `error` as a line on standard error; returns `exit_status`.
ExitStatus PrintError(const absl::Status& error, ExitStatus exit_status);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_PRINT_H_
