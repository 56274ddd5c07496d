#include "tools/cli/run_command.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/numbers.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/history.h"
#include "emmy/io/summary.h"
#include "emmy/io/text_file.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/print.h"
#include "tools/cli/run_case.h"

namespace emmy {
namespace {

struct Arguments {
  std::string case_path;
  std::string output;
  std::vector<std::string> overrides;
  std::optional<int64_t> steps;
  bool quiet = false;
};

// Makes the directory and begins the history. A summary of an earlier run
// does not belong to it.
absl::StatusOr<HistoryWriter> BeginOutput(const std::string& directory,
                                          const Model& model) {
  const absl::Status made = MakeDirectory(directory);
  if (!made.ok()) return made;
  std::error_code ignored;
  std::filesystem::remove(directory + "/summary.json", ignored);
  return HistoryWriter::Create(directory + "/history.csv", model);
}

// A number of steps that fits 64 bits; the message if it is none.
std::string CheckSteps(const std::string& text) {
  int64_t steps = 0;
  if (absl::SimpleAtoi(text, &steps) && steps >= 0) return "";
  return "must be a whole number >= 0 [steps], got " + text;
}

ExitStatus Run(const Arguments& arguments) {
  absl::StatusOr<LoadedCase> loaded =
      LoadCaseFile(arguments.case_path, arguments.overrides);
  if (!loaded.ok()) return PrintError(loaded.status(), kExitBadInput);
  const IntegratorSettings& settings = loaded->description.integrator;
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(loaded->model,
                                       {.order = settings.order,
                                        .time_step = settings.time_step,
                                        .tolerance = settings.tolerance});
  if (!integrator.ok()) {
    return PrintError(CaseFileError(arguments.case_path, arguments.overrides,
                                    integrator.status()),
                      kExitBadInput);
  }

  // All input has been checked: only now is anything written.
  CatchInterrupts();
  std::optional<HistoryWriter> history;
  if (!arguments.output.empty()) {
    absl::StatusOr<HistoryWriter> begun =
        BeginOutput(arguments.output, loaded->model);
    if (!begun.ok()) {
      return PrintError(begun.status(), absl::IsDataLoss(begun.status())
                                            ? kExitFailed
                                            : kExitBadInput);
    }
    history = *std::move(begun);
  }
  const RunSummary summary =
      RunCase({.num_steps = arguments.steps.value_or(NumberOfSteps(settings)),
               .quiet = arguments.quiet},
              *integrator, *loaded, history.has_value() ? &*history : nullptr);

  ExitStatus exit_status =
      summary.status == RunStatus::kCompleted ? kExitDone : kExitFailed;
  if (!history.has_value()) {
    Print(WriteSummary(summary));
  } else {
    const std::string path = arguments.output + "/summary.json";
    const absl::Status written = WriteTextFile(path, WriteSummary(summary));
    if (!written.ok()) exit_status = PrintError(written, kExitFailed);
    if (written.ok() && !arguments.quiet) {
      Print(DescribeSummary(summary) + "Wrote " + history->path() + " and " +
            path + "\n");
    }
  }
  if (summary.status != RunStatus::kCompleted) {
    PrintError(
        absl::InternalError(arguments.case_path + ": " + summary.message),
        kExitFailed);
  }
  return exit_status;
}

}  // namespace

Command AddRunCommand(CLI::App& app) {
  CLI::App* options = app.add_subcommand("run", "Compute the motion of a case");
  const auto arguments = std::make_shared<Arguments>();
  options->add_option("CASE", arguments->case_path, "Case file (JSON)")
      ->required()
      ->type_name("");
  options
      ->add_option("-o,--output", arguments->output,
                   "Write history.csv and summary.json to DIR")
      ->type_name("DIR");
  options
      ->add_option("--set", arguments->overrides,
                   "Replace a value of the case (repeatable)")
      ->type_name("POINTER=VALUE")
      ->allow_extra_args(false);
  options
      ->add_option("--steps", arguments->steps,
                   "Number of steps, instead of the case's duration")
      ->type_name("N")
      ->check(CLI::Validator(CheckSteps, ""));
  options->add_flag("-q,--quiet", arguments->quiet,
                    "No progress bar and no report");
  options->footer(
      R"(The case file is described in docs/case_format.md. All of it is checked before
anything is written. Without --output the summary goes to standard output, as
JSON, and no file is written. With it, DIR is made if needed; history.csv grows
during the run, and summary.json is written at the end, also of a run that
fails or is stopped by Ctrl-C ("status").

Examples:
  emmy run examples/paper_box.json
  emmy run examples/paper_box.json --output out
  emmy run examples/paper_box.json --output out --steps 100 \
      --set /integrator/time_step=1e-4 --set /rigid_bodies/0/penalty=1e12)");
  return {options, [arguments] { return Run(*arguments); }};
}

}  // namespace emmy
