#include "verification/reference/project_directory.h"

#include <cstdlib>

namespace emmy::verification {

std::string ProjectDirectory() {
  const char* moved = std::getenv("EMMY_PROJECT_DIRECTORY");
  return moved != nullptr && *moved != '\0' ? moved : EMMY_PROJECT_DIRECTORY;
}

}  // namespace emmy::verification
