// Ctrl-C ends a run after the current step instead of in the middle of a file.

#ifndef EMMY_TOOLS_CLI_INTERRUPT_H_
#define EMMY_TOOLS_CLI_INTERRUPT_H_

namespace emmy {

// From now on the first SIGINT or SIGTERM only sets a flag; a second one ends
// the program as usual.
void CatchInterrupts();

bool IsInterrupted();

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_INTERRUPT_H_
