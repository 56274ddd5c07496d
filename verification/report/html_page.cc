#include "verification/report/html_page.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "verification/report/embedded.h"
#include "verification/report/formula.h"
#include "verification/report/group_text.h"
#include "verification/report/html_text.h"
#include "verification/report/theory_equations.h"

namespace emmy::verification {
namespace {

size_t NumFailed(const std::vector<Outcome>& outcomes) {
  return static_cast<size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [](const Outcome& outcome) { return !outcome.pass; }));
}

// In the order in which they appear first.
std::vector<std::string> Groups(const std::vector<Outcome>& outcomes) {
  std::vector<std::string> groups;
  for (const Outcome& outcome : outcomes) {
    const std::string group = outcome.claim->group();
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) {
      groups.push_back(group);
    }
  }
  return groups;
}

std::string VerdictHeader(const std::vector<Outcome>& outcomes,
                          const Environment& environment,
                          const std::string& verdict) {
  const size_t failed = NumFailed(outcomes);
  const std::string level =
      outcomes.empty() ? "no" : LevelName(outcomes[0].level);
  return absl::StrCat(
      "<header class=\"verdict ",
      failed == 0 && !outcomes.empty() ? "green" : "red",
      "\">\n<p class=\"product\">Emmy ", EscapeHtml(environment.build.version),
      ", verification report</p>\n<h1>", verdict, "</h1>\n<ul>\n<li><strong>",
      outcomes.size() - failed, "</strong> passed</li>\n<li><strong>", failed,
      "</strong> failed</li>\n<li>", level, " level</li>\n<li><time>",
      EscapeHtml(
          absl::StrReplaceAll(environment.date, {{"T", " "}, {"Z", " UTC"}})),
      "</time></li>\n<li>", DurationText(environment.wall_seconds),
      "</li>\n</ul>\n</header>\n");
}

std::string Failures(const std::vector<Outcome>& outcomes) {
  if (NumFailed(outcomes) == 0) return "";
  std::string html = "<section id=\"failures\">\n<h2>Failures</h2>\n";
  for (const Outcome& outcome : outcomes) {
    if (!outcome.pass) html += FailureArticle(outcome);
  }
  return html + "</section>\n";
}

// Hidden until the script makes them work.
std::string Filters(const std::vector<Outcome>& outcomes) {
  std::string html =
      "<form id=\"filters\" hidden>\n<label>Text <input type=\"search\" "
      "id=\"filter-text\" autocomplete=\"off\"></label>\n<label>Group <select "
      "id=\"filter-group\"><option value=\"\">all</option>";
  for (const std::string& group : Groups(outcomes)) {
    absl::StrAppend(&html, "<option value=\"", EscapeHtml(group), "\">",
                    EscapeHtml(DescribeGroup(group).title), "</option>");
  }
  html +=
      "</select></label>\n<label>Reference <select id=\"filter-reference\">"
      "<option value=\"\">all</option>";
  for (const Reference reference :
       {Reference::kExact, Reference::kPublished, Reference::kCrossFormulation,
        Reference::kRegression}) {
    absl::StrAppend(&html, "<option>", ReferenceName(reference), "</option>");
  }
  return html +
         "</select></label>\n<label><input type=\"checkbox\" "
         "id=\"filter-failing\"> only failing</label>\n<output "
         "id=\"filter-count\" aria-live=\"polite\"></output>\n</form>\n";
}

std::string Table(const std::vector<Outcome>& outcomes) {
  std::string html = absl::StrCat(
      "<section id=\"claims\">\n<h2>All claims</h2>\n<p>A claim is a sentence "
      "that a measurement can refute. Shown is the value that is closest to "
      "its bound; the margin is the part of the bound that is left. What it is "
      "compared with says what it is worth as evidence: <em>exact</em>, a "
      "closed form or a law; <em>published</em>, results of others; "
      "<em>cross-formulation</em>, the same motion computed in another way; "
      "<em>regression</em>, an earlier result.</p>\n",
      Filters(outcomes),
      "<table class=\"claims\" id=\"claim-table\">\n<thead><tr><th "
      "scope=\"col\">verdict</th><th scope=\"col\">claim</th><th "
      "scope=\"col\">value</th><th scope=\"col\">bound</th><th "
      "scope=\"col\">margin</th><th scope=\"col\">reference</th><th "
      "scope=\"col\">time</th></tr></thead>\n<tbody>\n");
  for (const Outcome& outcome : outcomes) html += ClaimRow(outcome);
  return html + "</tbody>\n</table>\n</section>\n";
}

