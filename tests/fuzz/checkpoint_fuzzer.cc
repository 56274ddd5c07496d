// Any bytes as a checkpoint, and any fields in a frame that is right: read,
// taken up and stepped, or refused.
//
// With --write-seeds=FOLDER as its argument it writes real ones to begin with.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "emmy/base/check.h"
#include "emmy/base/crc64.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/checkpoint.h"
#include "emmy/model/model_builder.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

struct Start {
  Case value;
  BuiltModel built;
  uint64_t checksum = 0;  // CaseChecksum takes longer than all the rest.
};

Start MakeStart(const std::string& name, const ModelDescription& model) {
  Start start{.value = {}, .built = BuildModel(model).value()};
  start.value.name = name;
  start.value.model = model;
  start.value.integrator.time_step = 1e-3;
  start.value.integrator.duration = 1.0;
  start.checksum = CaseChecksum(start.value);
  return start;
}

// A step of a state that is none of a motion does not converge, and tries all.
constexpr int kMaxIterations = 8;

const std::vector<Start>& Starts() {
  static const auto* const starts = new std::vector<Start>{
      MakeStart("free", ModelOf(PaperBox())), MakeStart("ancf", BoxWithTruss()),
      MakeStart("conventional", BoxWithTruss(Formulation::kConventional)),
      MakeStart("tangle", Tangle())};
  return *starts;
}

EnergyMomentumIntegrator IntegratorOf(const Start& start) {
  return EnergyMomentumIntegrator::Create(
             start.built.model,
             {.time_step = 1e-3, .max_iterations = kMaxIterations})
      .value();
}

// First line, length, `content`, checksum.
std::string Framed(absl::string_view content) {
  std::string bytes = "emmy-checkpoint/1\n";
  const auto append = [&bytes](uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      bytes.push_back(static_cast<char>((word >> (8 * i)) & 0xFFU));
    }
  };
  append(content.size());
  bytes.append(content.data(), content.size());
  append(Crc64(bytes));
  return bytes;
}

void Try(const std::string& bytes) {
  absl::StatusOr<Checkpoint> checkpoint = DecodeCheckpoint(bytes);
  if (!checkpoint.ok()) {
    EMMY_CHECK(!checkpoint.status().message().empty(), "no message");
    return;
  }
  EMMY_CHECK(EncodeCheckpoint(*checkpoint).value() == bytes,
             "another text is the same checkpoint");
  for (const Start& start : Starts()) {
    checkpoint->case_checksum = start.checksum;
    if (checkpoint->state.position.value.size() !=
        start.built.state.position.value.size()) {
      continue;  // Would be refused; said here to save the checksum.
    }
    if (!CheckSameCase(*checkpoint, start.value, start.built.state).ok()) {
      continue;
    }
    EnergyMomentumIntegrator integrator = IntegratorOf(start);
    if (!integrator.Restore(checkpoint->kept).ok()) continue;
    // A step takes several hundred times as long as the reading before it; the
    // first is taken, so that an input that was saved does it again.
    static int num_accepted = 0;
    if (num_accepted++ % 128 != 0) continue;
    State state = checkpoint->state;
    InvariantMonitor monitor(start.built.model, start.built.state);
    monitor.Resume(state, checkpoint->extremes);
    const StepReport report = integrator.Step(state);
    if (report.ok()) monitor.Observe(state);
  }
}

int WriteSeeds(const std::string& folder) {
  for (const Start& start : Starts()) {
    EnergyMomentumIntegrator integrator = IntegratorOf(start);
    Checkpoint checkpoint;
    checkpoint.case_name = start.value.name;
    checkpoint.state = start.built.state;
    for (int i = 0; i < 3; ++i) {
      EMMY_CHECK(integrator.Step(checkpoint.state).ok(), "seed");
    }
    checkpoint.kept = integrator.Keep();
    checkpoint.history = HistoryPosition{1000, 1};
    const std::string bytes = EncodeCheckpoint(checkpoint).value();
    const std::string content =
        bytes.substr(Framed("").size() - 8, bytes.size() - Framed("").size());
    EMMY_CHECK(Framed(content) == bytes, "frame");
    const std::string path = absl::StrCat(folder, "/", start.value.name);
    std::ofstream(path, std::ios::binary) << bytes;
    std::ofstream(path + "_content", std::ios::binary) << content;
  }
  return 0;
}

}  // namespace
}  // namespace emmy

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr absl::string_view kOption = "--write-seeds=";
  for (int i = 1; i < *argc; ++i) {
    const absl::string_view argument = (*argv)[i];
    if (absl::StartsWith(argument, kOption)) {
      std::exit(emmy::WriteSeeds(std::string(argument.substr(kOption.size()))));
    }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(data, data + size);
  emmy::Try(bytes);
  emmy::Try(emmy::Framed(bytes));
  return 0;
}
