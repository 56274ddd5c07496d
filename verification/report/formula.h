// A formula written on one line, as docs/theory.md does, as HTML with MathML.

#ifndef EMMY_VERIFICATION_REPORT_FORMULA_H_
#define EMMY_VERIFICATION_REPORT_FORMULA_H_

#include <string>
#include <string_view>

namespace emmy::verification {

// Reads
//   ½ Mⁱʲ ėᵢ·ėⱼ   raised and lowered characters, accents, "½";
//   x_ground, x^(−1)   scripts that Unicode has not;
//   EA/L, (a + b)/(2 c)   fractions of what stands next to the stroke without
//                         a space; parentheses there are dropped;
//   √(…), |…|, (…), […], {…}   nested;
// words of three letters and more, and the short ones of English, as text.
// Outside of parentheses words stay outside of <math>, and an equals sign and
// a comma begin another <math>, so that a line may end there. Never fails: what
// it does not know it shows as an operator.
std::string FormulaHtml(std::string_view formula);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_FORMULA_H_
