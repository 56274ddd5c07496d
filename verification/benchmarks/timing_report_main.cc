// emmy_timing_report: reads what emmy_benchmark wrote and says what it means.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>

#include "absl/strings/str_cat.h"
#include "emmy/io/text_file.h"
#include "verification/timing/timing_report.h"

namespace emmy::verification {
namespace {

struct Arguments {
  std::string input;
  std::string compare;
  std::string page;
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

int Report(const Arguments& arguments) {
  const absl::StatusOr<TimingRun> now = ReadTimings(arguments.input);
  if (!now.ok()) {
    std::cerr << now.status().message() << '\n';
    return 2;
  }
  const std::string report = TimingReport(*now);
  std::cout << report;
  if (!arguments.compare.empty()) {
    const absl::StatusOr<TimingRun> before = ReadTimings(arguments.compare);
    if (!before.ok()) {
      std::cerr << before.status().message() << '\n';
      return 2;
    }
    std::cout << "\n### Against " << arguments.compare << "\n\n"
              << CompareTimings(*before, *now);
  }
  const bool complete =
      std::none_of(now->timings.begin(), now->timings.end(),
                   [](const Timing& timing) { return !timing.error.empty(); });
  if (!arguments.page.empty() && !complete) {
    std::cerr << arguments.page << ": not written, since a benchmark failed\n";
  } else if (!arguments.page.empty()) {
    const absl::Status written = WritePage(arguments.page, report);
    if (!written.ok()) {
      std::cerr << written.message() << '\n';
      return 2;
    }
  }
  return complete ? 0 : 1;
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
  app.footer(
      "Exit status: 0 all benchmarks have a time; 1 one failed; 2 bad input.");
  CLI11_PARSE(app, argc, argv);
  return emmy::verification::Report(arguments);
}
