#include "verification/timing/timing_page.h"

#include "absl/strings/str_cat.h"
#include "verification/report/html_text.h"
#include "verification/timing/markdown_html.h"

namespace emmy::verification {
namespace {

// Of what a report's tables say.
size_t Count(const std::string& text, const std::string& word) {
  size_t count = 0;
  for (size_t at = text.find(word); at != std::string::npos;
       at = text.find(word, at + word.size())) {
    ++count;
  }
  return count;
}

std::string Section(const TimingFigure& figure) {
  return absl::StrCat("<section id=\"", EscapeHtml(figure.name), "\">\n<h2>",
                      EscapeHtml(figure.heading), "</h2>\n<figure><img alt=\"",
                      EscapeHtml(figure.alternative), "\" src=\"",
                      DataUri("image/svg+xml", figure.svg), "\">\n<figcaption>",
                      EscapeHtml(figure.caption),
                      " <a class=\"data\" download=\"", EscapeHtml(figure.name),
                      ".csv\" href=\"", DataUri("text/csv", figure.csv),
                      "\">data (CSV)</a></figcaption></figure>\n</section>\n");
}

}  // namespace

std::string TimingPage(const TimingRun& run, const TimingPageParts& parts) {
  const std::string tables = parts.report + parts.peers;
  const size_t met = Count(tables, "| met |");
  const size_t missed = Count(tables, "| **missed** |");
  const size_t unmeasured = Count(tables, "| not measured |");
  const size_t failed = Count(tables, "| failed: ");
  const std::string title =
      absl::StrCat(met, " of ", met + missed, " targets met");
  std::string figures;
  for (const TimingFigure& figure : parts.figures) {
    absl::StrAppend(&figures, Section(figure));
  }
  return absl::StrCat(
      HtmlHead(title, /*has_script=*/false), "<body>\n<header class=\"verdict ",
      missed == 0 && failed == 0 && met > 0 ? "green" : "red",
      "\">\n<p class=\"product\">Emmy, timing report</p>\n<h1>", title,
      "</h1>\n<ul>\n<li><strong>", missed,
      "</strong> missed</li>\n<li><strong>", unmeasured,
      "</strong> not measured</li>\n<li><strong>", failed,
      "</strong> without a time</li>\n<li><time>", EscapeHtml(run.date),
      "</time></li>\n</ul>\n</header>\n<main>\n<section id=\"times\">\n",
      MarkdownHtml(parts.report), "</section>\n", figures,
      "<section id=\"peers\">\n", MarkdownHtml(parts.peers),
      "</section>\n<section id=\"environment\">\n<h2>Environment</h2>\n<dl>\n"
      "<dt>processor</dt><dd>",
      EscapeHtml(run.processor), "</dd>\n<dt>program</dt><dd>",
      EscapeHtml(run.program), "</dd>\n<dt>date</dt><dd>", EscapeHtml(run.date),
      "</dd>\n</dl>\n</section>\n</main>\n</body>\n"
      "</html>\n");
}

}  // namespace emmy::verification
