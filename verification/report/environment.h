// Where and how a report was made.

#ifndef EMMY_VERIFICATION_REPORT_ENVIRONMENT_H_
#define EMMY_VERIFICATION_REPORT_ENVIRONMENT_H_

#include <string>
#include <vector>

#include "emmy/base/build_info.h"

namespace emmy::verification {

struct Environment {
  BuildInfo build;
  std::string processor;      // "unknown" where the system does not say.
  std::string system;         // Distribution, kernel and machine type.
  int threads = 1;            // Claims measured at the same time.
  std::string date;           // "2024-02-29T12:00:00Z", UTC, when it began.
  std::string command;        // As a shell reads it again.
  double wall_seconds = 0.0;  // All claims together.
};

// Everything but `threads` and `wall_seconds`, now and on this machine.
// `command_line` is the program's: its name and arguments.
Environment DescribeEnvironment(const std::vector<std::string>& command_line);

// The command line as a shell reads it again: words with other characters
// than letters, digits and _-./=:,+@% are quoted.
std::string ShellCommand(const std::vector<std::string>& words);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_ENVIRONMENT_H_
