#include "emmy/base/build_info.h"

namespace emmy {

// The three macros come from lib/emmy/base/CMakeLists.txt.
BuildInfo GetBuildInfo() {
  return {.version = EMMY_BUILD_VERSION,
          .compiler = EMMY_BUILD_COMPILER,
          .flags = EMMY_BUILD_FLAGS};
}

}  // namespace emmy
