// `emmy generate`: case files of large models.

#ifndef EMMY_TOOLS_CLI_GENERATE_COMMAND_H_
#define EMMY_TOOLS_CLI_GENERATE_COMMAND_H_

#include "tools/cli/command.h"

namespace emmy {

Command AddGenerateCommand(CLI::App& app);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_GENERATE_COMMAND_H_
