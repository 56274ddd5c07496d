// One command of `emmy`: its options, and what it does.

#ifndef EMMY_TOOLS_CLI_COMMAND_H_
#define EMMY_TOOLS_CLI_COMMAND_H_

#include <CLI/CLI.hpp>
#include <functional>

#include "tools/cli/exit_status.h"

namespace emmy {

// Each command has a function `Command Add...Command(CLI::App& app)` in a file
// of its own, which declares the options; emmy_main.cc lists them all.
struct Command {
  CLI::App* options = nullptr;      // Owned by the program's CLI::App.
  std::function<ExitStatus()> run;  // Called after a successful parse.
};

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_COMMAND_H_
