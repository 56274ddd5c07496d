// What `emmy` returns to the shell, whatever the command.

#ifndef EMMY_TOOLS_CLI_EXIT_STATUS_H_
#define EMMY_TOOLS_CLI_EXIT_STATUS_H_

namespace emmy {

enum ExitStatus : int {
  kExitDone = 0,
  kExitFailed = 1,       // A check failed or the computation could not go on.
  kExitBadInput = 2,     // Bad input or usage; nothing was written.
  kExitInterrupted = 3,  // Stopped by SIGINT or SIGTERM, after a whole step.
};

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_EXIT_STATUS_H_
