#include "tools/cli/check_command.h"

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "tools/cli/describe_case.h"
#include "tools/cli/print.h"
#include "tools/cli/run_files.h"

namespace emmy {
namespace {

struct CheckArguments {
  std::string case_path;
  std::vector<std::string> overrides;
};

ExitStatus Check(const CheckArguments& arguments) {
  const absl::StatusOr<LoadedCase> loaded =
      LoadCaseFile(arguments.case_path, arguments.overrides);
  if (!loaded.ok()) return PrintError(loaded.status(), kExitBadInput);
  const absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(
          loaded->model, OptionsOf(loaded->description.integrator));
  if (!integrator.ok()) {
    return PrintError(CaseFileError(arguments.case_path, arguments.overrides,
                                    integrator.status()),
                      kExitBadInput);
  }
  Print(DescribeCase(*loaded));
  return kExitDone;
}

}  // namespace

Command AddCheckCommand(CLI::App& app) {
  CLI::App* options = app.add_subcommand(
      "check", "Validate a case and print what the model is");
  const auto arguments = std::make_shared<CheckArguments>();
  options->add_option("CASE", arguments->case_path, "Case file (JSON)")
      ->required()
      ->type_name("")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options
      ->add_option("--set", arguments->overrides,
                   "Replace a value of the case (repeatable)")
      ->type_name("POINTER=VALUE")
      ->allow_extra_args(false);
  options->footer(R"(Examples:
  emmy check examples/paper_box.json
  emmy check examples/paper_box.json --set /rigid_bodies/0/penalty=1e12)");
  return {options, [arguments] { return Check(*arguments); }};
}

}  // namespace emmy
