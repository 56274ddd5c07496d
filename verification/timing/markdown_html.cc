#include "verification/timing/markdown_html.h"

#include <algorithm>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "verification/report/html_text.h"

namespace emmy::verification {
namespace {

// `escaped` with each pair of marks as an element; a mark alone stays.
std::string Marked(const std::string& escaped, const std::string& mark,
                   const std::string& element) {
  std::string html;
  size_t from = 0;
  while (true) {
    const size_t open = escaped.find(mark, from);
    if (open == std::string::npos) break;
    const size_t close = escaped.find(mark, open + mark.size());
    if (close == std::string::npos) break;
    const size_t start = open + mark.size();
    absl::StrAppend(&html, escaped.substr(from, open - from), "<", element, ">",
                    escaped.substr(start, close - start), "</", element, ">");
    from = close + mark.size();
  }
  return html + escaped.substr(from);
}

std::string Inline(absl::string_view text) {
  const std::string escaped =
      EscapeHtml(std::string_view(text.data(), text.size()));
  return Marked(Marked(escaped, "**", "strong"), "`", "code");
}

std::string Row(absl::string_view line, const std::string& cell) {
  absl::ConsumePrefix(&line, "|");
  absl::ConsumeSuffix(&line, "|");
  std::string html = "<tr>";
  for (const absl::string_view text : absl::StrSplit(line, '|')) {
    absl::StrAppend(&html, "<", cell, ">",
                    Inline(absl::StripAsciiWhitespace(text)), "</", cell, ">");
  }
  return html + "</tr>\n";
}

// The lines that begin as `lines[*next]` does; *next goes behind them.
std::string Table(const std::vector<std::string>& lines, size_t* next) {
  std::string html =
      absl::StrCat("<div class=\"scroll\"><table class=\"values\">\n<thead>",
                   Row(lines[*next], "th"), "</thead>\n<tbody>\n");
  *next += 2;  // The line of dashes is not shown.
  for (; *next < lines.size() && absl::StartsWith(lines[*next], "|"); ++*next) {
    html += Row(lines[*next], "td");
  }
  return html + "</tbody></table></div>\n";
}

std::string List(const std::vector<std::string>& lines, size_t* next) {
  std::string html = "<ul>\n";
  for (; *next < lines.size() && absl::StartsWith(lines[*next], "- ");
       ++*next) {
    absl::StrAppend(&html, "<li>", Inline(lines[*next].substr(2)), "</li>\n");
  }
  return html + "</ul>\n";
}

}  // namespace

std::string MarkdownHtml(const std::string& markdown) {
  const std::vector<std::string> lines = absl::StrSplit(markdown, '\n');
  std::string html;
  for (size_t next = 0; next < lines.size();) {
    const std::string& line = lines[next];
    const size_t level = std::min(line.find_first_not_of('#'), line.size());
    if (absl::StartsWith(line, "|")) {
      html += Table(lines, &next);
    } else if (absl::StartsWith(line, "- ")) {
      html += List(lines, &next);
    } else if (level > 0) {
      // The page itself has the first level.
      const std::string element = level <= 3 ? "h2" : "h3";
      absl::StrAppend(&html, "<", element, ">",
                      Inline(absl::StripAsciiWhitespace(line.substr(level))),
                      "</", element, ">\n");
      ++next;
    } else {
      if (!line.empty()) absl::StrAppend(&html, "<p>", Inline(line), "</p>\n");
      ++next;
    }
  }
  return html;
}

}  // namespace emmy::verification
