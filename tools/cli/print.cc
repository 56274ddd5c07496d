#include "tools/cli/print.h"

#include <cstdio>

namespace emmy {

void Print(const std::string& text) {
  // Whether all was written is seen at the end of the program.
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
}

ExitStatus PrintError(const absl::Status& error, ExitStatus exit_status) {
  const std::string line = std::string(error.message()) + "\n";
  static_cast<void>(std::fflush(stdout));
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
  return exit_status;
}

}  // namespace emmy
