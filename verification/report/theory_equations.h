// The equations of docs/theory.md, by tag, as that page writes them.
//
// The page is part of the program, so an equation has one home and a report
// cannot disagree with it.

#ifndef EMMY_VERIFICATION_REPORT_THEORY_EQUATIONS_H_
#define EMMY_VERIFICATION_REPORT_THEORY_EQUATIONS_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace emmy::verification {

// Equations of a page in which each is a quoted paragraph that ends in
// "— **(TAG-n)**": tag without parentheses to text without the tag.
std::map<std::string, std::string> ParseEquations(std::string_view page);

// Those of docs/theory.md.
const std::map<std::string, std::string>& TheoryEquations();

// Tags in a claim's `equations`, ranges written out, each once, in the order
// in which they appear: "(EM-1..3), (QS-1); paper (27)" has four.
std::vector<std::string> CitedTags(std::string_view text);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_THEORY_EQUATIONS_H_
