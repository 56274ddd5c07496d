#include "tools/cli/run_command.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/checkpoint.h"
#include "emmy/io/history.h"
#include "emmy/io/summary.h"
#include "emmy/io/text_file.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/print.h"
#include "tools/cli/run_case.h"
#include "tools/cli/run_files.h"

namespace emmy {
namespace {

struct RunArguments {
  std::string case_path;
  std::string output;
  std::vector<std::string> overrides;
  std::optional<int64_t> steps;
  int threads = 1;
  bool quiet = false;
  std::string checkpoint;
  std::optional<int64_t> checkpoint_every;
  std::string resume;

  RunFiles files() const {
    return {case_path, output, checkpoint_path(), resume};
  }
  // Where checkpoints go; none: "".
  const std::string& checkpoint_path() const {
    return checkpoint.empty() ? resume : checkpoint;
  }
};

// A checkpoint that fits the case, as far as the run can go on from it.
absl::Status CheckResumable(const RunArguments& arguments,
                            const Checkpoint& checkpoint,
                            const LoadedCase& loaded, int64_t num_steps) {
  absl::Status same =
      CheckSameCase(checkpoint, loaded.description, loaded.state);
  if (!same.ok()) return same;
  if (checkpoint.state.step > num_steps) {
    return absl::InvalidArgumentError(
        absl::StrCat("is of step ", checkpoint.state.step,
                     ", the run is to end at step ", num_steps));
  }
  if (checkpoint.history.has_value() && arguments.output.empty()) {
    return absl::InvalidArgumentError(
        "is of a run with a history: --output must name its folder");
  }
  if (!checkpoint.history.has_value() && !arguments.output.empty()) {
    return absl::InvalidArgumentError(
        "is of a run without a history, which --output cannot begin now");
  }
  return absl::OkStatus();
}

// The checkpoint to go on from, with the integrator as it was there.
absl::StatusOr<Checkpoint> LoadCheckpoint(
    const RunArguments& arguments, const LoadedCase& loaded, int64_t num_steps,
    EnergyMomentumIntegrator& integrator) {
  absl::StatusOr<Checkpoint> checkpoint = ReadCheckpoint(arguments.resume);
  if (!checkpoint.ok()) return checkpoint.status();
  absl::Status status =
      CheckResumable(arguments, *checkpoint, loaded, num_steps);
  if (status.ok()) status = integrator.Restore(checkpoint->kept);
  if (!status.ok()) {
    return absl::Status(status.code(),
                        absl::StrCat(arguments.resume, ": ", status.message()));
  }
  if (checkpoint->build != CheckpointBuild()) {
    PrintError(absl::UnknownError(absl::StrCat(
                   arguments.resume, ": was written by ", checkpoint->build,
                   "; this is ", CheckpointBuild(),
                   ": going on, but the last digits may differ")),
               kExitDone);
  }
  return checkpoint;
}

// Opens the history in the folder, or goes on with it. A summary of an earlier
// run does not belong to it, and goes before the history is emptied.
absl::StatusOr<HistoryWriter> OpenOutput(const RunFiles& files,
                                         const Model& model,
                                         const Checkpoint* resume) {
  const absl::Status replaceable = CheckReplaceable(files.summary());
  if (!replaceable.ok()) return replaceable;
  const std::string path = files.history();
  absl::StatusOr<HistoryWriter> history =
      resume == nullptr ? HistoryWriter::Open(path, model)
                        : HistoryWriter::Resume(path, model, *resume->history);
  if (!history.ok()) return history.status();
  RemoveTextFile(files.summary());
  const absl::Status synced = SyncFolderOf(path);
  if (!synced.ok()) return synced;
  return history;
}

// A word as a shell has to be given it.
std::string Quoted(const std::string& word) {
  const bool is_plain =
      !word.empty() &&
      word.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
          "_-+=./,:@%") == std::string::npos;
  if (is_plain) return word;
  return absl::StrCat("'", absl::StrReplaceAll(word, {{"'", "'\\''"}}), "'");
}

// The command that goes on with this run from `checkpoint`.
std::string ResumeCommand(const RunArguments& arguments,
                          const std::string& checkpoint) {
  const std::string& path = arguments.case_path;
  const char* folder = path.starts_with('-') ? "./" : "";  // Not an option.
  std::string command = "emmy run " + Quoted(absl::StrCat(folder, path));
  const auto add = [&command](const char* option, const std::string& value) {
    if (value.empty()) return;
    absl::StrAppend(&command, " ", option, " ", Quoted(value));
  };
  add("--output", arguments.output);
  for (const std::string& setting : arguments.overrides) add("--set", setting);
  if (arguments.steps.has_value()) {
    add("--steps", absl::StrCat(*arguments.steps));
  }
  if (arguments.checkpoint_every.has_value()) {
    add("--checkpoint-every", absl::StrCat(*arguments.checkpoint_every));
  }
  if (arguments.threads != 1) {
    add("--threads", absl::StrCat(arguments.threads));
  }
  if (arguments.quiet) command += " --quiet";
  if (checkpoint != arguments.checkpoint_path()) {
    add("--checkpoint", arguments.checkpoint_path());
  }
  add("--resume", checkpoint);
  return command;
}

// A number of steps that fits 64 bits; the message if it is none.
std::string CheckSteps(const std::string& text) {
  int64_t steps = 0;
  if (absl::SimpleAtoi(text, &steps) && steps >= 0) return "";
  return "must be a whole number >= 0 [steps], got " + text;
}

std::string CheckEvery(const std::string& text) {
  int64_t steps = 0;
  if (absl::SimpleAtoi(text, &steps) && steps >= 1) return "";
  return "must be a whole number >= 1 [steps], got " + text;
}

std::string CheckThreads(const std::string& text) {
  constexpr int kMostThreads = 1024;
  int threads = 0;
  if (absl::SimpleAtoi(text, &threads) && threads >= 1 &&
      threads <= kMostThreads) {
    return "";
  }
  return absl::StrCat("must be a whole number from 1 to ", kMostThreads,
                      ", got ", text);
}

// What is wrong with input or with a file that cannot be opened; a file that
// can, but not be written, is no fault of the input.
ExitStatus RefuseOrFail(const absl::Status& status) {
  return PrintError(status,
                    absl::IsDataLoss(status) ? kExitFailed : kExitBadInput);
}

// Writes the summary and says what became of the run.
ExitStatus Report(const RunArguments& arguments, const RunResult& result,
                  const std::string& history_path) {
  const RunSummary& summary = result.summary;
  ExitStatus exit_status = kExitFailed;
  if (summary.status == RunStatus::kCompleted) exit_status = kExitDone;
  if (summary.status == RunStatus::kInterrupted) exit_status = kExitInterrupted;
  if (history_path.empty()) {
    Print(WriteSummary(summary));
  } else {
    const std::string path = arguments.files().summary();
    const absl::Status written = WriteTextFile(path, WriteSummary(summary));
    if (!written.ok()) exit_status = PrintError(written, kExitFailed);
    if (written.ok() && !arguments.quiet) {
      Print(DescribeSummary(summary) + "Wrote " + history_path + " and " +
            path + "\n");
    }
  }
  if (summary.status != RunStatus::kCompleted) {
    std::string message = arguments.case_path + ": " + summary.message;
    if (result.can_be_resumed) {
      message += "\nTo go on: " +
                 ResumeCommand(arguments, result.has_checkpoint
                                              ? arguments.checkpoint_path()
                                              : arguments.resume);
    }
    PrintError(absl::InternalError(message), exit_status);
  }
  return exit_status;
}

ExitStatus Run(const RunArguments& arguments) {
  if (arguments.checkpoint_every.has_value() &&
      arguments.checkpoint_path().empty()) {
    return PrintError(
        absl::InvalidArgumentError(
            "emmy run: --checkpoint-every needs --checkpoint or --resume"),
        kExitBadInput);
  }
  const RunFiles files = arguments.files();
  absl::Status usable = CheckFilesApart(files);
  if (usable.ok()) usable = CheckCheckpointIsNew(files);
  if (!usable.ok()) return PrintError(usable, kExitBadInput);
  absl::StatusOr<LoadedCase> loaded =
      LoadCaseFile(arguments.case_path, arguments.overrides);
  if (!loaded.ok()) return PrintError(loaded.status(), kExitBadInput);
  const IntegratorSettings& settings = loaded->description.integrator;
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(loaded->model,
                                       OptionsOf(settings, arguments.threads));
  if (!integrator.ok()) {
    return PrintError(CaseFileError(arguments.case_path, arguments.overrides,
                                    integrator.status()),
                      kExitBadInput);
  }

  const int64_t num_steps = arguments.steps.value_or(NumberOfSteps(settings));
  std::optional<Checkpoint> resume;
  if (!arguments.resume.empty()) {
    absl::StatusOr<Checkpoint> checkpoint =
        LoadCheckpoint(arguments, *loaded, num_steps, *integrator);
    if (!checkpoint.ok()) return PrintError(checkpoint.status(), kExitBadInput);
    resume = *std::move(checkpoint);
  }

  // All input has been checked: only now is anything written.
  CatchInterrupts();
  MadeFolder folder;
  if (!files.output.empty()) usable = folder.Make(files.output);
  if (usable.ok() && !files.checkpoint.empty()) {
    usable = CheckReplaceable(files.checkpoint);
  }
  if (!usable.ok()) return PrintError(usable, kExitBadInput);
  std::optional<HistoryWriter> history;
  if (!files.output.empty()) {
    absl::StatusOr<HistoryWriter> opened = OpenOutput(
        files, loaded->model, resume.has_value() ? &*resume : nullptr);
    if (!opened.ok()) return RefuseOrFail(opened.status());
    history = *std::move(opened);
  }
  folder.Keep();
  const RunResult result =
      RunCase({.num_steps = num_steps,
               .quiet = arguments.quiet,
               .checkpoint = {.path = arguments.checkpoint_path(),
                              .every = arguments.checkpoint_every},
               .resume = resume.has_value() ? &*resume : nullptr},
              *integrator, *loaded, history.has_value() ? &*history : nullptr);
  return Report(arguments, result, history.has_value() ? history->path() : "");
}

}  // namespace

