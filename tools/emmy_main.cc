// The program `emmy`: commands on case files. Each command is a file in
// tools/cli; what they share is the exit status (exit_status.h).

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "emmy/base/build_info.h"
#include "tools/cli/check_command.h"
#include "tools/cli/command.h"
#include "tools/cli/exit_status.h"
#include "tools/cli/generate_command.h"
#include "tools/cli/print.h"
#include "tools/cli/regenerate_command.h"
#include "tools/cli/run_command.h"
#include "tools/cli/verify_command.h"

namespace emmy {
namespace {

std::string VersionText() {
  const BuildInfo build = GetBuildInfo();
  return "emmy " + build.version + "\nbuilt with " + build.compiler + ", " +
         build.flags;
}

// What stands on standard error after a wrong command line.
std::string UsageError(const CLI::App* app, const CLI::Error& error) {
  std::string command = app->get_name();
  for (const CLI::App* chosen : app->get_subcommands()) {
    command += " " + chosen->get_name();
  }
  return command + ": " + error.what() + "\nRun " + command +
         " --help for what there is.\n";
}

int Main(int argc, char** argv) {
  CLI::App app("Emmy: rigid bodies and trusses by the energy-momentum method.",
               "emmy");
  app.set_version_flag("--version", VersionText());
  app.failure_message(UsageError);
  app.footer(R"(Examples:
  emmy check examples/paper_box.json             what the model is
  emmy run examples/paper_box.json               its summary, as JSON
  emmy run examples/paper_box.json --output out  also its motion, as CSV
  emmy run --help                                more on a command

Exit status: 0 done; 1 a check failed, the computation could not go on, or a
file or standard output not be written; 2 bad input or usage, nothing written;
3 stopped by Ctrl-C or SIGTERM.)");
  // The program's name is what a person types, not where this build put it.
  std::vector<std::string> command_line = {"emmy"};
  for (int i = 1; i < argc; ++i) command_line.emplace_back(argv[i]);
  const std::vector<Command> commands = {
      AddRunCommand(app), AddCheckCommand(app),
      AddVerifyCommand(app, command_line), AddRegenerateCommand(app),
      AddGenerateCommand(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitBadInput;
  }
  for (const Command& command : commands) {
    if (command.options->parsed()) return command.run();
  }
  return PrintError(absl::InvalidArgumentError("emmy: a command is required\n"
                                               "Run emmy --help for what "
                                               "there is."),
                    kExitBadInput);
}

// A standard stream that the caller has closed leaves its number to the next
// file that is opened, and messages would go into that. Instead it is there but
// of no use: writing to it, or reading from it, fails.
bool ReserveStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int useless = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    // The lowest number that is free.
    if (open("/dev/null", useless) != stream) return false;
  }
  return true;
}

// The exit status, once standard output has taken what was printed: a full
// disk is seen only when the buffer is emptied.
int Finish(int exit_status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_status;
  const ExitStatus lost =
      PrintError(absl::DataLossError("emmy: standard output could not be "
                                     "written; what was printed is lost"),
                 kExitFailed);
  return exit_status == kExitDone ? lost : exit_status;
}

}  // namespace
}  // namespace emmy

int main(int argc, char** argv) {
  if (!emmy::ReserveStreams()) return emmy::kExitFailed;
  // A file that may not grow further (`ulimit -f`) is one on a full disk.
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
  // A pipe whose reader is gone is a file that cannot be written. Not SIG_IGN,
  // which programs started from here, such as gnuplot, would inherit.
  static_cast<void>(std::signal(SIGPIPE, [](int /*signal*/) {}));
  try {
    return emmy::Finish(emmy::Main(argc, argv));
  } catch (const std::exception& error) {  // Such as: out of memory.
    return emmy::PrintError(
        absl::InternalError(std::string("internal error: ") + error.what()),
        emmy::kExitFailed);
  }
}
