#include "verification/report/formula_text.h"

#include <map>

namespace emmy::verification {
namespace {

using Characters = std::map<char32_t, char32_t>;

// The value of `key`, 0 if it has none.
char32_t Find(const Characters& map, char32_t key) {
  const auto found = map.find(key);
  return found == map.end() ? 0 : found->second;
}

struct Accented {
  char32_t letter = 0;
  char32_t accent = 0;
};

// Those a formula may contain; Unicode has many more.
const std::map<char32_t, Accented>& AccentedLetters() {
  static const auto* const letters = new std::map<char32_t, Accented>{
      {U'ė', {U'e', U'\u0307'}}, {U'ẋ', {U'x', U'\u0307'}},
      {U'ẏ', {U'y', U'\u0307'}}, {U'ż', {U'z', U'\u0307'}},
      {U'ṙ', {U'r', U'\u0307'}}, {U'ṗ', {U'p', U'\u0307'}},
      {U'Ṙ', {U'R', U'\u0307'}}, {U'Ẇ', {U'W', U'\u0307'}},
      {U'Ẋ', {U'X', U'\u0307'}}, {U'Ṗ', {U'P', U'\u0307'}},
      {U'ẍ', {U'x', U'\u0308'}}, {U'ā', {U'a', U'\u0304'}},
      {U'ē', {U'e', U'\u0304'}}, {U'ū', {U'u', U'\u0304'}},
      {U'ȳ', {U'y', U'\u0304'}}, {U'ê', {U'e', U'\u0302'}},
      {U'ŵ', {U'w', U'\u0302'}}, {U'û', {U'u', U'\u0302'}}};
  return *letters;
}

// The next code point of `text`, which is not empty; removes it.
char32_t Next(std::string_view* text) {
  const auto first = static_cast<unsigned char>(text->front());
  size_t size = 1;
  char32_t value = first;
  if (first >= 0xF0U) {
    size = 4;
    value = first & 0x07U;
  } else if (first >= 0xE0U) {
    size = 3;
    value = first & 0x0FU;
  } else if (first >= 0xC0U) {
    size = 2;
    value = first & 0x1FU;
  } else if (first >= 0x80U) {
    text->remove_prefix(1);
    return U'\uFFFD';
  }
  for (size_t i = 1; i < size; ++i) {
    const auto byte =
        i < text->size() ? static_cast<unsigned char>((*text)[i]) : 0U;
    if ((byte & 0xC0U) != 0x80U) {
      text->remove_prefix(i);
      return U'\uFFFD';
    }
    value = (value << 6U) | (byte & 0x3FU);
  }
  text->remove_prefix(size);
  return value;
}

}  // namespace

std::vector<char32_t> FormulaCharacters(std::string_view utf8) {
  std::vector<char32_t> characters;
  while (!utf8.empty()) {
    const char32_t character = Next(&utf8);
    const auto accented = AccentedLetters().find(character);
    if (accented == AccentedLetters().end()) {
      characters.push_back(character);
    } else {
      characters.push_back(accented->second.letter);
      characters.push_back(accented->second.accent);
    }
  }
  return characters;
}

std::string Utf8(char32_t character) {
  const auto byte = [](char32_t value) { return static_cast<char>(value); };
  if (character < 0x80) return {byte(character)};
  if (character < 0x800) {
    return {byte(0xC0U | (character >> 6U)), byte(0x80U | (character & 0x3FU))};
  }
  if (character < 0x10000) {
    return {byte(0xE0U | (character >> 12U)),
            byte(0x80U | ((character >> 6U) & 0x3FU)),
            byte(0x80U | (character & 0x3FU))};
  }
  return {byte(0xF0U | (character >> 18U)),
          byte(0x80U | ((character >> 12U) & 0x3FU)),
          byte(0x80U | ((character >> 6U) & 0x3FU)),
          byte(0x80U | (character & 0x3FU))};
}

char32_t RaisedCharacter(char32_t character) {
  static const auto& raised = *new Characters{
      {U'⁰', U'0'}, {U'¹', U'1'}, {U'²', U'2'}, {U'³', U'3'}, {U'⁴', U'4'},
      {U'⁵', U'5'}, {U'⁶', U'6'}, {U'⁷', U'7'}, {U'⁸', U'8'}, {U'⁹', U'9'},
      {U'⁺', U'+'}, {U'⁻', U'−'}, {U'⁽', U'('}, {U'⁾', U')'}, {U'ⁱ', U'i'},
      {U'ʲ', U'j'}, {U'ᵏ', U'k'}, {U'ˡ', U'l'}, {U'ᵐ', U'm'}, {U'ⁿ', U'n'},
      {U'ᵀ', U'T'}, {U'ᵃ', U'a'}, {U'ᵇ', U'b'}, {U'ᵗ', U't'}, {U'ˢ', U's'},
      {U'ᵖ', U'p'}, {U'′', U'′'}};
  return Find(raised, character);
}

char32_t LoweredCharacter(char32_t character) {
  static const auto& lowered = *new Characters{
      {U'₀', U'0'}, {U'₁', U'1'}, {U'₂', U'2'}, {U'₃', U'3'}, {U'₄', U'4'},
      {U'₅', U'5'}, {U'₆', U'6'}, {U'₇', U'7'}, {U'₈', U'8'}, {U'₉', U'9'},
      {U'₊', U'+'}, {U'₋', U'−'}, {U'ₐ', U'a'}, {U'ₑ', U'e'}, {U'ᵢ', U'i'},
      {U'ⱼ', U'j'}, {U'ₖ', U'k'}, {U'ₗ', U'l'}, {U'ₘ', U'm'}, {U'ₙ', U'n'},
      {U'ₚ', U'p'}, {U'ᵣ', U'r'}, {U'ₛ', U's'}, {U'ₜ', U't'}, {U'ᵤ', U'u'},
      {U'ᵥ', U'v'}, {U'ₓ', U'x'}};
  return Find(lowered, character);
}

std::string AccentMark(char32_t character) {
  switch (character) {
    case U'\u0302':
      return "^";
    case U'\u0303':
      return "~";
    case U'\u0304':
      return "¯";
    case U'\u0307':
      return "˙";
    case U'\u0308':
      return "¨";
    default:
      return "";
  }
}

bool IsDigit(char32_t character) {
  return character >= U'0' && character <= U'9';
}

bool IsLetter(char32_t character) {
  return (character >= U'a' && character <= U'z') ||
         (character >= U'A' && character <= U'Z') ||
         (character >= U'Α' && character <= U'ϵ') || character == U'∂' ||
         character == U'∞';
}

}  // namespace emmy::verification
