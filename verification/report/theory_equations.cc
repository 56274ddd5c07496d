#include "verification/report/theory_equations.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "verification/report/embedded.h"

namespace emmy::verification {
namespace {

// What stands after "> ", also in a numbered list; null if the line is no
// quotation.
const char* Quoted(const std::string& line) {
  size_t at = line.find_first_not_of(" 0123456789.");
  if (at == std::string::npos || line[at] != '>') return nullptr;
  ++at;
  if (at < line.size() && line[at] == ' ') ++at;
  return line.c_str() + at;
}

}  // namespace

std::map<std::string, std::string> ParseEquations(std::string_view page) {
  static const std::regex& tag_at_end =
      *new std::regex(R"(^(.*\S)\s*—\s*\*\*\(([A-Z]+-[0-9]+)\)\*\*\s*$)");
  std::map<std::string, std::string> equations;
  std::string paragraph;
  const auto finish = [&] {
    std::smatch match;
    if (std::regex_match(paragraph, match, tag_at_end)) {
      equations[match[2]] = match[1];
    }
    paragraph.clear();
  };
  std::istringstream lines{std::string(page)};
  for (std::string line; std::getline(lines, line);) {
    const char* quoted = Quoted(line);
    const size_t first = line.find_first_not_of(' ');
    // The number of an item in a list begins a paragraph.
    if (first != std::string::npos && line[first] != '>') finish();
    if (quoted == nullptr || *quoted == '\0') {
      finish();
    } else {
      absl::StrAppend(&paragraph, paragraph.empty() ? "" : " ", quoted);
    }
  }
  finish();
  return equations;
}

const std::map<std::string, std::string>& TheoryEquations() {
  static const auto* const equations =
      new std::map<std::string, std::string>(ParseEquations(EmbeddedTheory()));
  return *equations;
}

std::vector<std::string> CitedTags(std::string_view text) {
  static const std::regex& citation =
      *new std::regex(R"(\b([A-Z][A-Z]+)-([0-9]{1,3})(?:\.\.([0-9]{1,3}))?)");
  std::vector<std::string> tags;
  const std::string subject(text);
  for (std::sregex_iterator match(subject.begin(), subject.end(), citation);
       match != std::sregex_iterator(); ++match) {
    const int first = std::stoi((*match)[2]);
    const int last = (*match)[3].matched ? std::stoi((*match)[3]) : first;
    for (int n = first; n <= last; ++n) {
      const std::string tag = absl::StrCat((*match)[1].str(), "-", n);
      if (std::find(tags.begin(), tags.end(), tag) == tags.end()) {
        tags.push_back(tag);
      }
    }
  }
  return tags;
}

}  // namespace emmy::verification
