// Files of the project that are part of the program; CMakeLists.txt puts them
// there.

#ifndef EMMY_VERIFICATION_REPORT_EMBEDDED_H_
#define EMMY_VERIFICATION_REPORT_EMBEDDED_H_

#include <string_view>

namespace emmy::verification {

std::string_view EmbeddedStyle();   // style.css
std::string_view EmbeddedScript();  // script.js
std::string_view EmbeddedTheory();  // docs/theory.md

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_EMBEDDED_H_
