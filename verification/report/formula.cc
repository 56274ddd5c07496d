#include "verification/report/formula.h"

#include <set>
#include <vector>

#include "absl/strings/str_cat.h"
#include "verification/report/formula_text.h"
#include "verification/report/html_text.h"

namespace emmy::verification {
namespace {

std::string Element(const char* name, const std::string& content) {
  return absl::StrCat("<", name, ">", content, "</", name, ">");
}

bool IsFunction(const std::string& word) {
  static const auto& functions = *new std::set<std::string>{
      "sin",   "cos",   "tan",  "atan", "exp", "log",    "cay",
      "Pa",    "tr",    "diag", "sign", "sn",  "cn",     "dn",
      "axial", "Axial", "Hat",  "max",  "min", "TwoSum", "TwoProduct"};
  return functions.count(word) > 0;
}

bool IsEnglish(const std::string& word) {
  static const auto& short_words =
      *new std::set<std::string>{"as", "at", "by", "if", "in", "is", "it", "no",
                                 "of", "on", "or", "so", "to", "up", "we"};
  return !IsFunction(word) && (word.size() >= 3 || short_words.count(word) > 0);
}

bool IsAscii(char32_t c) { return c < 0x80 && IsLetter(c); }

class Formula {
 public:
  explicit Formula(std::string_view text)
      : characters_(FormulaCharacters(text)) {}

  std::string Html() {
    while (!AtEnd()) {
      if (const std::string word = EnglishWord(); !word.empty()) {
        Flush();
        AddText(EscapeHtml(word) + " ");
      } else if (const std::string tag = Tag(); !tag.empty()) {
        Flush();
        AddText(tag + " ");
      } else if (Peek() == U'(' && math_.empty() && BeginsEnglish(1)) {
        ++at_;
        AddText("(");
      } else if (Peek() == U')') {
        Flush();
        TrimSpace();
        ++at_;
        html_ += ") ";
      } else if (Peek() == U' ') {
        const std::string space = Space();
        if (!math_.empty()) math_ += space;
      } else if (Peek() == U',' || Peek() == U';' || Peek() == U':') {
        Flush();
        TrimSpace();
        absl::StrAppend(&html_, Utf8(Peek()), " ");
        ++at_;
      } else if (Peek() == U'=' && !math_.empty()) {
        Flush();
        html_ += ' ';
        // The space before it is the line's, the one after it stays.
        math_ = "<mo lspace=\"0\">=</mo>";
        ++at_;
      } else {
        math_ += Term();
      }
    }
    Flush();
    TrimSpace();
    return html_;
  }

 private:
  bool AtEnd() const { return at_ >= characters_.size(); }
  char32_t Peek(size_t ahead = 0) const {
    return at_ + ahead < characters_.size() ? characters_[at_ + ahead] : 0;
  }

  void AddText(const std::string& text) {
    const bool space =
        html_.empty() || html_.back() == ' ' || html_.back() == '(';
    absl::StrAppend(&html_, space ? "" : " ", text);
  }

  void TrimSpace() {
    while (!html_.empty() && html_.back() == ' ') html_.pop_back();
  }

  // Takes a space; between two factors it is shown.
  std::string Space() {
    ++at_;
    const bool after = at_ >= 2 && EndsOperand(characters_[at_ - 2]);
    const bool before = StartsOperand(Peek()) || Peek() == U'|';
    if (!after || !before || BeginsEnglish(0)) return "";
    return "<mspace width=\"0.17em\"></mspace>";
  }

  static bool EndsOperand(char32_t c) {
    return IsLetter(c) || IsDigit(c) || RaisedCharacter(c) != 0 ||
           LoweredCharacter(c) != 0 || !AccentMark(c).empty() || c == U')' ||
           c == U']' || c == U'½' || c == U'¼' || c == U'⅓';
  }

