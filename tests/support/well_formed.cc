#include "tests/support/well_formed.h"

#include <cctype>
#include <regex>
#include <set>
#include <vector>

namespace emmy {
namespace {

bool IsEmptyElement(const std::string& name) {
  static const auto& names =
      *new std::set<std::string>{"meta", "link", "img", "input", "wbr"};
  return names.count(name) > 0;
}

class Markup {
 public:
  explicit Markup(const std::string& text) : text_(text) {}

  std::string Problem() {
    Skip("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    Skip("<!DOCTYPE html>\n");
    while (problem_.empty() && at_ < text_.size()) {
      const size_t tag = text_.find('<', at_);
      CheckText(text_.substr(at_, tag - at_));
      if (tag == std::string::npos) break;
      at_ = tag;
      ReadTag();
    }
    if (problem_.empty() && !open_.empty()) Fail("no </" + open_.back() + ">");
    return problem_;
  }

 private:
  void Fail(const std::string& what) {
    if (problem_.empty()) {
      problem_ = what + " near \"" + text_.substr(at_, 60) + "\"";
    }
  }

  void Skip(const std::string& start) {
    if (text_.compare(at_, start.size(), start) == 0) at_ += start.size();
  }

  // Text or the value of an attribute.
  void CheckText(const std::string& text) {
    static const std::regex& reference =
        *new std::regex("^&(amp|lt|gt|quot|#[0-9]{1,7}|#x[0-9a-fA-F]{1,6});");
    for (size_t i = text.find('&'); i != std::string::npos;
         i = text.find('&', i + 1)) {
      if (!std::regex_search(text.substr(i, 10), reference)) {
        Fail("bad reference " + text.substr(i, 10));
      }
    }
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 32 && c != '\n' && c != '\t' && c != '\r') Fail("control");
    }
  }

  std::string Name() {
    const size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
            text_[at_] == '-' || text_[at_] == '_')) {
      ++at_;
    }
    if (at_ == begin) Fail("no name");
    return text_.substr(begin, at_ - begin);
  }

  void ReadTag() {
    ++at_;
    if (at_ < text_.size() && text_[at_] == '/') {
      ++at_;
      const std::string name = Name();
      if (open_.empty() || open_.back() != name) Fail("</" + name + ">");
      if (!open_.empty()) open_.pop_back();
      if (text_.compare(at_, 1, ">") != 0) Fail("no >");
      ++at_;
      return;
    }
    const std::string name = Name();
    ReadAttributes();
    if (!problem_.empty()) return;
    if (!IsEmptyElement(name)) open_.push_back(name);
    if (name == "script" || name == "style") {
      const size_t end = text_.find("</" + name + ">", at_);
      if (end == std::string::npos) Fail("no end of " + name);
      at_ = end;
    }
  }

  // Up to and with ">".
  void ReadAttributes() {
    std::set<std::string> names;
    while (problem_.empty()) {
      while (at_ < text_.size() &&
             std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      }
      if (at_ >= text_.size()) return Fail("tag does not end");
      if (text_[at_] == '>') {
        ++at_;
        return;
      }
      const std::string name = Name();
      if (!names.insert(name).second) Fail("twice: " + name);
      if (text_.compare(at_, 1, "=") != 0) continue;
      if (text_.compare(at_, 2, "=\"") != 0) return Fail("not quoted");
      const size_t begin = at_ + 2;
      const size_t end = text_.find('"', begin);
      if (end == std::string::npos) return Fail("quotation does not end");
      const std::string value = text_.substr(begin, end - begin);
      if (value.find('<') != std::string::npos) Fail("< in " + name);
      CheckText(value);
      at_ = end + 1;
    }
  }

  const std::string& text_;
  size_t at_ = 0;
  std::vector<std::string> open_;
  std::string problem_;
};

}  // namespace

std::string ProblemInMarkup(const std::string& text) {
  return Markup(text).Problem();
}

}  // namespace emmy
