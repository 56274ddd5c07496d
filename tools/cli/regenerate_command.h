// emmy regenerate: writes the project's computed files anew.

#ifndef EMMY_TOOLS_CLI_REGENERATE_COMMAND_H_
#define EMMY_TOOLS_CLI_REGENERATE_COMMAND_H_

#include "tools/cli/command.h"

namespace emmy {

Command AddRegenerateCommand(CLI::App& app);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_REGENERATE_COMMAND_H_