  // "(EM-7)" here, which then is taken; "" if there is no tag.
  std::string Tag() {
    size_t end = 1;
    while (Peek(end) >= U'A' && Peek(end) <= U'Z') ++end;
    if (Peek() != U'(' || end < 3 || Peek(end) != U'-' ||
        !IsDigit(Peek(end + 1))) {
      return "";
    }
    std::string tag;
    while (!AtEnd() && (tag.empty() || tag.back() != ')')) {
      tag += Utf8(characters_[at_++]);
    }
    return EscapeHtml(tag);
  }

  void Flush() {
    if (math_.empty()) return;
    absl::StrAppend(&html_, "<math>", math_, "</math>");
    math_.clear();
  }

  // The run of letters that begins `ahead` characters from here.
  std::string Letters(size_t ahead = 0) const {
    std::string letters;
    const auto joins = [](char32_t c) { return c == U'\'' || c == U'-'; };
    for (; IsAscii(Peek(ahead)) ||
           (!letters.empty() && joins(Peek(ahead)) && IsAscii(Peek(ahead + 1)));
         ++ahead) {
      letters += static_cast<char>(Peek(ahead));
    }
    return letters;
  }

  // Whether a word of a sentence begins `ahead` characters from here.
  bool BeginsEnglish(size_t ahead) const {
    const std::string word = Letters(ahead);
    if (word == "a" && Peek(ahead + 1) == U' ') {
      return Letters(ahead + 2).size() >= 3 && BeginsEnglish(ahead + 2);
    }
    return IsEnglish(word) && Peek(ahead + word.size()) != U'_';
  }

  // The word here, if it is one of a sentence; then takes it.
  std::string EnglishWord() {
    if (!BeginsEnglish(0)) return "";
    std::string word = Letters();
    at_ += word.size();
    return word;
  }

  // What stands together without a space, and fractions of such.
  std::string Term() {
    std::string term = Factors();
    while (Peek() == U'/' && Peek(1) != U' ') {
      ++at_;
      const std::string above = Bare(term);
      const std::string below = Factors();
      term = absl::StrCat("<mfrac displaystyle=\"true\">", above, Bare(below),
                          "</mfrac>");
      bare_.clear();
    }
    return term;
  }

  std::string Factors() {
    std::string factors;
    bare_.clear();
    size_t count = 0;
    do {
      const char32_t c = Peek();
      const bool operand = IsLetter(c) || IsDigit(c) || c == U'½' ||
                           c == U'⅓' || c == U'¼' || c == U'√' || c == U'(' ||
                           c == U'[' || c == U'{' || c == U'|';
      std::string bare;
      factors += Scripted(&bare);
      bare_ = ++count == 1 ? bare : "";
      if (!operand) break;
    } while (!AtEnd() && StartsOperand(Peek()));
    return factors;
  }

  // A bar or a word never goes on a term: it closes one, or begins a sentence.
  bool StartsOperand(char32_t c) const {
    return IsLetter(c) || c == U'(' || c == U'[' || c == U'√' || IsDigit(c);
  }

  // A term as part of a fraction: one element, without its parentheses.
  std::string Bare(const std::string& term) const {
    return Element("mrow", bare_.empty() ? term : bare_);
  }

  // An atom with its accents, subscripts and superscripts. `bare` is what
  // stands in its parentheses, if it is no more than that.
  std::string Scripted(std::string* bare) {
    std::string base = Atom(bare);
    for (std::string mark = AccentMark(Peek()); !mark.empty();
         mark = AccentMark(Peek())) {
      base = absl::StrCat("<mover>", base, Element("mo", mark), "</mover>");
      ++at_;
    }
    std::string sub;
    std::string super;
    for (bool found = true; found && !AtEnd();) {
      found = Script(&sub, &super);
    }
    if (sub.empty() && super.empty()) return base;
    bare->clear();
    sub = Element("mrow", sub);
    super = Element("mrow", super);
    if (super == "<mrow></mrow>") return Element("msub", base + sub);
    if (sub == "<mrow></mrow>") return Element("msup", base + super);
    return Element("msubsup", base + sub + super);
  }

