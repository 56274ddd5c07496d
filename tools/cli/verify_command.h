// emmy verify: measures what is claimed and says whether it holds.

#ifndef EMMY_TOOLS_CLI_VERIFY_COMMAND_H_
#define EMMY_TOOLS_CLI_VERIFY_COMMAND_H_

#include <string>
#include <vector>

#include "tools/cli/command.h"

namespace emmy {

// The report tells `command_line`, the program's name and its arguments.
Command AddVerifyCommand(CLI::App& app,
                         const std::vector<std::string>& command_line);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_VERIFY_COMMAND_H_
