#include "tools/cli/generate_command.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "emmy/io/case_writer.h"
#include "emmy/io/text_file.h"
#include "tools/cli/print.h"
#include "verification/models/large_models.h"

namespace emmy {
namespace {

struct GenerateArguments {
  std::string model;
  int size = 0;
  std::string output;
};

const std::map<std::string, std::function<Case(int)>>& Models() {
  static const auto* const models =
      new std::map<std::string, std::function<Case(int)>>{
          {"net", verification::SpinningNet},
          {"cable_net", verification::SlackCableNet},
          {"chain", verification::BoxChain},
          {"conventional_chain", verification::ConventionalBoxChain},
          {"trussed_boxes", verification::TrussedBoxes}};
  return *models;
}

ExitStatus Generate(const GenerateArguments& arguments) {
  const std::string text =
      WriteCase(Models().at(arguments.model)(arguments.size));
  if (arguments.output.empty()) {
    Print(text);
    return kExitDone;
  }
  const absl::Status status = WriteTextFile(arguments.output, text);
  if (!status.ok()) return PrintError(status, kExitBadInput);
  return kExitDone;
}

}  // namespace

Command AddGenerateCommand(CLI::App& app) {
  CLI::App* options =
      app.add_subcommand("generate", "Write the case file of a large model");
  const auto arguments = std::make_shared<GenerateArguments>();
  std::vector<std::string> names;
  for (const auto& [name, make] : Models()) names.push_back(name);
  options->add_option("MODEL", arguments->model, "Which, see below")
      ->required()
      ->check(CLI::IsMember(names))
      ->type_name("");
  options->add_option("--size", arguments->size, "N, at least 2")
      ->required()
      ->check(CLI::Range(2, 10000000))
      ->type_name("N");
  options
      ->add_option("--output", arguments->output,
                   "File to write; standard output if not given")
      ->type_name("FILE");
  options->footer(R"(Models, of size N:
  net                 a spinning square net of N x N nodes with a hub
  cable_net           the same of cables, which go slack and taut
  chain               N boxes joined by spherical joints
  conventional_chain  the same of conventional bodies
  trussed_boxes       N boxes, neighbours joined by four trusses

Examples:
  emmy generate net --size 60 --output net_60.json
  emmy run net_60.json --steps 20)");
  return {options, [arguments] { return Generate(*arguments); }};
}

}  // namespace emmy
