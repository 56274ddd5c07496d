#include "tools/cli/verify_command.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/text_file.h"
#include "tools/cli/print.h"
#include "tools/cli/run_files.h"
#include "verification/registry.h"
#include "verification/report/claim_table.h"
#include "verification/report/environment.h"
#include "verification/report/text_report.h"
#include "verification/report/write_report.h"

namespace emmy {
namespace {

using verification::Claim;
using verification::Outcome;

struct VerifyArguments {
  bool list = false;
  std::string format = "text";
  std::vector<std::string> only;
  std::string level = "quick";
  std::string output;
  std::vector<std::string> command_line;  // With the program's name.
};

// Those of `ids`, in the order of the registry; all if there are none.
absl::StatusOr<std::vector<const Claim*>> Select(
    const std::vector<std::string>& ids) {
  std::vector<const Claim*> selected;
  for (const Claim& claim : verification::AllClaims()) {
    const bool named = std::find(ids.begin(), ids.end(), claim.id) != ids.end();
    if (ids.empty() || named) selected.push_back(&claim);
  }
  for (const std::string& id : ids) {
    if (verification::FindClaim(id) != nullptr) continue;
    std::string known;
    for (const Claim& claim : verification::AllClaims()) {
      absl::StrAppend(&known, "\n  ", claim.id);
    }
    return absl::InvalidArgumentError(absl::StrCat(
        "--only: there is no claim \"", id, "\"; the claims are", known));
  }
  return selected;
}

// A line on standard error that says how many are done, if a person watches.
class Counter {
 public:
  explicit Counter(size_t total)
      : total_(total), enabled_(isatty(STDERR_FILENO) != 0) {
    Show("");
  }
  ~Counter() {
    if (enabled_) static_cast<void>(std::fputs("\r\033[K", stderr));
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  void Finished(const Outcome& outcome) {
    ++done_;
    Show(outcome.claim->id);
  }

 private:
  void Show(const std::string& last) const {
    if (!enabled_) return;
    static_cast<void>(std::fprintf(stderr,
                                   "\r%zu of %zu claims checked  %s\033[K",
                                   done_, total_, last.c_str()));
    static_cast<void>(std::fflush(stderr));
  }

  size_t total_;
  size_t done_ = 0;
  bool enabled_;
};

ExitStatus Verify(const VerifyArguments& arguments) {
  const absl::StatusOr<std::vector<const Claim*>> claims =
      Select(arguments.only);
  if (!claims.ok()) return PrintError(claims.status(), kExitBadInput);
  if (arguments.list) {
    Print(arguments.format == "markdown" ? verification::ClaimTable(*claims)
                                         : verification::ClaimList(*claims));
    return kExitDone;
  }
  if (!arguments.output.empty()) {
    const absl::Status made = MakeDirectory(arguments.output);
    if (!made.ok()) return PrintError(made, kExitBadInput);
  }

  verification::ClaimSetting setting;
  setting.level = arguments.level == "quick" ? verification::Level::kQuick
                                             : verification::Level::kFull;
  verification::Environment environment =
      verification::DescribeEnvironment(arguments.command_line);
  environment.threads =
      std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto start = std::chrono::steady_clock::now();
  std::vector<Outcome> outcomes;
  {
    Counter counter(claims->size());
    outcomes = verification::RunClaims(
        *claims, setting, environment.threads,
        [&counter](const Outcome& outcome) { counter.Finished(outcome); });
  }
  environment.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
  for (const Outcome& outcome : outcomes) {
    Print(verification::OutcomeText(outcome));
  }
  if (!arguments.output.empty()) {
    const absl::StatusOr<std::vector<std::string>> written =
        verification::WriteReport(outcomes, environment, arguments.output);
    if (!written.ok()) return PrintError(written.status(), kExitFailed);
    // Said, but no reason for another verdict: data and script are there.
    for (const std::string& message : *written) {
      PrintError(absl::UnavailableError(message), kExitDone);
    }
    Print("Wrote " + arguments.output +
          "/index.html, report.json, junit.xml and figures\n");
  }
  Print(verification::VerdictText(outcomes));
  const bool pass = std::all_of(outcomes.begin(), outcomes.end(),
                                [](const Outcome& o) { return o.pass; });
  return pass ? kExitDone : kExitFailed;
}

}  // namespace

Command AddVerifyCommand(CLI::App& app,
                         const std::vector<std::string>& command_line) {
  CLI::App* options = app.add_subcommand(
      "verify", "Measure what is claimed about Emmy, and judge");
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::Option* list = options->add_flag("--list", arguments->list,
                                        "Print the claims and measure nothing");
  options
      ->add_option("--format", arguments->format,
                   "Of --list: text, or markdown for a table with bounds and "
                   "where they come from")
      ->check(CLI::IsMember({"text", "markdown"}))
      ->type_name("FORMAT")
      ->needs(list);
  options
      ->add_option("--only", arguments->only,
                   "Only this claim; may be repeated")
      ->type_name("ID")
      ->allow_extra_args(false);
  options
      ->add_option("--level", arguments->level,
                   "quick: shorter runs, a minute in all (default); full: "
                   "the lengths that are claimed, several minutes")
      ->check(CLI::IsMember({"quick", "full"}))
      ->type_name("LEVEL");
  options
      ->add_option("-o,--output", arguments->output,
                   "Write the report into this directory, which is made if "
                   "needed: index.html, report.json, junit.xml, and each "
                   "figure as CSV, gnuplot script and SVG")
      ->type_name("DIR")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options->footer(R"(
Each claim is one line: id, verdict, the value closest to its bound, the bound,
the part of it that is left (margin). Failures are repeated at the end. Exit
status: 0 all claims hold; 1 not; 2 wrong usage.

index.html is the report to read: one file that needs no other, with verdict,
failures, all claims, equations, figures with their data, and how it was made.
report.json has the same for programs (verification/report/report.schema.json),
junit.xml for CI systems.

Examples:
  emmy verify --list
  emmy verify --level quick --output report
  emmy verify --only order/ancf_body)");
  arguments->command_line = command_line;
  return {options, [arguments] { return Verify(*arguments); }};
}

}  // namespace emmy
