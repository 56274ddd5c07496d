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
  std::string figure;
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

// The report's tables and, where they are, the peers' and the figure, as a
// page. A figure that was not drawn is left out.
absl::Status WriteHtml(const Arguments& arguments, const TimingRun& run,
                       const std::string& report, const std::string& peers) {
  TimingPageParts parts;
  parts.report = report;
  parts.peers = peers;
  if (!arguments.figure.empty()) {
    absl::StatusOr<std::string> svg =
        ReadTextFile(arguments.figure + ".svg", size_t{1} << 24);
    absl::StatusOr<std::string> csv =
        ReadTextFile(arguments.figure + ".csv", size_t{1} << 24);
    if (svg.ok() && csv.ok()) {
      parts.svg = *std::move(svg);
      parts.csv = *std::move(csv);
    }
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
  app.add_option("--figure", arguments.figure,
                 "Path without ending of the figure of emmy_work_precision")
      ->type_name("PATH");
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
