// emmy_timing_report: reads what emmy_benchmark wrote and says what it means.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/text_file.h"
#include "verification/figures/figure.h"
#include "verification/timing/growth_figure.h"
#include "verification/timing/peer_report.h"
#include "verification/timing/timing_page.h"
#include "verification/timing/timing_report.h"

namespace emmy::verification {
namespace {

struct Arguments {
  std::string input;
  std::string compare;
  std::string page;
  std::string peers;
  std::string figures;
  std::string html;
};

// Replaces what stands between the markers of a Markdown page.
absl::Status WritePage(const std::string& path, const std::string& report) {
  constexpr char kBegin[] =
      "<!-- timings: begin (written by tools/benchmark) -->";
  constexpr char kEnd[] = "<!-- timings: end -->";
  absl::StatusOr<std::string> page = ReadTextFile(path, size_t{1} << 24);
  if (!page.ok()) return page.status();
  const size_t begin = page->find(kBegin);
  const size_t end = page->find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    return absl::InvalidArgumentError(absl::StrCat(
        path, ": expected the lines \"", kBegin, "\" and \"", kEnd, "\""));
  }
  return WriteTextFile(
      path, absl::StrCat(page->substr(0, begin), kBegin, "\n\n", report, "\n",
                         page->substr(end)));
}

// Adds a figure to the page; one that was not drawn is left out.
void AddFigure(const std::string& directory, TimingFigure figure,
               TimingPageParts* parts) {
  const std::string path = absl::StrCat(directory, "/", figure.name);
  absl::StatusOr<std::string> svg =
      ReadTextFile(path + ".svg", size_t{1} << 24);
  absl::StatusOr<std::string> csv =
      ReadTextFile(path + ".csv", size_t{1} << 24);
  if (!svg.ok() || !csv.ok()) return;
  figure.svg = *std::move(svg);
  figure.csv = *std::move(csv);
  parts->figures.push_back(std::move(figure));
}

// The report's tables and, where they are, the peers' and the figures, as a
// page.
absl::Status WriteHtml(const Arguments& arguments, const TimingRun& run,
                       const std::string& report, const std::string& peers) {
  TimingPageParts parts;
  parts.report = report;
  parts.peers = peers;
  if (!arguments.figures.empty()) {
    AddFigure(arguments.figures,
              {"growth", "Growth",
               "Time of a step against the size of nets, chains, "
               "loops, trees and rows",
               "Time of a step over the number of nodes or boxes; "
               "dashed, a time that grows as the size.",
               "", ""},
              &parts);
    AddFigure(
        arguments.figures,
        {"work_precision", "Work and precision",
         "Error of the angular velocity at 10 s against processor time per "
         "simulated second",
         "The paper's box: error of the angular velocity at 10 s against the "
         "closed-form motion, over the processor time of a simulated second; "
         "along a curve the step is halved from point to point.",
         "", ""},
        &parts);
  }
  return WriteTextFile(arguments.html, TimingPage(run, parts));
}

bool Complete(const TimingRun& run) {
  return std::none_of(
      run.timings.begin(), run.timings.end(),
      [](const Timing& timing) { return !timing.error.empty(); });
}

// Whether every benchmark was timed; a status if a file cannot be read or
// written.
absl::StatusOr<bool> Report(const Arguments& arguments) {
  const absl::StatusOr<TimingRun> now = ReadTimings(arguments.input);
  if (!now.ok()) return now.status();
  std::string peers;
  if (!arguments.peers.empty()) {
    const absl::StatusOr<TimingRun> others = ReadTimings(arguments.peers);
    if (!others.ok()) return others.status();
    peers = absl::StrCat("\n", PeerReport(*others));
  }
  const std::string report = TimingReport(*now);
  std::string comparison;
  if (!arguments.compare.empty()) {
    const absl::StatusOr<TimingRun> before = ReadTimings(arguments.compare);
    if (!before.ok()) return before.status();
    comparison = absl::StrCat("\n### Against ", arguments.compare, "\n\n",
                              CompareTimings(*before, *now));
  }
  std::cout << report << peers << comparison;
  if (!arguments.figures.empty()) {
    const absl::Status drawn =
        WriteFigure(GrowthFigure(*now), arguments.figures);
    // Without gnuplot there is the data.
    if (!drawn.ok() && !absl::IsUnavailable(drawn)) return drawn;
  }
  if (!arguments.html.empty()) {
    const absl::Status written =
        WriteHtml(arguments, *now, report + comparison, peers);
    if (!written.ok()) return written;
  }
  const bool complete = Complete(*now);
  if (!arguments.page.empty() && !complete) {
    std::cerr << arguments.page << ": not written, since a benchmark failed\n";
  } else if (!arguments.page.empty()) {
    const absl::Status written = WritePage(arguments.page, report + peers);
    if (!written.ok()) return written;
  }
  return complete;
}

}  // namespace
}  // namespace emmy::verification

int main(int argc, char** argv) {
  CLI::App app(
      "Reads the JSON of emmy_benchmark and prints ratios against their "
      "targets, growth with size, and all times, as Markdown.");
  emmy::verification::Arguments arguments;
  app.add_option("input", arguments.input, "What emmy_benchmark wrote")
      ->required()
      ->type_name("FILE");
  app.add_option("--compare", arguments.compare,
                 "An older such file: what became slower or faster")
      ->type_name("FILE");
  app.add_option("--page", arguments.page,
                 "A Markdown page between whose markers the report is put")
      ->type_name("FILE");
  app.add_option("--peers", arguments.peers,
                 "What emmy_peer_benchmark wrote: a table with other engines")
      ->type_name("FILE");
  app.add_option("--figures", arguments.figures,
                 "Where emmy_work_precision has drawn and growth is drawn to")
      ->type_name("DIR");
  app.add_option("--html", arguments.html, "A page with all of it, to write")
      ->type_name("FILE");
  app.footer(
      "Exit status: 0 all benchmarks have a time; 1 one failed; 2 bad input.");
  CLI11_PARSE(app, argc, argv);
  const absl::StatusOr<bool> complete = emmy::verification::Report(arguments);
  if (!complete.ok()) {
    std::cerr << complete.status().message() << '\n';
    return 2;
  }
  return *complete ? 0 : 1;
}
