#include "emmy/base/check.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace emmy {

void FailCheck(const char* file, int line, const char* condition,
               const std::string& values) {
  static_cast<void>(std::fprintf(stderr,
                                 "%s:%d: check failed: %s; values: %s\n", file,
                                 line, condition, values.c_str()));
  std::abort();
}

}  // namespace emmy
