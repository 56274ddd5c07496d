#include "verification/report/html_claim.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "verification/report/html_text.h"

namespace emmy::verification {
namespace {

std::string Unit(const Claim& claim) {
  return claim.unit == "-" ? "" : "&#8239;" + EscapeHtml(claim.unit);
}

std::string BoundHtml(const Bound& bound) {
  const bool below = std::isfinite(bound.upper);
  const bool above = std::isfinite(bound.lower);
  if (below && above) {
    return absl::StrCat(HtmlNumber(bound.lower), " … ",
                        HtmlNumber(bound.upper));
  }
  if (above) return absl::StrCat("≥ ", HtmlNumber(bound.lower));
  return absl::StrCat("≤ ", HtmlNumber(bound.upper));
}

std::string MarginHtml(double margin) {
  if (!std::isfinite(margin)) return HtmlNumber(margin);
  const double percent = 100.0 * margin;
  if (std::abs(percent) >= 1e4) return HtmlNumber(percent) + "&#8239;%";
  return absl::StrReplaceAll(absl::StrFormat("%.0f&#8239;%%", percent),
                             {{"-", "−"}});
}

std::string Verdict(bool pass) {
  return pass ? R"(<span class="pass">✓ holds</span>)"
              : R"(<span class="fail">✗ failed</span>)";
}

bool Keeps(const Bound& bound, double value) {
  return value >= bound.lower && value <= bound.upper;
}

std::string Term(const char* name, const std::string& html) {
  return absl::StrCat("<dt>", name, "</dt><dd>", html, "</dd>\n");
}

std::string ValueTable(const Outcome& outcome) {
  const Claim& claim = *outcome.claim;
  std::string html =
      "<div class=\"scroll\"><table class=\"values\"><thead><tr>"
      "<th scope=\"col\">measured</th><th scope=\"col\">value</th>"
      "<th scope=\"col\">margin</th><th scope=\"col\">verdict</th>"
      "</tr></thead><tbody>\n";
  for (const MetricValue& value : outcome.result.values) {
    absl::StrAppend(&html, "<tr><th scope=\"row\">", EscapeHtml(value.label),
                    "</th><td>", HtmlNumber(value.value), Unit(claim),
                    "</td><td>", MarginHtml(Margin(claim.bound, value.value)),
                    "</td><td>", Verdict(Keeps(claim.bound, value.value)),
                    "</td></tr>\n");
  }
  return html + "</tbody></table></div>\n";
}

std::string Download(const std::string& name, const char* type,
                     const std::string& text) {
  return absl::StrCat("<a download=\"", EscapeHtml(name), "\" href=\"",
                      DataUri(type, text), "\">", EscapeHtml(name), "</a>");
}

// The names of a figure's columns, or how many there are.
std::string ColumnText(const Figure& figure) {
  if (figure.columns.size() > 4) {
    return absl::StrCat(figure.columns.size(), " columns");
  }
  std::string names;
  for (const Column& column : figure.columns) {
    absl::StrAppend(&names, names.empty() ? "" : ", ", column.name);
  }
  return EscapeHtml(names);
}

std::string FigureHtml(const Figure& figure, const FigureImages& images) {
  const std::string columns = ColumnText(figure);
  std::string html = "<figure>\n";
  const auto image = images.find(figure.name);
  if (image != images.end()) {
    absl::StrAppend(&html, "<img width=\"", figure.width, "\" height=\"",
                    figure.height, "\" alt=\"", EscapeHtml(figure.title), ": ",
                    columns, "\" src=\"",
                    DataUri("image/svg+xml", image->second), "\">\n");
  } else {
    absl::StrAppend(&html,
                    "<p class=\"missing\">Not drawn: gnuplot is missing or "
                    "failed. <code>apt-get install gnuplot-nox</code>, save "
                    "both files below in one folder, then <code>gnuplot ",
                    EscapeHtml(figure.name), ".gp</code>.</p>\n");
  }
  absl::StrAppend(
      &html, "<figcaption>", EscapeHtml(figure.title),
      ". <span class=\"data\">",
      Download(figure.name + ".csv", "text/csv", FigureCsv(figure)), " (",
      figure.columns.empty() ? 0 : figure.columns[0].values.size(),
      " rows: ", columns, "), ",
      Download(figure.name + ".gp", "text/plain", FigureScript(figure)),
      "</span></figcaption>\n</figure>\n");
  return html;
}

// Where to look, by what went wrong and what it was compared with.
std::string Advice(const Outcome& outcome) {
  if (outcome.result.values.empty()) {
    return "Nothing could be measured. Read the message, then run the command "
           "and look at the step or file that it names.";
  }
  for (const MetricValue& value : outcome.result.values) {
    if (std::isnan(value.value)) {
      return "A value is not a number: a run diverged or a quotient is 0/0. "
             "Run the command, and look for the first step that is not "
             "finite.";
    }
  }
  switch (outcome.claim->reference) {
    case Reference::kExact:
      return "A law or a closed form is missed. Compare compiler and flags at "
             "the end of this page with a build that passes (contraction or "
             "reordering of floating point breaks round-off), then look at "
             "the code that cites the equations below.";
    case Reference::kPublished:
      return "Published results are missed. If the exact claims hold, look at "
             "the model: masses, stiffnesses, starting values, step.";
    case Reference::kCrossFormulation:
      return "Two ways of computing the same motion disagree. The exact claims "
             "on either of them say which one to look at.";
    case Reference::kRegression:
      return "An earlier result has changed. If that is intended and explained "
             "by a better one, write it anew: emmy regenerate.";
  }
  return "";
}

}  // namespace

std::string ClaimAnchor(const Claim& claim) {
  return EscapeHtml("claim-" + absl::StrReplaceAll(claim.id, {{"/", "-"}}));
}

std::string RerunCommand(const Outcome& outcome) {
  return outcome.claim->command() + " --level " + LevelName(outcome.level);
}

std::string DurationText(double seconds) {
  if (!(seconds >= 1.0)) return absl::StrFormat("%.3g ms", 1e3 * seconds);
  if (seconds < 60.0) return absl::StrFormat("%.1f s", seconds);
  const auto whole = std::llround(seconds);
  return absl::StrFormat("%d min %d s", whole / 60, whole % 60);
}

std::string ClaimRow(const Outcome& outcome) {
  const Claim& claim = *outcome.claim;
  const bool measured = !outcome.result.values.empty();
  return absl::StrCat(
      "<tr data-group=\"", EscapeHtml(claim.group()), "\" data-reference=\"",
      ReferenceName(claim.reference), "\" data-pass=\"",
      outcome.pass ? "true" : "false", "\"><td>", Verdict(outcome.pass),
      "</td><th scope=\"row\"><a href=\"#", ClaimAnchor(claim), "\">",
      // A long id may go on in the next line after its group.
      absl::StrReplaceAll(EscapeHtml(claim.id), {{"/", "/<wbr>"}}), "</a><p>",
      EscapeHtml(claim.sentence), "</p></th><td data-label=\"value\">",
      measured ? HtmlNumber(outcome.worst.value) + Unit(claim) : "none",
      "</td><td data-label=\"bound\">", BoundHtml(claim.bound), Unit(claim),
      "</td><td data-label=\"margin\">",
      measured ? MarginHtml(outcome.margin) : "none",
      "</td><td data-label=\"reference\">", ReferenceName(claim.reference),
      "</td><td data-label=\"time\">", DurationText(outcome.wall_seconds),
      "</td></tr>\n");
}

std::string ClaimArticle(const Outcome& outcome, const FigureImages& images) {
  const Claim& claim = *outcome.claim;
  std::string html = absl::StrCat(
      "<article id=\"", ClaimAnchor(claim), "\" class=\"claim",
      outcome.pass ? "" : " broken", "\">\n<h3><code>", EscapeHtml(claim.id),
      "</code> ", Verdict(outcome.pass), "</h3>\n<p class=\"sentence\">",
      EscapeHtml(claim.sentence), "</p>\n");
  if (!outcome.failure.empty()) {
    absl::StrAppend(&html, "<p class=\"message\">", EscapeHtml(outcome.failure),
                    "</p>\n");
  }
  absl::StrAppend(&html, "<dl>\n", Term("metric", EscapeHtml(claim.metric)),
                  Term("bound", BoundHtml(claim.bound) + Unit(claim)),
                  Term("because", EscapeHtml(claim.bound.derivation)),
                  Term("compared with", ReferenceName(claim.reference)),
                  Term("rests on", EscapeHtml(claim.equations)),
                  Term("took", DurationText(outcome.wall_seconds)), "</dl>\n");
  if (!outcome.result.values.empty()) html += ValueTable(outcome);
  if (!outcome.result.notes.empty()) {
    html += "<ul class=\"notes\">\n";
    for (const std::string& note : outcome.result.notes) {
      absl::StrAppend(&html, "<li>", EscapeHtml(note), "</li>\n");
    }
    html += "</ul>\n";
  }
  for (const Figure& figure : outcome.result.figures) {
    html += FigureHtml(figure, images);
  }
  return absl::StrCat(html, "<pre class=\"command\">",
                      EscapeHtml(RerunCommand(outcome)),
                      "</pre>\n</article>\n");
}

std::string FailureArticle(const Outcome& outcome) {
  const Claim& claim = *outcome.claim;
  std::string values;
  for (const MetricValue& value : outcome.result.values) {
    if (Keeps(claim.bound, value.value)) continue;
    absl::StrAppend(&values, "<li>", EscapeHtml(value.label), ": ",
                    HtmlNumber(value.value), Unit(claim), ", margin ",
                    MarginHtml(Margin(claim.bound, value.value)), "</li>\n");
  }
  return absl::StrCat(
      "<article class=\"claim broken\">\n<h3><a href=\"#", ClaimAnchor(claim),
      "\"><code>", EscapeHtml(claim.id), "</code></a></h3>\n<p>",
      EscapeHtml(claim.sentence), "</p>\n<dl>\n",
      Term("measured", EscapeHtml(claim.metric)),
      Term("value", values.empty() ? EscapeHtml(outcome.failure)
                                   : absl::StrCat("<ul>", values, "</ul>")),
      Term("bound", BoundHtml(claim.bound) + Unit(claim)),
      Term("because", EscapeHtml(claim.bound.derivation)),
      Term("what to do", EscapeHtml(Advice(outcome))),
      "</dl>\n<pre class=\"command\">", EscapeHtml(RerunCommand(outcome)),
      "</pre>\n</article>\n");
}

}  // namespace emmy::verification
