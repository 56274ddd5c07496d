// Whether text is well-formed markup: XML, or HTML that closes its elements.

#ifndef EMMY_TESTS_SUPPORT_WELL_FORMED_H_
#define EMMY_TESTS_SUPPORT_WELL_FORMED_H_

#include <string>

namespace emmy {

// The first problem with its place, "" if there is none. Looks at nesting,
// attributes (quoted, each once), references ("&lt;", "&#39;") and stray "<";
// knows HTML's empty elements, and does not read what is in <script> and
// <style>. Comments and CDATA are problems: nobody here writes them.
std::string ProblemInMarkup(const std::string& text);

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_WELL_FORMED_H_
