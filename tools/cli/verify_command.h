// emmy verify: measures what is claimed and says whether it holds.

#ifndef EMMY_TOOLS_CLI_VERIFY_COMMAND_H_
#define EMMY_TOOLS_CLI_VERIFY_COMMAND_H_

#include "tools/cli/command.h"

namespace emmy {

Command AddVerifyCommand(CLI::App& app);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_VERIFY_COMMAND_H_
