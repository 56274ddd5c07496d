#include "emmy/base/build_info.h"

// CMake refuses such flags where it sees them (CompileOptions.cmake).
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || \
    defined(__RECIPROCAL_MATH__) ||                            \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \
    "Emmy is compiled without -ffast-math, -Ofast and their parts: its \
conservation laws hold to round-off only if the compiler keeps \
floating-point semantics."
#endif

namespace emmy {

// The three macros come from lib/emmy/base/CMakeLists.txt.
BuildInfo GetBuildInfo() {
  return {.version = EMMY_BUILD_VERSION,
          .compiler = EMMY_BUILD_COMPILER,
          .flags = EMMY_BUILD_FLAGS};
}

}  // namespace emmy