std::string Equations(const std::vector<std::string>& tags) {
  std::string html;
  for (const std::string& tag : tags) {
    const auto equation = TheoryEquations().find(tag);
    if (equation == TheoryEquations().end()) continue;
    absl::StrAppend(&html, "<tr><td>", FormulaHtml(equation->second),
                    "</td><th scope=\"row\">(", EscapeHtml(tag),
                    ")</th></tr>\n");
  }
  if (html.empty()) return "";
  return absl::StrCat(
      "<details class=\"equations\" open><summary>Equations these claims rest "
      "on</summary>\n<table>\n",
      html, "</table>\n</details>\n");
}

std::string GroupSection(const std::string& group,
                         const std::vector<Outcome>& outcomes,
                         const FigureImages& images) {
  std::string citations;
  std::string claims;
  size_t count = 0;
  size_t passed = 0;
  for (const Outcome& outcome : outcomes) {
    if (outcome.claim->group() != group) continue;
    absl::StrAppend(&citations, outcome.claim->equations, "; ");
    claims += ClaimArticle(outcome, images);
    ++count;
    if (outcome.pass) ++passed;
  }
  const GroupText text = DescribeGroup(group);
  return absl::StrCat("<section class=\"group\" id=\"group-", EscapeHtml(group),
                      "\">\n<h2>", EscapeHtml(text.title), "</h2>\n<p>",
                      EscapeHtml(text.introduction), " ", passed, " of ", count,
                      " hold.</p>\n", Equations(CitedTags(citations)), claims,
                      "</section>\n");
}

std::string Contents(const std::vector<Outcome>& outcomes) {
  std::string html =
      "<nav aria-label=\"Contents\"><a href=\"#claims\">All claims</a>";
  for (const std::string& group : Groups(outcomes)) {
    absl::StrAppend(&html, " <a href=\"#group-", EscapeHtml(group), "\">",
                    EscapeHtml(DescribeGroup(group).title), "</a>");
  }
  return html + " <a href=\"#environment\">Environment</a></nav>\n";
}

std::string EnvironmentSection(const Environment& environment) {
  std::string html =
      "<section id=\"environment\">\n<h2>Environment</h2>\n<dl>\n";
  const auto term = [&html](const char* name, const std::string& text) {
    absl::StrAppend(&html, "<dt>", name, "</dt><dd>", EscapeHtml(text),
                    "</dd>\n");
  };
  term("version", environment.build.version);
  term("compiler", environment.build.compiler);
  term("flags", environment.build.flags);
  term("processor", environment.processor);
  term("threads", absl::StrCat(environment.threads));
  term("system", environment.system);
  term("date", environment.date);
  term("wall time", DurationText(environment.wall_seconds));
  absl::StrAppend(&html, "</dl>\n<pre class=\"command\">",
                  EscapeHtml(environment.command), "</pre>\n</section>\n");
  return html;
}

}  // namespace

std::string HtmlPage(const std::vector<Outcome>& outcomes,
                     const Environment& environment,
                     const FigureImages& images) {
  const size_t failed = NumFailed(outcomes);
  const std::string verdict =
      outcomes.empty() ? "No claim was checked"
      : failed == 0
          ? absl::StrCat("All ", outcomes.size(), " claims hold")
          : absl::StrCat(failed, " of ", outcomes.size(), " claims failed");
  std::string html =
      absl::StrCat(HtmlHead(verdict, /*has_script=*/true), "<body>\n",
                   VerdictHeader(outcomes, environment, verdict), "<main>\n",
                   Contents(outcomes), Failures(outcomes), Table(outcomes));
  for (const std::string& group : Groups(outcomes)) {
    html += GroupSection(group, outcomes, images);
  }
  return absl::StrCat(
      html, EnvironmentSection(environment), "</main>\n<script>\n",
      absl::string_view(EmbeddedScript().data(), EmbeddedScript().size()),
      "</script>\n</body>\n</html>\n");
}

}  // namespace emmy::verification
