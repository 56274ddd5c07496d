#include "tools/cli/print.h"

#include <cstdio>

namespace emmy {

void Print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

ExitStatus PrintError(const absl::Status& error, ExitStatus exit_status) {
  const std::string line = std::string(error.message()) + "\n";
  std::fflush(stdout);
  std::fwrite(line.data(), 1, line.size(), stderr);
  return exit_status;
}

}  // namespace emmy
