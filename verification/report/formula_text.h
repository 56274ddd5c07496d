// The characters of a formula: which are letters, scripts and accents.
//
// Internal to formula.cc.

#ifndef EMMY_VERIFICATION_REPORT_FORMULA_TEXT_H_
#define EMMY_VERIFICATION_REPORT_FORMULA_TEXT_H_

#include <string>
#include <string_view>
#include <vector>

namespace emmy::verification {

// Code points of `utf8`; a letter with an accent that Unicode has as one
// character becomes the letter followed by the combining accent. Bytes that
// are no UTF-8 become U+FFFD.
std::vector<char32_t> FormulaCharacters(std::string_view utf8);

std::string Utf8(char32_t character);

// The character that a raised or lowered one shows: '2' for '²'; 0 if
// `character` is not one.
char32_t RaisedCharacter(char32_t character);
char32_t LoweredCharacter(char32_t character);

// What MathML draws for a combining accent, "" if it is none.
std::string AccentMark(char32_t character);

bool IsLetter(char32_t character);  // Latin or Greek.
bool IsDigit(char32_t character);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_FORMULA_TEXT_H_
