#include "tools/cli/regenerate_command.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "tools/cli/print.h"
#include "verification/reference/artifact.h"
#include "verification/reference/project_directory.h"

namespace emmy {
namespace {

using verification::Artifact;

struct RegenerateArguments {
  std::vector<std::string> only;
  bool check = false;
};

absl::StatusOr<std::vector<const Artifact*>> Select(
    const std::vector<std::string>& names) {
  std::vector<const Artifact*> selected;
  for (const Artifact& artifact : verification::AllArtifacts()) {
    const bool named =
        std::find(names.begin(), names.end(), artifact.name) != names.end();
    if (names.empty() || named) selected.push_back(&artifact);
  }
  for (const std::string& name : names) {
    if (verification::FindArtifact(name) != nullptr) continue;
    std::string known;
    for (const Artifact& artifact : verification::AllArtifacts()) {
      absl::StrAppend(&known, "\n  ", artifact.name, "  (", artifact.path, ": ",
                      artifact.description, ")");
    }
    return absl::InvalidArgumentError(
        absl::StrCat("--only: there is no \"", name, "\"; there are", known));
  }
  return selected;
}

ExitStatus Regenerate(const RegenerateArguments& arguments) {
  const absl::StatusOr<std::vector<const Artifact*>> artifacts =
      Select(arguments.only);
  if (!artifacts.ok()) return PrintError(artifacts.status(), kExitBadInput);
  const std::string root = verification::ProjectDirectory();
  bool differs = false;
  for (const Artifact* artifact : *artifacts) {
    const absl::StatusOr<std::string> difference = artifact->compare(root);
    if (!difference.ok()) return PrintError(difference.status(), kExitFailed);
    if (difference->empty()) {
      // Not written: the same data keep their provenance.
      Print(absl::StrCat(artifact->path, ": current\n"));
      continue;
    }
    differs = true;
    if (!arguments.check) {
      const absl::Status written = artifact->write(root);
      if (!written.ok()) return PrintError(written, kExitFailed);
    }
    Print(absl::StrCat(artifact->path,
                       arguments.check ? ": would change\n" : ": written\n",
                       *difference));
  }
  return arguments.check && differs ? kExitFailed : kExitDone;
}

}  // namespace

Command AddRegenerateCommand(CLI::App& app) {
  CLI::App* options = app.add_subcommand(
      "regenerate", "Compute reference data and figures anew");
  const auto arguments = std::make_shared<RegenerateArguments>();
  options
      ->add_option("--only", arguments->only, "Only this one; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  options->add_flag("--check", arguments->check,
                    "Write nothing; say what would change and by how much, "
                    "with exit status 1 if anything would");
  options->footer(R"(
Files are written into the sources this program was built from, or into the
folder that the environment variable EMMY_PROJECT_DIRECTORY names. A file whose
data are the same, bit for bit, is left as it is.

Examples:
  emmy regenerate --check
  emmy regenerate --only paper_box_ancf)");
  return {options, [arguments] { return Regenerate(*arguments); }};
}

}  // namespace emmy