Command AddRunCommand(CLI::App& app) {
  CLI::App* options = app.add_subcommand("run", "Compute the motion of a case");
  const auto arguments = std::make_shared<RunArguments>();
  options->add_option("CASE", arguments->case_path, "Case file (JSON)")
      ->required()
      ->type_name("")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options
      ->add_option("-o,--output", arguments->output,
                   "Write history.csv and summary.json to DIR")
      ->type_name("DIR")
      ->check(CLI::Validator(CheckNotEmpty, ""));
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
  options
      ->add_option("--threads", arguments->threads,
                   "Share large nets among N threads (default: 1)")
      ->type_name("N")
      ->check(CLI::Validator(CheckThreads, ""));
  options
      ->add_option("--checkpoint", arguments->checkpoint,
                   "Keep in FILE what it takes to go on")
      ->type_name("FILE")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options
      ->add_option("--checkpoint-every", arguments->checkpoint_every,
                   "Write it every N steps (default: every minute)")
      ->type_name("N")
      ->check(CLI::Validator(CheckEvery, ""));
  options
      ->add_option("--resume", arguments->resume,
                   "Go on from the checkpoint FILE, and keep it up")
      ->type_name("FILE")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options->add_flag("-q,--quiet", arguments->quiet,
                    "No progress bar and no report");
  options->footer(
      R"(The case file is described in docs/case_format.md. All of it is checked before
anything is written. Without --output the summary goes to standard output, as
JSON, and no file is written. With it, DIR is made if needed; history.csv grows
during the run, and summary.json is written at the end, also of a run that
fails or is stopped by Ctrl-C ("status").

--threads helps structures with trusses or springs from 4000 vectors on (a node
is one, an ANCF body four), and chains of more than 512 ANCF bodies; other
models run on one thread. Results do not depend on it.

A run with --checkpoint that was stopped, by whatever, goes on with --resume as
if it never had been: the same command line, with the file as it is, gives the
same results to the last bit. --steps then still counts from the start.

Exit status: 0 done; 1 the computation could not go on, or a file or standard
output not be written; 2 bad input or usage, nothing written; 3 stopped by
Ctrl-C (SIGINT) or SIGTERM, after a whole step.

Examples:
  emmy run examples/paper_box.json
  emmy run examples/paper_box.json --output out
  emmy run examples/paper_box.json --output out --checkpoint out/checkpoint
  emmy run examples/paper_box.json --output out --resume out/checkpoint
  emmy run examples/paper_box.json --output out --steps 100 \
      --set /integrator/time_step=1e-4 --set /rigid_bodies/0/penalty=1e12)");
  return {options, [arguments] { return Run(*arguments); }};
}

}  // namespace emmy
