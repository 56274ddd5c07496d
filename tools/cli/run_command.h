// emmy run CASE.json: computes the motion of a case.

#ifndef EMMY_TOOLS_CLI_RUN_COMMAND_H_
#define EMMY_TOOLS_CLI_RUN_COMMAND_H_

#include "tools/cli/command.h"

namespace emmy {

Command AddRunCommand(CLI::App& app);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_RUN_COMMAND_H_
