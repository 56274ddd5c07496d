// How this library was built: version, compiler, flags.
//
// Written into every summary, because rounding errors belong to a build and
// not only to a version.
#ifndef EMMY_BASE_BUILD_INFO_H_
#define EMMY_BASE_BUILD_INFO_H_

#include <string>

#include "emmy/base/export.h"

namespace emmy {

// What the last bits of a result may depend on.
struct BuildInfo {
  std::string version;   // Such as 0.1.0.
  std::string compiler;  // Such as GNU 12.2.0.
  std::string flags;     // Such as -O2 -DNDEBUG -ffp-contract=off.
};

// Of the library that the program is linked to.
EMMY_EXPORT BuildInfo GetBuildInfo();

}  // namespace emmy

#endif  // EMMY_BASE_BUILD_INFO_H_
