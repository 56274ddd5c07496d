#include "tools/cli/generate_command.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/case_writer.h"
#include "emmy/io/text_file.h"
#include "tools/cli/print.h"
#include "tools/cli/run_files.h"
#include "verification/models/large_models.h"

namespace emmy {
namespace {

struct GenerateArguments {
  std::string model;
  std::string size_text;
  int size = 0;
  std::string output;
};

constexpr int kLeastSize = 2;

// `largest`: its file has 220 to 236 MiB; `emmy run` reads up to 256.
struct GeneratedModel {
  std::function<Case(int)> make;
  int largest;
};

const std::map<std::string, GeneratedModel>& Models() {
  static const auto* const models = new std::map<std::string, GeneratedModel>{
      {"net", {verification::SpinningNet, 450}},
      {"cable_net", {verification::SlackCableNet, 450}},
      {"chain", {verification::BoxChain, 400000}},
      {"conventional_chain", {verification::ConventionalBoxChain, 400000}},
      {"trussed_boxes", {verification::TrussedBoxes, 150000}}};
  return *models;
}

// Once all is parsed, since the limit depends on the model.
void ReadSize(GenerateArguments* arguments) {
  const int largest = Models().at(arguments->model).largest;
  if (absl::SimpleAtoi(arguments->size_text, &arguments->size) &&
      arguments->size >= kLeastSize && arguments->size <= largest) {
    return;
  }
  throw CLI::ValidationError(
      "--size",
      absl::StrCat("must be a whole number from ", kLeastSize, " to ", largest,
                   " for ", arguments->model, ", got ", arguments->size_text));
}

ExitStatus Generate(const GenerateArguments& arguments) {
  const std::string text =
      WriteCase(Models().at(arguments.model).make(arguments.size));
  if (arguments.output.empty()) {
    Print(text);
    return kExitDone;
  }
  const absl::Status status = WriteTextFile(arguments.output, text);
  if (status.ok()) return kExitDone;
  return PrintError(status,
                    absl::IsDataLoss(status) ? kExitFailed : kExitBadInput);
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
  options->add_option("--size", arguments->size_text, "See below")
      ->required()
      ->type_name("N");
  options
      ->add_option("--output", arguments->output,
                   "File to write; standard output if not given")
      ->type_name("FILE")
      ->check(CLI::Validator(CheckNotEmpty, ""));
  options->final_callback([arguments] { ReadSize(arguments.get()); });
  options->footer(
      R"(Models, of size N, from 2 to what makes a file that emmy run reads (256 MiB):
  net                 up to 450     a spinning square net of N x N nodes, a hub
  cable_net           up to 450     the same of cables, which go slack and taut
  chain               up to 400000  N boxes joined by spherical joints
  conventional_chain  up to 400000  the same of conventional bodies
  trussed_boxes       up to 150000  N boxes, neighbours joined by four trusses

Exit status: 0 done; 1 not all could be written (a full disk); 2 bad usage, or
a file that cannot be opened.

Examples:
  emmy generate net --size 60 --output net_60.json
  emmy run net_60.json --steps 20)");
  return {options, [arguments] { return Generate(*arguments); }};
}

}  // namespace emmy