  bool Script(std::string* sub, std::string* super) {
    if (const char32_t raised = RaisedCharacter(Peek()); raised != 0) {
      *super += Character(raised);
      ++at_;
    } else if (const char32_t lowered = LoweredCharacter(Peek());
               lowered != 0) {
      *sub += Character(lowered);
      ++at_;
    } else if (Peek() == U'_') {
      ++at_;
      std::string name;
      while (IsLetter(Peek()) || IsDigit(Peek())) {
        name += Utf8(characters_[at_++]);
      }
      *sub += Element(name.size() > 2 ? "mtext" : "mi", EscapeHtml(name));
    } else if (Peek() == U'^') {
      ++at_;
      std::string bare;
      const std::string atom = Atom(&bare);
      *super += bare.empty() ? atom : bare;
    } else {
      return false;
    }
    return true;
  }

  static std::string Character(char32_t c) {
    const char* element = IsLetter(c) ? "mi" : IsDigit(c) ? "mn" : "mo";
    return Element(element, EscapeHtml(Utf8(c)));
  }

  std::string Atom(std::string* bare) {
    const char32_t c = Peek();
    if (IsDigit(c)) {
      std::string number;
      while (IsDigit(Peek()) || (Peek() == U'.' && IsDigit(Peek(1)))) {
        number += Utf8(characters_[at_++]);
      }
      return Element("mn", number);
    }
    if (const std::string word = Letters(); word.size() >= 2) {
      if (IsFunction(word) || word == "EA") {
        at_ += word.size();
        std::string name = word;
        while (IsDigit(Peek())) name += Utf8(characters_[at_++]);  // atan2
        return Element("mi", name);
      }
    }
    ++at_;
    switch (c) {
      case U'½':
        return "<mfrac><mn>1</mn><mn>2</mn></mfrac>";
      case U'⅓':
        return "<mfrac><mn>1</mn><mn>3</mn></mfrac>";
      case U'¼':
        return "<mfrac><mn>1</mn><mn>4</mn></mfrac>";
      case U'√': {
        std::string inside;
        const std::string atom = Atom(&inside);
        return Element("msqrt", inside.empty() ? atom : inside);
      }
      case U'(':
        return Group(U'(', U')', bare);
      case U'[':
        return Group(U'[', U']', nullptr);
      case U'{':
        return Group(U'{', U'}', nullptr);
      case U'|':
        return Group(U'|', U'|', nullptr);
      case U'+':
        if (Peek() == U'=') {
          ++at_;
          return Element("mo", "+=");
        }
        return Element("mo", "+");
      default:
        return Character(c);
    }
  }

  // What stands up to `close`, with both; without them in `bare` if there is
  // no comma.
  std::string Group(char32_t open, char32_t close, std::string* bare) {
    std::string inside;
    bool list = false;
    while (!AtEnd() && Peek() != close) {
      if (Peek() == U' ') {
        inside += Space();
      } else if (const std::string word = EnglishWord(); !word.empty()) {
        inside += Element("mtext", "\u00A0" + EscapeHtml(word) + "\u00A0");
      } else {
        list = list || Peek() == U',' || Peek() == U';';
        inside += Term();
      }
    }
    if (!AtEnd()) ++at_;
    if (bare != nullptr && !list) *bare = inside;
    return Element("mrow", absl::StrCat(Fence(open, "prefix"), inside,
                                        Fence(close, "postfix")));
  }

  // A bar does not say which side it is on.
  static std::string Fence(char32_t c, const char* form) {
    return absl::StrCat("<mo form=\"", form, "\" stretchy=\"true\">",
                        EscapeHtml(Utf8(c)), "</mo>");
  }

  std::vector<char32_t> characters_;
  size_t at_ = 0;
  std::string html_;
  std::string math_;  // Of the <math> that is being written.
  std::string bare_;  // See Scripted: of the last factors, if only one.
};

}  // namespace

std::string FormulaHtml(std::string_view formula) {
  return Formula(formula).Html();
}

}  // namespace emmy::verification
