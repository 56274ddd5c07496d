// emmy check CASE.json: reads a case and says what it is, without running it.

#ifndef EMMY_TOOLS_CLI_CHECK_COMMAND_H_
#define EMMY_TOOLS_CLI_CHECK_COMMAND_H_

#include "tools/cli/command.h"

namespace emmy {

Command AddCheckCommand(CLI::App& app);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_CHECK_COMMAND_H_
